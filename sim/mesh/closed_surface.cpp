#include "sim/mesh/closed_surface.h"

#include "sim/base/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <utility>

namespace rend {
namespace {

using Number = std::uint32_t; // of a point
using Triangle = std::array<Number, 3>;
using Side = std::pair<Number, Number>; // the smaller index first

constexpr double tolerance = 1e-9; // relative to the size of the surface, or to its volume

Side side(Number a, Number b) {
  return std::minmax(a, b);
}

std::vector<Number> corners_of(const PolygonMesh& mesh, std::size_t polygon) {
  return {mesh.corners.begin() + mesh.first[polygon], mesh.corners.begin() + mesh.first[polygon + 1]};
}

// The polygons at each side.
std::map<Side, std::vector<std::size_t>> polygons_at(const PolygonMesh& mesh) {
  std::map<Side, std::vector<std::size_t>> at;
  for (std::size_t p = 0; p < mesh.polygons(); ++p) {
    const std::vector<Number> ring = corners_of(mesh, p);
    for (std::size_t n = 0; n < ring.size(); ++n) at[side(ring[n], ring[(n + 1) % ring.size()])].push_back(p);
  }
  return at;
}

bool leads(const std::vector<Number>& ring, Number from, Number to) {
  for (std::size_t n = 0; n < ring.size(); ++n)
    if (ring[n] == from && ring[(n + 1) % ring.size()] == to) return true;
  return false;
}

[[noreturn]] void refuse(const MeshFile& file, std::size_t polygon, const std::string& what,
                         const std::string& hint) {
  file.source.fail(file.origins.at(polygon).offset, what, hint);
}

// All rings, turned so that neighbours agree; the first keeps its sense.
std::vector<std::vector<Number>> oriented(const MeshFile& file, const PolygonMesh& mesh) {
  const auto at = polygons_at(mesh);
  for (const auto& [ends, polygons] : at)
    if (polygons.size() != 2)
      refuse(
          file, polygons.front(),
          fmt::format("the surface is not closed: its side from point {} to {} belongs to {}",
                      mesh.name(ends.first), mesh.name(ends.second),
                      polygons.size() == 1 ? "one polygon alone" : fmt::format("{} polygons", polygons.size())),
          "points may be there twice: `rend mesh convert IN OUT.msh --repair` merges them");
  std::vector<std::vector<Number>> rings;
  for (std::size_t p = 0; p < mesh.polygons(); ++p) rings.push_back(corners_of(mesh, p));
  std::vector<char> reached(rings.size(), 0);
  std::vector<std::size_t> open{0};
  reached[0] = 1;
  for (std::size_t n = 0; n < open.size(); ++n) {
    const std::vector<Number> ring = rings[open[n]];
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Number a = ring[k], b = ring[(k + 1) % ring.size()];
      const auto& both = at.at(side(a, b));
      const std::size_t other = both[0] == open[n] ? both[1] : both[0];
      if (!reached[other]) {
        if (leads(rings[other], a, b)) std::reverse(rings[other].begin(), rings[other].end());
        reached[other] = 1;
        open.push_back(other);
      } else if (leads(rings[other], a, b)) {
        refuse(file, other, "the surface has only one side, so that it has no inside",
               "such as a Klein bottle: fill a surface with two sides");
      }
    }
  }
  if (const auto apart = std::find(reached.begin(), reached.end(), 0); apart != reached.end())
    refuse(file, static_cast<std::size_t>(apart - reached.begin()),
           "the surface consists of several parts, of which one may lie in another",
           "put each into a file of its own");
  return rings;
}

void add_triangles(ClosedSurface& surface, std::vector<Number> ring) {
  const auto length = [&](Number a, Number b) { return (surface.points[a] - surface.points[b]).norm(); };
  if (ring.size() == 4 && length(ring[1], ring[3]) < length(ring[0], ring[2]))
    std::rotate(ring.begin(), ring.begin() + 1, ring.end());
  for (std::size_t n = 1; n + 1 < ring.size(); ++n)
    surface.triangles.push_back({ring[0], ring[n], ring[n + 1]});
}

double signed_volume(const ClosedSurface& surface) {
  const Vec3 origin = surface.points[surface.triangles.front()[0]];
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += (surface.points[a] - origin).dot((surface.points[b] - origin).cross(surface.points[c] - origin)) / 6;
  return sum;
}

// Points that no polygon uses are left out.
void drop_unused(ClosedSurface& surface) {
  std::vector<Number> number(surface.points.size(), 0);
  for (const Triangle& t : surface.triangles)
    for (const Number p : t) number[p] = 1;
  std::vector<Vec3> kept;
  for (std::size_t p = 0; p < number.size(); ++p) {
    if (number[p] == 0) continue;
    number[p] = static_cast<Number>(kept.size());
    kept.push_back(surface.points[p]);
  }
  surface.points = std::move(kept);
  for (Triangle& t : surface.triangles)
    for (Number& p : t) p = number[p];
}

} // namespace

