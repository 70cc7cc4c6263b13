#include "sim/mesh/cells.h"

#include "sim/base/check.h"
#include "sim/mesh/fault.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace rend {

void CellMesh::add(CellKind kind, std::span<const std::uint32_t> cell) {
  CHECK(cell.size() == static_cast<std::size_t>(shape_of(kind).corners));
  if (first.empty()) first.push_back(0);
  kinds.push_back(kind);
  corners.insert(corners.end(), cell.begin(), cell.end());
  first.push_back(static_cast<std::uint32_t>(corners.size()));
}

void CellMesh::add(CellKind kind, std::initializer_list<std::uint32_t> cell) {
  add(kind, std::span<const std::uint32_t>(cell.begin(), cell.size()));
}

double signed_volume(const CellMesh& mesh, std::size_t cell) {
  const CellShape& shape = shape_of(mesh.kinds[cell]);
  const auto corners = mesh.corners_of(cell);
  const Vec3& origin = mesh.points[corners[0]];
  const auto at = [&](int corner) -> Vec3 {
    return mesh.points[corners[static_cast<std::size_t>(corner)]] - origin;
  };
  double sixfold = 0; // negative sign: the rings are counter-clockwise as seen from inside
  for (std::size_t f = 0; f < static_cast<std::size_t>(shape.faces); ++f) {
    const auto n = static_cast<std::size_t>(shape.sides[f]);
    const auto& ring = shape.ring[f];
    if (n == 3) {
      sixfold -= at(ring[0]).dot(at(ring[1]).cross(at(ring[2])));
      continue;
    }
    // Σ a × b over the sides of a quad is the cross product of its diagonals.
    const Vec3 a = at(ring[0]), b = at(ring[1]), c = at(ring[2]), d = at(ring[3]);
    sixfold -= 0.25 * (a + b + c + d).dot((c - a).cross(d - b));
  }
  return sixfold / 6;
}

namespace {

[[noreturn]] void refuse(const CellMesh& mesh, std::size_t cell, const std::string& flaw) {
  throw MeshFault(shape_of(mesh.kinds[cell]).name, cell, flaw);
}

void check_corners(const CellMesh& mesh, std::size_t cell) {
  const auto corners = mesh.corners_of(cell);
  for (auto c = corners.begin(); c != corners.end(); ++c) {
    if (*c >= mesh.points.size())
      refuse(mesh, cell, fmt::format("has a corner {}, and there are {} points", *c, mesh.points.size()));
    if (!mesh.points[*c].allFinite())
      refuse(mesh, cell, fmt::format("has its corner {} at a place that is not finite", mesh.name(*c)));
    if (std::find(corners.begin(), c, *c) != c)
      refuse(mesh, cell, fmt::format("meets point {} twice", mesh.name(*c)));
  }
}

// Whether the cell is inverted. A volume below 1e-12 of its length cubed is round-off: such a cell has no
// volume.
bool inside_out(const CellMesh& mesh, std::size_t cell) {
  const double volume = signed_volume(mesh, cell);
  double square = 0;
  for (const std::uint32_t c : mesh.corners_of(cell))
    square = std::max(square, (mesh.points[c] - mesh.points[mesh.corners_of(cell)[0]]).squaredNorm());
  if (!(std::abs(volume) > 1e-12 * square * std::sqrt(square)))
    refuse(mesh, cell, flaw_of_volume(volume, std::sqrt(square)));
  return volume < 0;
}

// The mesh with its inverted cells corrected, and the first dart of each cell.
struct Cells {
  const CellMesh& mesh;
  std::vector<std::uint32_t> corners; // like mesh.corners
  std::vector<std::uint32_t> dart;    // the first of each cell, and one more entry
  std::size_t turned = 0;

  explicit Cells(const CellMesh& from) : mesh(from), corners(from.corners), dart(from.cells() + 1, 0) {
    std::uint64_t darts = 0;
    for (std::size_t c = 0; c < mesh.cells(); ++c) {
      const CellShape& shape = shape_of(mesh.kinds[c]);
      darts += static_cast<std::uint64_t>(shape.darts);
      if (darts >= Dart::none_value) refuse(mesh, c, "is one too many: a mesh holds at most 2^32 darts");
      dart[c + 1] = static_cast<std::uint32_t>(darts);
      check_corners(mesh, c);
      if (!inside_out(mesh, c)) continue;
      ++turned;
      for (const auto& [a, b] : shape.mirror) std::swap(corner(c, a), corner(c, b));
    }
  }

