#include "sim/mechanics/element.h"

#include "sim/base/check.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

using Gradient = std::array<double, 3>;

// Gauss points of [0,1], each of weight 1/2.
const std::array<double, 2> gauss{0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)};

// A linear function of one coordinate, t or 1 − t, and its derivative.
double ramp(int up, double t) {
  return up ? t : 1 - t;
}
double slope(int up) {
  return up ? 1 : -1;
}

// The position of corner n of a square, in cyclic order.
constexpr std::array<std::array<int, 2>, 4> unit_square{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};

// For [0,1]², or [0,1]³ with the lower square first.
std::vector<ReferencePoint> box_points(int dimension) {
  std::vector<ReferencePoint> points;
  const int count = 1 << dimension;
  for (int g = 0; g < count; ++g) {
    ReferencePoint point{1.0 / count, {}};
    const double t[3] = {gauss[g & 1], gauss[g >> 1 & 1], gauss[g >> 2 & 1]};
    for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
      const int at[3] = {unit_square[n % 4][0], unit_square[n % 4][1], n < 4 ? 0 : 1};
      for (int axis = 0; axis < dimension; ++axis) {
        double value = slope(at[axis]);
        for (int other = 0; other < dimension; ++other)
          if (other != axis) value *= ramp(at[other], t[other]);
        point.gradient[n][static_cast<std::size_t>(axis)] = value;
      }
    }
    points.push_back(point);
  }
  return points;
}

std::vector<ReferencePoint> simplex_points(int dimension) {
  ReferencePoint point{dimension == 2 ? 1.0 / 2 : 1.0 / 6, {}};
  for (std::size_t axis = 0; axis < static_cast<std::size_t>(dimension); ++axis) {
    point.gradient[0][axis] = -1;
    point.gradient[axis + 1][axis] = 1;
  }
  return {point};
}

std::vector<ReferencePoint> prism_points() {
  const std::array<std::array<double, 2>, 3> inside{
      {{1.0 / 6, 1.0 / 6}, {2.0 / 3, 1.0 / 6}, {1.0 / 6, 2.0 / 3}}};
  std::vector<ReferencePoint> points;
  for (double t : gauss) {
    for (const auto& [x, y] : inside) {
      ReferencePoint point{1.0 / 12, {}};
      const std::array<Gradient, 3> share{{{-1, -1, 1 - x - y}, {1, 0, x}, {0, 1, y}}};
      for (std::size_t n = 0; n < 6; ++n) {
        const Gradient& s = share[n % 3];
        const int up = n < 3 ? 0 : 1;
        point.gradient[n] = {s[0] * ramp(up, t), s[1] * ramp(up, t), s[2] * slope(up)};
      }
      points.push_back(point);
    }
  }
  return points;
}

// 2 × 2 points of the base, where the four upper corners of a cube are one, the apex. F does not change along
// the line from a point to the apex, and (1 − ζ)² of the volume is integrated in closed form: 1/3.
std::vector<ReferencePoint> pyramid_points() {
  std::vector<ReferencePoint> points = box_points(2);
  for (std::size_t g = 0; g < points.size(); ++g) {
    points[g].weight /= 3;
    const double t[2] = {gauss[g & 1], gauss[g >> 1]};
    for (std::size_t n = 0; n < 4; ++n)
      points[g].gradient[n][2] = -ramp(unit_square[n][0], t[0]) * ramp(unit_square[n][1], t[1]);
    points[g].gradient[4] = {0, 0, 1};
  }
  return points;
}

// The same corners from a dart elsewhere in the element: `ways` lead from it to a dart where `words` start.
std::vector<std::vector<Word>> starting_with(const std::vector<Word>& ways, const std::vector<Word>& words) {
  std::vector<std::vector<Word>> units;
  for (const Word& way : ways) {
    units.emplace_back();
    for (const Word& word : words) units.back().push_back(way + word);
  }
  return units;
}

std::array<ElementShape, element_kinds> make_shapes() {
  using enum ElementKind;
  const std::vector<Word> prism{"", "0", "10", "210", "0210", "10210"}, pyramid{"", "0", "010", "10", "210"};
  const std::vector<Word> hexahedron{"", "0", "010", "10", "210", "0210", "010210", "10210"};
  return {
      ElementShape{Triangle, "triangle", "triangles", 2, 3, 6, {{"", "0", "10"}}, simplex_points(2)},
      ElementShape{Quad, "quad", "quads", 2, 4, 8, {{"", "0", "010", "10"}}, box_points(2)},
      ElementShape{
          Tetrahedron, "tetrahedron", "tetrahedra", 3, 4, 24, {{"", "0", "10", "210"}}, simplex_points(3)},
      ElementShape{Hexahedron, "hexahedron", "hexahedra", 3, 8, 48, {hexahedron}, box_points(3)},
      ElementShape{Prism, "prism", "prisms", 3, 6, 36, starting_with({"", "2", "12"}, prism), prism_points()},
      ElementShape{Pyramid, "pyramid", "pyramids", 3, 5, 32, starting_with({"", "2", "12", "012"}, pyramid),
                   pyramid_points()}};
}

// The darts of a small volume of triangles and quads, face by face, without a hash set.
struct SmallVolume {
  std::array<std::uint32_t, 48> darts; // at most those of a hexahedron
  std::size_t count = 0;
  int triangles = 0, quads = 0;