double ClosedSurface::volume() const {
  return std::abs(signed_volume(*this));
}

double ClosedSurface::size() const {
  Eigen::AlignedBox3d box;
  for (const Vec3& x : points) box.extend(x);
  return box.diagonal().norm();
}

ClosedSurface closed_surface(const MeshFile& file) {
  const auto* mesh = std::get_if<PolygonMesh>(&file.mesh);
  if (!mesh || mesh->polygons() == 0)
    file.source.fail("only a surface of polygons can be filled",
                     "such as an .obj, .off or .msh file of triangles");
  ClosedSurface surface{mesh->points, {}};
  for (const std::vector<Number>& ring : oriented(file, *mesh)) add_triangles(surface, ring);
  drop_unused(surface);
  if (signed_volume(surface) < 0)
    for (Triangle& t : surface.triangles) std::swap(t[1], t[2]);
  if (!(surface.volume() > tolerance * power(surface.size(), 3)))
    file.source.fail("the surface encloses no volume");
  return surface;
}

namespace {

// The triangle divided at the middles of its long sides; middle[k]: of the side from corner k to the next.
void divide(const Triangle& t, const std::array<std::optional<Number>, 3>& middle,
            const std::vector<Vec3>& points, std::vector<Triangle>& out) {
  const int divided = middle[0].has_value() + middle[1].has_value() + middle[2].has_value();
  if (divided == 0) return out.push_back(t);
  if (divided == 3) {
    const Number a = *middle[0], b = *middle[1], c = *middle[2];
    for (const Triangle& part :
         {Triangle{t[0], a, c}, Triangle{a, t[1], b}, Triangle{c, b, t[2]}, Triangle{a, b, c}})
      out.push_back(part);
    return;
  }
  std::size_t k = 0; // so turned that the first side is divided; of two, the last is not
  while (!middle[k] || (divided == 2 && !middle[(k + 1) % 3])) ++k;
  const Number x = t[k], y = t[(k + 1) % 3], z = t[(k + 2) % 3], a = *middle[k];
  if (divided == 1) {
    out.push_back({x, a, z});
    out.push_back({a, y, z});
    return;
  }
  const Number b = *middle[(k + 1) % 3];
  out.push_back({a, y, b});
  const bool at_z = (points[a] - points[z]).norm() < (points[x] - points[b]).norm();
  out.push_back(at_z ? Triangle{x, a, z} : Triangle{x, a, b});
  out.push_back(at_z ? Triangle{a, b, z} : Triangle{x, b, z});
}

double area(const ClosedSurface& surface) {
  double sum = 0;
  for (const auto& [a, b, c] : surface.triangles)
    sum += (surface.points[b] - surface.points[a]).cross(surface.points[c] - surface.points[a]).norm() / 2;
  return sum;
}

[[noreturn]] void refuse_triangles() {
  throw UserError(Exit::Usage, {}, "the surface would have more than ten million triangles of this size",
                  "take a larger --size");
}

} // namespace

void check_cells_to_fill(const ClosedSurface& surface, double size) {
  constexpr double most_cells = 1e7, in_a_cube = 6;
  const double cells = in_a_cube * surface.volume() / (size * size * size);
  if (cells > most_cells)
    throw UserError(
        Exit::Usage, {},
        fmt::format("the solid would have about {:.2g} tetrahedra of this size; at most {:.0e} are made", cells,
                    most_cells),
        fmt::format("take a larger --size, of {:.2g} m or more",
                    power(in_a_cube * surface.volume() / most_cells, 1.0 / 3)));
}

void divide_edges(ClosedSurface& surface, double most) {
  constexpr std::size_t most_triangles = 10'000'000;
  // With sides of at most that length, no triangle is larger than an equilateral one.
  if (area(surface) / (std::sqrt(3.0) / 4 * most * most) > static_cast<double>(most_triangles))
    refuse_triangles();
  for (bool again = true; again;) {
    again = false;
    std::map<Side, Number> middles;
    std::vector<Triangle> out;
    for (const Triangle& t : surface.triangles) {
      std::array<std::optional<Number>, 3> middle;
      for (std::size_t k = 0; k < 3; ++k) {
        const Number a = t[k], b = t[(k + 1) % 3];
        if ((surface.points[a] - surface.points[b]).norm() <= most) continue;
        const auto [at, is_new] = middles.try_emplace(side(a, b), static_cast<Number>(surface.points.size()));
        if (is_new) surface.points.push_back(0.5 * (surface.points[a] + surface.points[b]));
        middle[k] = at->second;
        again = true;
      }
      divide(t, middle, surface.points, out);
    }
    surface.triangles = std::move(out);
    if (surface.triangles.size() > most_triangles) refuse_triangles();
  }
}