  std::uint32_t& corner(std::size_t cell, int n) {
    return corners[mesh.first[cell] + static_cast<std::size_t>(n)];
  }
  std::uint32_t corner(std::size_t cell, int n) const {
    return corners[mesh.first[cell] + static_cast<std::size_t>(n)];
  }
  std::size_t cell_of(Dart d) const {
    return static_cast<std::size_t>(std::upper_bound(dart.begin(), dart.end(), d.value) - dart.begin()) - 1;
  }
};

// α0 to α2 of a cell, from its first dart on; every dart is α3-free.
std::vector<GMap::Links> links_of(const CellShape& shape) {
  std::vector<GMap::Links> links;
  for (std::uint32_t d = 0; d < static_cast<std::uint32_t>(shape.darts); ++d)
    links.push_back({d ^ 1U, shape.alpha1[d], shape.alpha2[d], d});
  return links;
}

void link_cells(MapEdit& edit, const Cells& cells) {
  std::array<std::vector<GMap::Links>, cell_shapes::all.size()> links;
  for (std::size_t kind = 0; kind < links.size(); ++kind) links[kind] = links_of(cell_shapes::all[kind]);
  for (const CellKind kind : cells.mesh.kinds) edit.add_linked(links[static_cast<std::size_t>(kind)]);
}

// A face as its ring of points, from the smallest point towards its smaller neighbour: two faces have the same
// ring if and only if these are equal, and then their darts correspond.
struct Side {
  std::uint32_t next, before; // the smallest point's neighbours, the smaller one first
  std::uint32_t across;       // of a quad, the opposite point; none of a triangle
  // at the smallest point on the side to `next`; even if the ring is listed in that direction
  std::uint32_t dart;
  bool triangle() const { return across == Dart::none_value; }
  auto key() const { return std::tie(next, before, across); }
};

struct Face {
  std::uint32_t smallest;
  Side side;
};

Face face_of(const Cells& cells, std::size_t cell, std::size_t f) {
  const CellShape& shape = shape_of(cells.mesh.kinds[cell]);
  const auto n = static_cast<std::size_t>(shape.sides[f]);
  std::array<std::uint32_t, 4> ring{};
  for (std::size_t s = 0; s < n; ++s) ring[s] = cells.corner(cell, shape.ring[f][s]);
  std::size_t low = 0;
  for (std::size_t s = 1; s < n; ++s)
    if (ring[s] < ring[low]) low = s;
  const std::uint32_t after = ring[(low + 1) % n], before = ring[(low + n - 1) % n];
  const std::size_t dart = after < before ? 2 * low : 2 * ((low + n - 1) % n) + 1;
  return {ring[low],
          {std::min(after, before), std::max(after, before), n == 4 ? ring[(low + 2) % 4] : Dart::none_value,
           cells.dart[cell] + static_cast<std::uint32_t>(shape.first[f]) + static_cast<std::uint32_t>(dart)}};
}

// All faces of all cells, bucketed by their smallest point and sorted within a bucket: linear, since few share
// one, and n log n at worst.
struct Buckets {
  std::vector<std::uint32_t> start; // one per point, and one for the end
  std::vector<Side> sides;

