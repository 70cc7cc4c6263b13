#include "render/facts/mesh_facts.h"

#include "render/console/json_or_null.h"
#include "sim/base/enum_words.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"
#include "sim/mechanics/mass.h"
#include "sim/mesh/dart_order.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace rend {
namespace {

std::string kind_of(const EmbeddedMap& body, Dart d) {
  if (body.dimension() == 2) {
    const std::size_t sides = darts_of(body.map(), FaceOfVolume, d).size() / 2;
    return sides == 3 ? "triangles" : sides == 4 ? "quads" : "polygons";
  }
  static constexpr EnumWords<CellKind::Pyramid> words{"tetrahedra", "hexahedra", "prisms", "pyramids"};
  for (const CellKind kind : {CellKind::Tetrahedron, CellKind::Hexahedron, CellKind::Prism, CellKind::Pyramid})
    if (!darts_in_shape_order(body.map(), shape_of(kind), d).empty()) return words[kind];
  return "polyhedra";
}

std::string point(const Vec3& p) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", p.x(), p.y(), p.z());
}

nlohmann::ordered_json json_of(const char* what, const WorstElement& worst) {
  const auto finite = std::isfinite(worst.value) ? std::optional(worst.value) : std::nullopt;
  return {{what, json_or_null(finite)},
          {"element", worst.element},
          {"kind", worst.kind},
          {"centre", {worst.centre.x(), worst.centre.y(), worst.centre.z()}}};
}

nlohmann::ordered_json json_of(const MeshQuality& q) {
  return {{"least_angle", json_of("degrees", q.least_angle)},
          {"greatest_angle", json_of("degrees", q.greatest_angle)},
          {"aspect", json_of("ratio", q.aspect)},
          {"smallest", json_of("of_mean", q.smallest)},
          {"largest", json_of("of_mean", q.largest)}};
}

std::string quality_in_words(const MeshQuality& q, bool solid) {
  const auto line = [](const std::string& what, const WorstElement& worst) {
    return fmt::format("  {}: {} {} near {}\n", what, worst.kind, worst.element, point(worst.centre));
  };
  const char *angle = solid ? "dihedral angle" : "angle", *size = solid ? "volume" : "area";
  return line(fmt::format("smallest {} {:.4g} degrees", angle, q.least_angle.value), q.least_angle) +
         line(fmt::format("largest {} {:.4g} degrees", angle, q.greatest_angle.value), q.greatest_angle) +
         line(fmt::format("worst aspect ratio {:.3g} (equal sides: 1)", q.aspect.value), q.aspect) +
         line(fmt::format("smallest {} {:.3g} of the mean", size, q.smallest.value), q.smallest) +
         line(fmt::format("largest {} {:.3g} of the mean", size, q.largest.value), q.largest);
}

} // namespace

MeshFacts mesh_facts(const MeshBody& mesh, const std::string& file) {
  const EmbeddedMap& body = *mesh.map;
  MeshFacts facts;
  facts.file = file;
  facts.dimension = body.dimension();
  facts.counts = count_cells(body.map());
  facts.darts = body.map().dart_count();
  const CellIndex elements(body.map(), element_orbit(body.dimension()));
  for (Slot e = 0; e < elements.slots(); ++e) {
    const Dart d = elements.first_dart(e);
    ++facts.elements[kind_of(body, d)];
    facts.extent += facts.solid() ? rest_volume(body, d) : rest_area(body, d);
  }
  facts.quality = mesh_quality(body);
  facts.low = Vec3::Constant(1e300);
  facts.high = -facts.low;
  for (Slot v = 0; v < body.cells(Vertex).slots(); ++v) {
    facts.low = facts.low.cwiseMin(body.rest()[v].vec());
    facts.high = facts.high.cwiseMax(body.rest()[v].vec());
  }
  for (const auto& [name, slots] : mesh.groups) facts.groups[name] = slots.size();
  facts.notes = mesh.notes;
  return facts;
}

std::string slivers_in_words(const EmbeddedMap& map) {
  constexpr double least = 10, greatest = 160; // [degrees], of an element that is no sliver
  const CellIndex elements(map.map(), element_orbit(map.dimension()));
  std::size_t slivers = 0;
  ElementQuality worst, all{180, 0, 1, 0};
  Vec3 place = Vec3::Zero();
  for (Slot e = 0; e < elements.slots(); ++e) {
    const ElementQuality q = quality_of(map, elements.first_dart(e));
    all.least_angle = std::min(all.least_angle, q.least_angle);
    all.greatest_angle = std::max(all.greatest_angle, q.greatest_angle);
    if (q.least_angle >= least && q.greatest_angle <= greatest) continue;
    ++slivers;
    if (slivers > 1 && q.aspect <= worst.aspect) continue;
    worst = q;
    place = element_centre(map, elements.first_dart(e));
  }
  if (slivers == 0)
    return fmt::format("no slivers: dihedral angles from {:.3g} to {:.3g} degrees", all.least_angle,
                       all.greatest_angle);
  return fmt::format(
      "{} of {} elements {}, with dihedral angles below {:g} or above {:g} degrees; the worst, from "
      "{:.3g} to {:.3g} degrees, is near {} m. They limit the step of explicit schemes: take another "
      "size, or allow <time mass-scaling=\"0.01\">",
      slivers, elements.slots(), slivers == 1 ? "is a sliver" : "are slivers", least, greatest,
      worst.least_angle, worst.greatest_angle, point(place));
}

nlohmann::ordered_json json_of(const MeshFacts& f) {
  nlohmann::ordered_json groups = nlohmann::ordered_json::object();
  for (const auto& [name, vertices] : f.groups) groups[name] = vertices;
  return {{"file", f.file},
          {"kind", f.solid() ? "solid" : "sheet"},
          {"vertices", f.counts.vertices},
          {"edges", f.counts.edges},
          {"faces", f.counts.faces},
          {"volumes", f.counts.volumes},
          {"fragments", f.counts.fragments},
          {"euler", f.counts.euler},
          {"darts", f.darts},
          {"elements", f.elements},
          {"low", {f.low.x(), f.low.y(), f.low.z()}},
          {"high", {f.high.x(), f.high.y(), f.high.z()}},
          {f.solid() ? "volume" : "area", f.extent},
          {"quality", json_of(f.quality)},
          {"groups", std::move(groups)},
          {"notes", f.notes}};
}

std::string facts_in_words(const MeshFacts& f) {
  const CellCounts& n = f.counts;
  std::string out = fmt::format("{}: a {} of {} vertices, {} edges, {} faces", printable(f.file),
                                f.solid() ? "solid" : "sheet", n.vertices, n.edges, n.faces);
  if (f.solid()) out += fmt::format(", {} volumes", n.volumes);
  out += fmt::format("; {} darts\n", f.darts);
  out += fmt::format("  {} fragment{}, Euler characteristic {}\n", n.fragments, n.fragments == 1 ? "" : "s",
                     n.euler);
  for (const auto& [kind, count] : f.elements) out += fmt::format("  {} {}\n", count, kind);
  out += fmt::format("  from {} to {} m, {} {:.6g} {}\n", point(f.low), point(f.high),
                     f.solid() ? "volume" : "area", f.extent, f.solid() ? "m3" : "m2");
  out += quality_in_words(f.quality, f.solid());
  for (const auto& [name, count] : f.groups)
    out += fmt::format("  group {}: {} vertices\n", in_quotes(name), count);
  for (const std::string& note : f.notes) out += fmt::format("  note: {}\n", printable(note));
  return out;
}

} // namespace rend
