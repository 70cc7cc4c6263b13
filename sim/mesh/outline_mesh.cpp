#include "sim/mesh/outline_mesh.h"

#include "sim/base/math.h"
#include "sim/base/stop_request.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

namespace rend {
namespace {

constexpr double near_end = 0.3; // of an edge
constexpr int smoothing = 8;     // rounds

double turn_of(const Vec2& a, const Vec2& b, const Vec2& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

enum class Place : std::int8_t { Outside = -1, On = 0, Inside = 1 };

// Its vertices are numbered row by row; row y is shifted by half an edge where y is odd. Edges lead from a
// vertex to the right (0), up to the left (1) and up to the right (2).
class Lattice {
public:
  Lattice(const Outline& outline, double cell) : outline_(outline), cell_(cell), rise_(cell * std::sqrt(0.75)) {
    const Eigen::AlignedBox2d box = outline.box();
    // Odd shares, so that no vertex lies on a straight side of a simple shape.
    origin_ = box.min() - Vec2(1.5123, 1.5371).cwiseProduct(Vec2(cell_, rise_));
    columns_ = static_cast<int>((box.max().x() - origin_.x()) / cell_) + 3;
    rows_ = static_cast<int>((box.max().y() - origin_.y()) / rise_) + 3;
    for (int y = 0; y < rows_; ++y)
      for (int x = 0; x < columns_; ++x)
        point_.push_back(origin_ + Vec2((x + (y % 2 == 1 ? 0.5 : 0.0)) * cell_, y * rise_));
    place_.assign(point_.size(), Place::Outside);
  }

  PolygonMesh mesh() {
    find_crossings();
    find_inside();
    take_corners();
    move_onto_outline();
    PolygonMesh mesh;
    for_each_triangle([&](const std::array<int, 3>& corner) { add(corner, mesh); });
    if (mesh.polygons() > 0) smooth(mesh);
    return mesh;
  }

private:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  int vertex(int x, int y) const { return y * columns_ + x; }
  // The other end of an edge; −1: there is none.
  int end_of(int v, int edge) const {
    const int x = v % columns_ + (edge == 0 ? 1 : (v / columns_) % 2 - (edge == 1 ? 1 : 0));
    const int y = v / columns_ + (edge == 0 ? 0 : 1);
    return x < 0 || x >= columns_ || y >= rows_ ? -1 : vertex(x, y);
  }

  // Of each edge by its lower end and direction: where the outline crosses it, as shares of it. A segment that
  // ends on an edge counts on one side of it, so that each closed ring crosses a closed path an even number of
  // times.
  void find_crossings() {
    for (const Contour& ring : outline_.rings)
      for (std::size_t n = 0; n < ring.size(); ++n) {
        throw_if_stop_is_due();
        cross(ring[n], ring[(n + 1) % ring.size()]);
      }
    for (auto& [edge, shares] : crossings_) std::ranges::sort(shares);
  }

  void cross(const Vec2& a, const Vec2& b) {
    const Vec2 low = (a.cwiseMin(b) - origin_), high = (a.cwiseMax(b) - origin_);
    const int y0 = std::max(0, static_cast<int>(low.y() / rise_) - 1),
              y1 = static_cast<int>(high.y() / rise_) + 1;
    const int x0 = std::max(0, static_cast<int>(low.x() / cell_) - 2),
              x1 = static_cast<int>(high.x() / cell_) + 2;
    for (int y = y0; y <= std::min(y1, rows_ - 1); ++y)
      for (int x = x0; x <= std::min(x1, columns_ - 1); ++x)
        for (int edge = 0; edge < 3; ++edge) cross(a, b, vertex(x, y), edge);
  }

  void cross(const Vec2& a, const Vec2& b, int v, int edge) {
    const int w = end_of(v, edge);
    if (w < 0) return;
    const auto v_at = static_cast<std::size_t>(v), w_at = static_cast<std::size_t>(w);
    const Vec2 &p = point_[v_at], &q = point_[w_at];
    const double from = turn_of(a, b, p), to = turn_of(a, b, q);
    if ((turn_of(p, q, a) >= 0) == (turn_of(p, q, b) >= 0) || (from >= 0) == (to >= 0)) return;
    crossings_[{v, edge}].push_back(std::clamp(from / (from - to), 0.0, 1.0));
  }

  void find_inside() {
    for (int y = 0; y < rows_; ++y) {
      bool inside = false;
      for (int x = 0; x < columns_; ++x) {
        if (inside) place(vertex(x, y)) = Place::Inside;
        const auto found = crossings_.find({vertex(x, y), 0});
        if (found != crossings_.end() && found->second.size() % 2 == 1) inside = !inside;
      }
    }
  }

  void take_corners() {
    const double least = cosine_of_degrees(25);
    for (const Contour& ring : outline_.rings)
      for (std::size_t n = 0; n < ring.size(); ++n) {
        const Vec2& here = ring[n];
        const Vec2 in = (here - ring[(n + ring.size() - 1) % ring.size()]).normalized();
        const Vec2 out = (ring[(n + 1) % ring.size()] - here).normalized();
        if (in.dot(out) < least) take(here);
      }
  }

  void take(const Vec2& corner) {
    const int y = static_cast<int>((corner.y() - origin_.y()) / rise_);
    const int column = static_cast<int>((corner.x() - origin_.x()) / cell_);
    int nearest = -1;
    double least = 0.6 * cell_;
    for (int row = y - 1; row <= y + 2; ++row)
      for (int x = column - 2; x <= column + 2; ++x) {
        if (row < 0 || row >= rows_ || x < 0 || x >= columns_) continue;
        const int v = vertex(x, row);
        const double away = (at(v) - corner).norm();
        if (place(v) == Place::On || away >= least) continue;
        nearest = v;
        least = away;
      }
    if (nearest < 0) return;
    at(nearest) = corner;
    place(nearest) = Place::On;
  }

  // All by where vertices were before any moves, but for those at corners.
  void move_onto_outline() {
    struct Move {
      Vec2 to;
      double away;
    };
    std::map<int, Move> moves;
    for (const auto& [edge, shares] : crossings_) {
      const int v = edge.first, w = end_of(v, edge.second);
      const auto offer = [&](int end, double share, double away, double limit) {
        if (away >= limit) return;
        const auto found = moves.find(end);
        const Vec2 to = (1 - share) * at(v) + share * at(w);
        if (found == moves.end() || found->second.away > away) moves[end] = {to, away};
      };
      if (crosses(v, w)) {
        offer(v, middle(shares), middle(shares), near_end);
        offer(w, middle(shares), 1 - middle(shares), near_end);
      } else if (shares.size() == 2 && place(v) == place(w) && place(v) != Place::On) {
        offer(v, shares[0], shares[0], 0.5);
        offer(w, shares[1], 1 - shares[1], 0.5);
      }
    }
    for (const auto& [v, move] : moves) {
      at(v) = move.to;
      place(v) = Place::On;
    }
  }

  static double middle(const std::vector<double>& shares) { return shares[shares.size() / 2]; }

  bool crosses(int v, int w) const {
    const Place a = place_[static_cast<std::size_t>(v)], b = place_[static_cast<std::size_t>(w)];
    return a != Place::On && b != Place::On && a != b;
  }

  template <class F> void for_each_triangle(F&& f) const {
    for (int y = 0; y + 1 < rows_; ++y)
      for (int x = 0; x < columns_; ++x) {
        const int v = vertex(x, y), right = end_of(v, 0), up_left = end_of(v, 1), up_right = end_of(v, 2);
        if (up_left >= 0 && up_right >= 0) f(std::array{v, up_right, up_left});
        if (right >= 0 && up_right >= 0) f(std::array{v, right, up_right});
      }
  }

  // What of a triangle is inside: a polygon of three or four corners.
  void add(const std::array<int, 3>& corner, PolygonMesh& mesh) {
    const auto count = [&](Place where) {
      return std::ranges::count_if(corner, [&](int v) { return place(v) == where; });
    };
    if (count(Place::Inside) == 0) {
      const Vec2 centre = (at(corner[0]) + at(corner[1]) + at(corner[2])) / 3;
      if (count(Place::On) != 3 || !outline_.contains(centre)) return;
    }
    std::vector<std::uint32_t> polygon;
    for (std::size_t n = 0; n < 3; ++n) {
      const int v = corner[n], w = corner[(n + 1) % 3];
      if (place(v) != Place::Outside) polygon.push_back(number_of(v, mesh));
      if (crosses(v, w)) polygon.push_back(number_of(v, w, mesh));
    }
    if (polygon.size() < 3) return;
    const auto length = [&](std::size_t a, std::size_t b) {
      return (mesh.points[polygon[a]] - mesh.points[polygon[b]]).squaredNorm();
    };
    if (polygon.size() == 3) {
      mesh.add({polygon[0], polygon[1], polygon[2]});
    } else if (length(0, 2) <= length(1, 3)) {
      mesh.add({polygon[0], polygon[1], polygon[2]});
      mesh.add({polygon[0], polygon[2], polygon[3]});
    } else {
      mesh.add({polygon[0], polygon[1], polygon[3]});
      mesh.add({polygon[1], polygon[2], polygon[3]});
    }
  }

  std::uint32_t number_of(int v, PolygonMesh& mesh) {
    const auto [found, is_new] = number_.try_emplace({v, v}, static_cast<std::uint32_t>(mesh.points.size()));
    if (is_new) {
      mesh.points.emplace_back(at(v).x(), at(v).y(), 0);
      may_move_.push_back(place(v) == Place::Inside);
    }
    return found->second;
  }

  // Of the vertex on an edge.
  std::uint32_t number_of(int v, int w, PolygonMesh& mesh) {
    const auto ends = std::minmax(v, w);
    const auto [found, is_new] = number_.try_emplace(ends, static_cast<std::uint32_t>(mesh.points.size()));
    if (is_new) {
      const Vec2 here = crossing_of(ends.first, ends.second);
      mesh.points.emplace_back(here.x(), here.y(), 0);
      may_move_.push_back(false);
    }
    return found->second;
  }

  Vec2 crossing_of(int v, int w) { // v < w: the end from which the edge leads
    for (int edge = 0; edge < 3; ++edge)
      if (end_of(v, edge) == w)
        if (const auto found = crossings_.find({v, edge}); found != crossings_.end())
          return (1 - middle(found->second)) * at(v) + middle(found->second) * at(w);
    return (at(v) + at(w)) / 2; // round-off decided otherwise about one of its ends
  }

  // To the middle of the neighbours, where that makes the least angle larger.
  void smooth(PolygonMesh& mesh) const {
    std::vector<std::vector<std::uint32_t>> around(mesh.points.size()); // triangles at each point
    for (std::uint32_t t = 0; t < mesh.polygons(); ++t)
      for (std::size_t n = 0; n < 3; ++n) around[mesh.corners[3 * t + n]].push_back(t);
    for (int round = 0; round < smoothing; ++round)
      for (std::size_t p = 0; p < mesh.points.size(); ++p) {
        if (!may_move_[p]) continue;
        Vec3 sum = Vec3::Zero();
        double before = 1;
        for (std::uint32_t t : around[p]) {
          before = std::min(before, least_sine(mesh, t));
          for (std::size_t n = 0; n < 3; ++n) sum += mesh.points[mesh.corners[3 * t + n]];
        }
        const double triangles = static_cast<double>(around[p].size());
        const Vec3 old = mesh.points[p];
        mesh.points[p] = (sum - triangles * old) / (2 * triangles);
        double after = 1;
        for (std::uint32_t t : around[p]) after = std::min(after, least_sine(mesh, t));
        if (after <= before) mesh.points[p] = old;
      }
  }

  // Of the angles of a triangle; below 0 if it is turned around.
  static double least_sine(const PolygonMesh& mesh, std::uint32_t triangle) {
    const std::uint32_t* c = mesh.corners.data() + 3 * std::size_t{triangle};
    const Vec3 u = mesh.points[c[1]] - mesh.points[c[0]], v = mesh.points[c[2]] - mesh.points[c[0]], w = v - u;
    std::array<double, 3> sides{u.norm(), v.norm(), w.norm()};
    std::ranges::sort(sides);
    return u.cross(v).z() / (sides[1] * sides[2]);
  }

  Vec2& at(int v) { return point_[static_cast<std::size_t>(v)]; }
  Place& place(int v) { return place_[static_cast<std::size_t>(v)]; }

  const Outline& outline_;
  double cell_, rise_; // [m], along rows and between them
  Vec2 origin_;
  int columns_ = 0, rows_ = 0;
  std::vector<Vec2> point_;                                      // [m], of each vertex
  std::vector<Place> place_;                                     // likewise
  std::map<std::pair<int, int>, std::vector<double>> crossings_; // of edges: lower end, direction
  std::map<std::pair<int, int>, std::uint32_t> number_;          // in the mesh, of vertices and cut edges
  std::vector<bool> may_move_;                                   // of points of the mesh
};

} // namespace

template <> const Fields<OutlineShape>& fields_of() {
  using S = OutlineShape;
  static const Fields<S> fields{
      field(&S::name, word("shape", {"path", "heart", "star", "disc", "ring", "drop", "gear"},
                           "the outline\npath: of the attribute path, file or text\nothers: by name, their "
                           "middle at the origin")),
      field(&S::path, text("path", "data of an SVG path: M L H V C S Q T A Z; y points up; what lies within an "
                                   "odd number of its curves is inside")),
      field(&S::file,
            text("file", "an SVG file: what its paths, rectangles, circles, ellipses and polygons fill, one "
                         "connected region; relative to the preset, and in its folder or below")),
      field(&S::text,
            text("text", "letters of the font Inter, each of which is one connected region: capitals and "
                         "digits, most small ones; of several, each is a part of the body")),
      field(&S::size, number("size", "m",
                             "the larger side of the box around it, whose middle comes to the origin; "
                             "of a path: none, its numbers are metres; of others: 1 m")
                          .above(0)),
      field(&S::cell, number("cell", "m", "length of the edges of triangles, about").above(0).is_required()),
      field(&S::depth,
            number("depth", "m", "along z: of a solid of tetrahedra; none: a sheet of triangles").above(0))};
  return fields;
}

PolygonMesh triangles_within(const Outline& outline, double cell) {
  return Lattice(outline, cell).mesh();
}

int parts_of(const PolygonMesh& triangles) {
  std::vector<std::size_t> parent(triangles.polygons());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> beside; // the triangle at each edge
  auto parts = static_cast<int>(triangles.polygons());
  for (std::size_t t = 0; t < triangles.polygons(); ++t)
    for (std::size_t n = 0; n < 3; ++n) {
      const std::uint32_t a = triangles.corners[3 * t + n], b = triangles.corners[3 * t + (n + 1) % 3];
      const auto [found, is_new] = beside.try_emplace(std::minmax(a, b), t);
      const std::size_t one = root(found->second), other = root(t);
      if (is_new || one == other) continue;
      parent[std::max(one, other)] = std::min(one, other);
      --parts;
    }
  return parts;
}

double area_of(const PolygonMesh& triangles) {
  double sum = 0;
  for (std::size_t t = 0; t < triangles.polygons(); ++t) {
    const std::uint32_t* c = triangles.corners.data() + 3 * t;
    const Vec3 a = triangles.points[c[0]];
    sum += (triangles.points[c[1]] - a).cross(triangles.points[c[2]] - a).norm() / 2;
  }
  return sum;
}

CellMesh extruded(const PolygonMesh& triangles, double depth, int layers) {
  CellMesh mesh;
  const auto points = static_cast<std::uint32_t>(triangles.points.size());
  for (int layer = 0; layer <= layers; ++layer)
    for (const Vec3& p : triangles.points) mesh.points.emplace_back(p.x(), p.y(), depth * layer / layers);
  for (int layer = 0; layer < layers; ++layer)
    for (std::size_t t = 0; t < triangles.polygons(); ++t) {
      std::array<std::uint32_t, 3> corner;
      std::copy_n(triangles.corners.begin() + static_cast<std::ptrdiff_t>(3 * t), 3, corner.begin());
      // Diagonals lead up from the smaller number, so that those of neighbours are the same.
      std::ranges::sort(corner);
      const std::uint32_t low = points * static_cast<std::uint32_t>(layer), high = low + points;
      const auto [a, b, c] = corner;
      for (std::array<std::uint32_t, 4> cell :
           {std::array{low + a, low + b, low + c, high + c}, std::array{low + a, low + b, high + c, high + b},
            std::array{low + a, high + a, high + b, high + c}}) {
        mesh.add(CellKind::Tetrahedron, cell);
        if (signed_volume(mesh, mesh.cells() - 1) < 0)
          std::swap(mesh.corners[mesh.corners.size() - 1], mesh.corners[mesh.corners.size() - 2]);
      }
    }
  return mesh;
}

} // namespace rend