std::string msh_text(const ClosedSurface& surface) {
  std::string out = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n";
  out += fmt::format("{}\n", surface.points.size());
  for (std::size_t n = 0; n < surface.points.size(); ++n) {
    const Vec3& x = surface.points[n];
    out += fmt::format("{} {:.17g} {:.17g} {:.17g}\n", n + 1, x.x(), x.y(), x.z());
  }
  out += fmt::format("$EndNodes\n$Elements\n{}\n", surface.triangles.size());
  for (std::size_t n = 0; n < surface.triangles.size(); ++n) {
    const auto& [a, b, c] = surface.triangles[n];
    out += fmt::format("{} 2 2 1 1 {} {} {}\n", n + 1, a + 1, b + 1, c + 1);
  }
  return out + "$EndElements\n";
}

namespace {

// Finds points again, within a distance.
class Places {
public:
  Places(const std::vector<Vec3>& points, double within) : points_(points), within_(within) {
    for (Number p = 0; p < points.size(); ++p) at_[cell(points[p])].push_back(p);
  }
  std::optional<Number> find(const Vec3& x) const {
    const Cell middle = cell(x);
    for (int n = 0; n < 27; ++n) {
      const auto there = at_.find({middle[0] + n % 3 - 1, middle[1] + n / 3 % 3 - 1, middle[2] + n / 9 - 1});
      if (there == at_.end()) continue;
      for (const Number p : there->second)
        if ((points_[p] - x).norm() <= within_) return p;
    }
    return {};
  }

private:
  using Cell = std::array<long long, 3>;
  Cell cell(const Vec3& x) const {
    const auto along = [&](int axis) { return static_cast<long long>(std::floor(x[axis] / within_)); };
    return {along(0), along(1), along(2)};
  }
  const std::vector<Vec3>& points_;
  double within_;
  std::map<Cell, std::vector<Number>> at_;
};

Triangle sorted(Triangle t) {
  std::sort(t.begin(), t.end());
  return t;
}

// Faces of one tetrahedron alone, by the points of the surface; those with other points have the number `none`.
std::vector<Triangle> boundary_of(const CellMesh& solid, const ClosedSurface& surface, Number none) {
  const Places places(surface.points, tolerance * surface.size());
  std::vector<Triangle> faces, alone;
  for (std::size_t c = 0; c < solid.cells(); ++c)
    for (std::size_t left_out = 0; left_out < 4; ++left_out) {
      Triangle face{};
      for (std::size_t n = 0, k = 0; n < 4; ++n)
        if (n != left_out) face[k++] = solid.corners_of(c)[n];
      faces.push_back(sorted(face));
    }
  std::sort(faces.begin(), faces.end());
  for (std::size_t n = 0; n < faces.size();) {
    std::size_t end = n + 1;
    while (end < faces.size() && faces[end] == faces[n]) ++end;
    if (end == n + 1) alone.push_back(faces[n]);
    n = end;
  }
  for (Triangle& face : alone) {
    for (Number& p : face) p = places.find(solid.points[p]).value_or(none);
    face = sorted(face);
  }
  std::sort(alone.begin(), alone.end());
  return alone;
}

} // namespace

std::string flaw_of_filling(const CellMesh& solid, const ClosedSurface& surface) {
  double sum = 0;
  for (std::size_t c = 0; c < solid.cells(); ++c) {
    if (solid.kinds[c] != CellKind::Tetrahedron) return fmt::format("cell {} is no tetrahedron", c);
    const double volume = signed_volume(solid, c);
    if (!(volume > 0)) return fmt::format("tetrahedron {} has the volume {:.3g} m3", c, volume);
    sum += volume;
  }
  std::vector<Triangle> wanted;
  for (const Triangle& t : surface.triangles) wanted.push_back(sorted(t));
  std::sort(wanted.begin(), wanted.end());
  const auto none = static_cast<Number>(surface.points.size());
  const std::vector<Triangle> boundary = boundary_of(solid, surface, none);
  std::vector<Triangle> differ;
  std::set_symmetric_difference(wanted.begin(), wanted.end(), boundary.begin(), boundary.end(),
                                std::back_inserter(differ));
  if (!differ.empty())
    return fmt::format("its boundary differs from the surface in {} triangles of {}", differ.size(),
                       wanted.size());
  if (std::abs(sum - surface.volume()) > tolerance * surface.volume())
    return fmt::format("its volume is {:.12g} m3, that within the surface {:.12g} m3", sum, surface.volume());
  return {};
}

} // namespace rend
