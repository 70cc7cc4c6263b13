#include "render/facts/mesh_facts.h"

#include "render/console/json_text.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"
#include "sim/mechanics/mass.h"
#include "sim/mesh/dart_order.h"
#include "sim/topology/count.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

namespace rend {
namespace {

std::string kind_of(const EmbeddedMap& body, Dart d) {
  if (body.dimension() == 2) {
    const std::size_t sides = darts_of(body.map(), FaceOfVolume, d).size() / 2;
    return sides == 3 ? "triangles" : sides == 4 ? "quads" : "polygons";
  }
  for (const auto& [kind, name] : {std::pair{CellKind::Tetrahedron, "tetrahedra"},
                                   {CellKind::Hexahedron, "hexahedra"},
                                   {CellKind::Prism, "prisms"},
                                   {CellKind::Pyramid, "pyramids"}})
    if (!laid_out(body.map(), shape_of(kind), d).empty()) return name;
  return "polyhedra";
}

} // namespace

nlohmann::ordered_json mesh_facts(const MeshBody& mesh, const std::string& file) {
  const EmbeddedMap& body = *mesh.map;
  const bool solid = body.dimension() == 3;
  const CellCounts counts = count_cells(body.map());
  nlohmann::ordered_json facts{{"file", file},
                               {"kind", solid ? "solid" : "sheet"},
                               {"vertices", counts.vertices},
                               {"edges", counts.edges},
                               {"faces", counts.faces},
                               {"volumes", counts.volumes},
                               {"fragments", counts.fragments},
                               {"euler", counts.euler},
                               {"darts", body.map().dart_count()}};
  const CellIndex elements(body.map(), element_orbit(body.dimension()));
  std::map<std::string, std::size_t> kinds;
  double extent = 0;
  for (Slot e = 0; e < elements.slots(); ++e) {
    const Dart d = elements.first_dart(e);
    ++kinds[kind_of(body, d)];
    extent += solid ? rest_volume(body, d) : rest_area(body, d);
  }
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (Slot v = 0; v < body.cells(Vertex).slots(); ++v) {
    low = low.cwiseMin(body.rest()[v].vec());
    high = high.cwiseMax(body.rest()[v].vec());
  }
  facts["elements"] = kinds;
  facts["low"] = {low.x(), low.y(), low.z()};
  facts["high"] = {high.x(), high.y(), high.z()};
  facts[solid ? "volume" : "area"] = extent;
  facts["groups"] = nlohmann::ordered_json::object();
  for (const auto& [name, slots] : mesh.groups) facts["groups"][name] = slots.size();
  facts["notes"] = mesh.notes;
  return facts;
}

std::string facts_in_json(const nlohmann::ordered_json& facts) {
  return text_of(facts, 2) + "\n";
}

std::string facts_in_words(const nlohmann::ordered_json& f) {
  const auto number = [&](const char* key) { return f[key].get<std::size_t>(); };
  const bool solid = f["kind"] == "solid";
  std::string out =
      fmt::format("{}: a {} of {} vertices, {} edges, {} faces", printable(f["file"].get<std::string>()),
                  f["kind"].get<std::string>(), number("vertices"), number("edges"), number("faces"));
  if (solid) out += fmt::format(", {} volumes", number("volumes"));
  out += fmt::format("; {} darts\n", number("darts"));
  out += fmt::format("  {} fragment{}, Euler characteristic {}\n", number("fragments"),
                     number("fragments") == 1 ? "" : "s", f["euler"].get<long>());
  for (const auto& [kind, count] : f["elements"].items())
    out += fmt::format("  {} {}\n", count.get<std::size_t>(), kind);
  const auto point = [&](const char* key) {
    return fmt::format("({:.6g}, {:.6g}, {:.6g})", f[key][0].get<double>(), f[key][1].get<double>(),
                       f[key][2].get<double>());
  };
  out +=
      fmt::format("  from {} to {} m, {} {:.6g} {}\n", point("low"), point("high"), solid ? "volume" : "area",
                  f[solid ? "volume" : "area"].get<double>(), solid ? "m3" : "m2");
  for (const auto& [name, count] : f["groups"].items())
    out += fmt::format("  group {}: {} vertices\n", in_quotes(name), count.get<std::size_t>());
  for (const auto& note : f["notes"]) out += fmt::format("  note: {}\n", printable(note.get<std::string>()));
  return out;
}

} // namespace rend
