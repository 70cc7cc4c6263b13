#include "sim/mesh/reader.h"

#include "sim/base/wording.h"
#include "sim/embedding/cell_size.h"
#include "sim/mesh/fault.h"
#include "sim/mesh/locality.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace rend {

const std::vector<MeshReader>& all_readers() {
  static const std::vector<MeshReader> readers{msh_reader(), obj_reader(), off_reader(), moka_reader()};
  return readers;
}

MeshFile read_mesh(MeshSource source) {
  std::string extension = std::filesystem::path(source.name()).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 'a' - 'A') : c; });
  std::vector<std::string> known;
  for (const MeshReader& reader : all_readers()) {
    for (const std::string& each : reader.extensions) {
      known.push_back(each);
      if (each != extension) continue;
      MeshFile file{std::move(source), {}, {}, {}, {}, {}};
      reader.read(file);
      for (auto& [name, points] : file.groups) {
        std::sort(points.begin(), points.end());
        points.erase(std::unique(points.begin(), points.end()), points.end());
      }
      return file;
    }
  }
  source.fail(extension.empty() ? "a mesh file needs an extension that tells its format"
                                : fmt::format("{} is no mesh format that can be read", in_quotes(extension)),
              suggestion(extension, known, "formats"));
}

MeshFile read_mesh(const std::filesystem::path& path) {
  return read_mesh(MeshSource::open(path));
}

namespace {

[[noreturn]] void refuse(const MeshFile& file, const std::string& kind, std::size_t element,
                         const std::string& flaw) {
  const Origin& origin = file.origins.at(element);
  file.source.fail(origin.offset, fmt::format("{} {} {}", kind, origin.tag, flaw));
}

// Refuses areas that are round-off.
void check_areas(const MeshFile& file, const PolygonMesh& mesh) {
  for (std::size_t p = 0; p < mesh.polygons(); ++p) {
    const PolygonExtent extent = extent_of(mesh, p);
    if (!extent.has_area()) refuse(file, "polygon", p, flaw_of_area(extent.area, std::sqrt(extent.square)));
  }
}

bool is_closed(const GMap& map) {
  bool closed = true;
  map.for_each_dart([&](Dart d) { closed = closed && map.alpha(2, d) != d; });
  return closed;
}

MeshBody sewn(MeshFile& file, PolygonMesh& mesh, std::vector<std::uint32_t>& point) {
  try {
    SewnSheet sheet = sew_polygons(mesh);
    check_areas(file, mesh);
    point = std::move(sheet.point);
    if (is_closed(sheet.map->map()))
      file.notes.push_back(file.source.name() +
                           ": the surface is closed, and becomes a hollow sheet; `rend mesh fill` makes a "
                           "solid of it");
    return {std::move(sheet.map), {}, std::move(file.notes)};
  } catch (const MeshFault& fault) {
    refuse(file, "polygon", fault.element, fault.flaw);
  }
}

MeshBody sewn(MeshFile& file, CellMesh& mesh, std::vector<std::uint32_t>& point) {
  try {
    SewnSolid solid = sew_cells(mesh);
    point = std::move(solid.point);
    if (solid.turned > 0)
      file.notes.push_back(fmt::format("{}: {} of {} cells were inside out and have been turned",
                                       file.source.name(), solid.turned, mesh.cells()));
    return {std::move(solid.map), {}, std::move(file.notes)};
  } catch (const MeshFault& fault) {
    refuse(file, shape_of(mesh.kinds[fault.element]).name, fault.element, fault.flaw);
  }
}

MeshBody sewn(MeshFile& file, MapMesh& mesh, std::vector<std::uint32_t>& point) {
  MeshBody body;
  body.map = std::make_unique<EmbeddedMap>(std::move(mesh.map), [&](Dart d) {
    point.push_back(mesh.point[d.value]);
    const Vec3& x = mesh.points[point.back()];
    return Point{x, x, Vec3::Zero()};
  });
  const bool solid = body.map->dimension() == 3;
  const CellIndex elements(body.map->map(), element_orbit(body.map->dimension()));
  for (Slot e = 0; e < elements.slots(); ++e) {
    const Dart d = elements.first_dart(e);
    const double extent = solid ? rest_volume(*body.map, d) : rest_area(*body.map, d);
    double square = 0;
    for (const Dart corner : darts_of(body.map->map(), elements.orbit(), d))
      square = std::max(square, (body.map->rest_of(corner) - body.map->rest_of(d)).squaredNorm());
    if (!(extent > 1e-12 * square * (solid ? std::sqrt(square) : 1)))
      refuse(file, "dart", d.value,
             solid ? "belongs to a volume that " + flaw_of_volume(extent, std::sqrt(square))
                   : "belongs to a face that " + flaw_of_area(extent, std::sqrt(square)));
  }
  body.notes = std::move(file.notes);
  return body;
}

template <class Mesh> void put_in_order(MeshFile& file, Mesh& mesh) {
  const std::vector<std::uint32_t> order = order_for_locality(mesh);
  if (order.empty()) return;
  mesh = reordered(mesh, order);
  std::vector<Origin> origins;
  for (const std::uint32_t n : order) origins.push_back(file.origins.at(n));
  file.origins = std::move(origins);
}

void put_in_order(MeshFile&, MapMesh&) {} // not for a map: the file defines the order of its darts

} // namespace

void order_for_locality(MeshFile& file) {
  std::visit([&](auto& mesh) { put_in_order(file, mesh); }, file.mesh);
}

MeshBody sew(MeshFile file) {
  std::vector<std::uint32_t> point; // of each vertex slot
  MeshBody body = std::visit([&](auto& mesh) { return sewn(file, mesh, point); }, file.mesh);
  std::vector<Slot> slots(point.size()); // by increasing point
  std::iota(slots.begin(), slots.end(), 0u);
  std::stable_sort(slots.begin(), slots.end(), [&](Slot a, Slot b) { return point[a] < point[b]; });
  for (const auto& [name, points] : file.groups) {
    std::vector<Slot>& chosen = body.groups[name];
    for (const std::uint32_t p : points) {
      auto v = std::lower_bound(slots.begin(), slots.end(), p,
                                [&](Slot a, std::uint32_t q) { return point[a] < q; });
      for (; v != slots.end() && point[*v] == p; ++v) chosen.push_back(*v);
    }
    std::sort(chosen.begin(), chosen.end());
  }
  return body;
}

} // namespace rend