  explicit Buckets(const Cells& cells) : start(cells.mesh.points.size() + 1, 0) {
    const auto each_face = [&](auto&& f) {
      for (std::size_t c = 0; c < cells.mesh.cells(); ++c)
        for (int n = 0; n < shape_of(cells.mesh.kinds[c]).faces; ++n)
          f(face_of(cells, c, static_cast<std::size_t>(n)));
    };
    each_face([&](const Face& face) { ++start[face.smallest + 1]; });
    for (std::size_t p = 0; p + 1 < start.size(); ++p) start[p + 1] += start[p];
    sides.resize(start.back());
    std::vector<std::uint32_t> at(start.begin(), start.end() - 1);
    each_face([&](const Face& face) { sides[at[face.smallest]++] = face.side; });
    for (std::size_t p = 0; p + 1 < start.size(); ++p)
      std::sort(sides.begin() + start[p], sides.begin() + start[p + 1], [](const Side& a, const Side& b) {
        return std::tie(a.next, a.before, a.across, a.dart) < std::tie(b.next, b.before, b.across, b.dart);
      });
  }
};

std::string ring_text(const CellMesh& mesh, std::uint32_t smallest, const Side& side) {
  const std::uint64_t a = mesh.name(smallest), b = mesh.name(side.next), c = mesh.name(side.before);
  return side.triangle() ? fmt::format("{} {} {}", a, b, c)
                         : fmt::format("{} {} {} {}", a, b, mesh.name(side.across), c);
}

// Links all darts of two faces with the same ring by α3. Both rings are oriented as seen from inside, so those
// of cells on opposite sides run in opposite directions.
void sew_faces(MapEdit& edit, const Cells& cells, std::uint32_t smallest, const Side& one, const Side& other) {
  if ((one.dart - other.dart) % 2 == 0) {
    const std::size_t mine = cells.cell_of(Dart{one.dart}), theirs = cells.cell_of(Dart{other.dart});
    refuse(cells.mesh, std::max(mine, theirs),
           fmt::format("overlaps {} {}: both lie on the same side of the face with the points {}",
                       shape_of(cells.mesh.kinds[std::min(mine, theirs)]).name,
                       cells.mesh.cell_name(std::min(mine, theirs)), ring_text(cells.mesh, smallest, one)));
  }
  Dart d{one.dart}, e{other.dart};
  for (int n = 0; n < (one.triangle() ? 6 : 8); ++n) {
    edit.link(3, d, e);
    d = edit.map().alpha(n % 2, d);
    e = edit.map().alpha(n % 2, e);
  }
}

// Refuses unmatched faces that overlap: a triangle on a quad, a quad on a quad with another cyclic order.
void check_open(const Cells& cells, std::uint32_t smallest, std::span<const Side> open) {
  for (const Side& quad : open) {
    if (quad.triangle()) continue;
    const auto refuse_beside = [&](std::uint32_t a, std::uint32_t b, std::uint32_t across) {
      const Side wanted{std::min(a, b), std::max(a, b), across, 0};
      const auto found = std::lower_bound(open.begin(), open.end(), wanted,
                                          [](const Side& s, const Side& t) { return s.key() < t.key(); });
      if (found == open.end() || found->key() != wanted.key()) return;
      const std::size_t mine = cells.cell_of(Dart{quad.dart}), theirs = cells.cell_of(Dart{found->dart});
      refuse(
          cells.mesh, mine,
          fmt::format("has a face with the points {}, on which {} {} lies with its face {}: they do not match",
                      ring_text(cells.mesh, smallest, quad), shape_of(cells.mesh.kinds[theirs]).name,
                      cells.mesh.cell_name(theirs), ring_text(cells.mesh, smallest, *found)));
    };
    refuse_beside(quad.next, quad.before, Dart::none_value);
    refuse_beside(quad.next, quad.across, Dart::none_value);
    refuse_beside(quad.before, quad.across, Dart::none_value);
    refuse_beside(quad.next, quad.across, quad.before);
    refuse_beside(quad.before, quad.across, quad.next);
  }
}

void sew_all(MapEdit& edit, const Cells& cells, const Buckets& buckets) {
  std::vector<Side> open;
  for (std::uint32_t p = 0; p + 1 < buckets.start.size(); ++p) {
    open.clear();
    const std::size_t end = buckets.start[p + 1];
    for (std::size_t n = buckets.start[p], same; n < end; n = same) {
      const Side& side = buckets.sides[n];
      for (same = n + 1; same < end && buckets.sides[same].key() == side.key();) ++same;
      if (same - n > 2)
        refuse(cells.mesh, cells.cell_of(Dart{buckets.sides[n + 2].dart}),
               fmt::format("shares the face with the points {} with more than one other",
                           ring_text(cells.mesh, p, side)));
      if (same - n == 2)
        sew_faces(edit, cells, p, side, buckets.sides[n + 1]);
      else
        open.push_back(side);
    }
    check_open(cells, p, open);
  }
}

} // namespace

SewnSolid sew_cells(const CellMesh& mesh) {
  const Cells cells(mesh);
  GMap map(3);
  MapEdit edit(map);
  edit.reserve(cells.dart.back());
  link_cells(edit, cells);
  sew_all(edit, cells, Buckets(cells));
  SewnSolid solid;
  solid.turned = cells.turned;
  std::size_t cell = 0;
  solid.map = std::make_unique<EmbeddedMap>(std::move(map), [&](Dart d) { // in the order of increasing darts
    while (cells.dart[cell + 1] <= d.value) ++cell;
    solid.point.push_back(cells.corner(cell, shape_of(mesh.kinds[cell]).corner[d.value - cells.dart[cell]]));
    const Vec3& x = mesh.points[solid.point.back()];
    return Point{x, x, Vec3::Zero()};
  });
  return solid;
}

} // namespace rend