  // False: it has a free link, more darts, or other faces.
  bool walk(const GMap& map, Dart d) {
    if (!add_face(map, d)) return false;
    for (std::size_t at = 0; at < count; ++at) {
      const Dart next = map.alpha(2, Dart{darts[at]});
      if (next.value == darts[at] || (!has(next) && !add_face(map, next))) return false;
    }
    return true;
  }

private:
  bool has(Dart d) const {
    for (std::size_t n = 0; n < count; ++n)
      if (darts[n] == d.value) return true;
    return false;
  }
  bool add_face(const GMap& map, Dart d) {
    int sides = 0;
    Dart at = d;
    do {
      const Dart end = map.alpha(0, at), next = map.alpha(1, end);
      if (end == at || next == end || ++sides > 4 || count == darts.size()) return false;
      darts[count++] = at.value;
      darts[count++] = end.value;
      at = next;
    } while (at != d);
    ++(sides == 3 ? triangles : quads);
    return sides >= 3;
  }
};

int sides_here(const GMap& map, Dart d) { // of a closed face
  int darts = 0;
  walk_two(map, 0, 1, d, [&](Dart) { ++darts; });
  return darts / 2;
}

// Whether the words lead to different corners (the match is injective).
bool corners_differ(const GMap& map, Dart d, const std::vector<Word>& words) {
  std::array<Dart, most_particles> corner{};
  for (std::size_t n = 0; n < words.size(); ++n) {
    Dart least = map.follow(d, words[n]);
    walk_two(map, 1, 2, least, [&](Dart e) { least = std::min(least, e); });
    for (std::size_t m = 0; m < n; ++m)
      if (corner[m] == least) return false;
    corner[n] = least;
  }
  return true;
}

// The unit whose words start from d, determined by the number of sides of its face and of the adjacent faces.
std::size_t unit_from(const GMap& map, ElementKind kind, Dart d) {
  if (kind != ElementKind::Prism && kind != ElementKind::Pyramid) return 0;
  const int base = kind == ElementKind::Prism ? 3 : 4; // the number of sides of the face where the words start
  if (sides_here(map, d) == base) return 0;
  if (sides_here(map, map.alpha(2, d)) == base) return 1;
  if (sides_here(map, map.follow(d, Word("12"))) == base) return 2;
  return 3;
}

std::optional<ElementPlace> solid_at(const GMap& map, Dart d) {
  SmallVolume volume;
  if (!volume.walk(map, d)) return {};
  using enum ElementKind;
  const int triangles = volume.triangles, quads = volume.quads;
  ElementKind kind;
  if (triangles == 4 && quads == 0)
    kind = Tetrahedron;
  else if (triangles == 0 && quads == 6)
    kind = Hexahedron;
  else if (triangles == 2 && quads == 3)
    kind = Prism;
  else if (triangles == 4 && quads == 1)
    kind = Pyramid;
  else
    return {};
  const std::size_t unit = unit_from(map, kind, d);
  const ElementShape& shape = shape_of(kind);
  if (unit >= shape.units.size() || !corners_differ(map, d, shape.units[unit])) return {};
  return ElementPlace{kind, unit,
                      Dart{*std::min_element(volume.darts.begin(), volume.darts.begin() + volume.count)}};
}

} // namespace

const ElementShape& shape_of(ElementKind kind) {
  static const std::array<ElementShape, element_kinds> shapes = make_shapes();
  return shapes[static_cast<std::size_t>(kind)];
}

std::optional<ElementPlace> element_at(const GMap& map, Dart d) {
  if (map.dimension() == 3) return solid_at(map, d);
  const int sides = sides_of_face(map, d);
  if (sides != 3 && sides != 4) return {};
  Dart first = d;
  walk_two(map, 0, 1, d, [&](Dart e) { first = std::min(first, e); });
  return ElementPlace{sides == 3 ? ElementKind::Triangle : ElementKind::Quad, 0, first};
}

Eigen::Matrix3d rest_frame(const ElementShape& shape, const Vec3* rest) {
  const int around = shape.kind == ElementKind::Triangle || shape.kind == ElementKind::Tetrahedron ||
                             shape.kind == ElementKind::Prism
                         ? 3
                         : 4; // corners of the first face
  const Vec3 along = rest[1] - rest[0], across = rest[around - 1] - rest[0];
  Vec3 normal = along.cross(across);
  if (shape.kind == ElementKind::Quad) normal = (rest[2] - rest[0]).cross(rest[3] - rest[1]);
  Eigen::Matrix3d frame;
  frame.col(2) = normal.normalized();
  frame.col(0) = (along - along.dot(frame.col(2)) * frame.col(2)).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

bool write_element(const ElementShape& shape, const Vec3* rest, const Eigen::Matrix3d& frame, double thickness,
                   double* values) {
  const int dim = shape.dimension;
  std::fill(values, values + shape.values(), 0);
  double sign = 0;
  double* to = values;
  for (const ReferencePoint& point : shape.points) {
    Eigen::Matrix3d jacobian = Eigen::Matrix3d::Zero();
    for (int n = 1; n < shape.corners; ++n) {
      const Gradient& g = point.gradient[static_cast<std::size_t>(n)];
      jacobian += frame.transpose() * (rest[n] - rest[0]) * Vec3(g[0], g[1], g[2]).transpose();
    }
    if (dim == 2) jacobian.row(2) = Eigen::RowVector3d::UnitZ(), jacobian.col(2) = Vec3::UnitZ();
    const double determinant = jacobian.determinant();
    const double size = jacobian.col(0).norm() * jacobian.col(1).norm() * jacobian.col(2).norm();
    if (!(std::abs(determinant) > 1e-12 * size) || determinant * sign < 0) {
      std::fill(values, values + shape.values(), 0);
      return false;
    }
    sign = determinant;
    const Eigen::Matrix3d inverse = jacobian.inverse();
    for (int r = 0; r < dim; ++r)
      for (int c = 0; c < dim; ++c) *to++ = inverse(r, c);
    *to++ = std::abs(determinant) * point.weight * (dim == 2 ? thickness : 1);
  }
  return true;
}

} // namespace rend
