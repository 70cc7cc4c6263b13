// The format is described in sim/mesh/moka.h.
#include "sim/base/wording.h"
#include "sim/mesh/dart_order.h"
#include "sim/mesh/moka.h"
#include "sim/mesh/scanner.h"
#include "sim/topology/validate.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

namespace rend {
namespace {

struct Lines {
  std::vector<std::array<std::uint32_t, 4>> links; // one per dart
  std::vector<std::uint32_t> point;                // one per dart; none_value: it carries no point
  std::vector<Vec3> points;
};

void read_dart(Scanner& in, Lines& lines) {
  std::array<std::uint32_t, 4> links;
  for (std::uint32_t& link : links) {
    const std::uint64_t dart = in.size("the number of a dart");
    if (dart >= Dart::none_value) in.fail(fmt::format("{} is more than the darts of a map", dart));
    link = static_cast<std::uint32_t>(dart);
  }
  for (int k = 0; k < 4; ++k) in.integer("a mark word");
  const std::int64_t carries = in.integer("0, or 1 and a point");
  if (carries != 0 && carries != 1) in.fail("0 is expected, or 1 and a point");
  lines.point.push_back(carries == 1 ? static_cast<std::uint32_t>(lines.points.size()) : Dart::none_value);
  if (carries == 1) {
    const double x = in.real("the coordinate of a point"), y = in.real("the coordinate of a point");
    lines.points.emplace_back(x, y, in.real("the coordinate of a point"));
  }
  lines.links.push_back(links);
  if (!in.line_ends()) in.fail("the line of a dart goes on after its point");
}

Lines read_lines(MeshFile& file) {
  Scanner in(file.source);
  const std::string_view head = in.rest_of_line();
  if (head != "Moka file [ascii]")
    file.source.fail(std::size_t{0}, "the line 'Moka file [ascii]' is expected",
                     head.starts_with("Moka file") ? "of Moka's formats ASCII is read" : "");
  for (int k = 0; k < 8; ++k) in.integer("one of eight mask numbers");
  Lines lines;
  while (!in.at_end()) {
    file.origins.push_back({in.offset(), lines.links.size()});
    read_dart(in, lines);
  }
  if (lines.links.empty()) file.source.fail("holds no darts");
  return lines;
}

// 3 or 2: a solid or a sheet.
int dimension_of(const Lines& lines) {
  bool closed = true;
  for (std::uint32_t d = 0; d < lines.links.size(); ++d) {
    if (lines.links[d][3] != d) return 3;
    closed = closed && lines.links[d][2] != d;
  }
  return closed ? 3 : 2;
}

GMap map_of(const MeshFile& file, const Lines& lines) {
  GMap map(dimension_of(lines));
  MapEdit edit(map);
  const auto count = static_cast<std::uint32_t>(lines.links.size());
  edit.reserve(count);
  for (std::uint32_t d = 0; d < count; ++d) edit.add_dart();
  for (std::uint32_t d = 0; d < count; ++d) {
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t other = lines.links[d][static_cast<std::size_t>(i)];
      if (other >= count)
        file.source.fail(file.origins[d].offset,
                         fmt::format("α{} of dart {} is {}, and there are {} darts", i, d, other, count));
      if (lines.links[other][static_cast<std::size_t>(i)] != d)
        file.source.fail(file.origins[d].offset,
                         fmt::format("α{} of dart {} is {}, whose α{} is {}: it does not lead back", i, d,
                                     other, i, lines.links[other][static_cast<std::size_t>(i)]));
      if (d < other) edit.link(i, Dart{d}, Dart{other});
    }
  }
  if (const auto fault = validate(map))
    file.source.fail(file.origins[fault->dart.value].offset, "this is no generalized map: " + fault->axiom);
  return map;
}

// Refuses faces of fewer than three sides and open ones, which have no area; a volume of a solid must be
// closed.
void check_elements(const MeshFile& file, const GMap& map) {
  map.for_each_dart([&](Dart d) {
    const auto refuse = [&](const char* what) {
      file.source.fail(file.origins[d.value].offset, fmt::format("dart {} {}", d.value, what));
    };
    if (map.is_free(0, d) || map.is_free(1, d)) refuse("is α0-free or α1-free: its face is open");
    if (map.follow(d, std::string_view("0101")) == d || map.alpha(0, d) == map.alpha(1, d))
      refuse("belongs to a face of fewer than three sides");
    if (map.dimension() == 3 && map.is_free(2, d)) refuse("is α2-free: its volume is open");
  });
}

// The point of each dart, taken from the dart of its vertex that carries one.
std::vector<std::uint32_t> spread(const MeshFile& file, const GMap& map, const Lines& lines) {
  std::vector<std::uint32_t> point(map.capacity(), Dart::none_value);
  std::vector<Dart> darts;
  map.for_each_dart([&](Dart d) {
    if (point[d.value] != Dart::none_value) return;
    darts.clear();
    collect(map, Vertex, d, darts);
    std::uint32_t found = Dart::none_value;
    for (const Dart e : darts) {
      const std::uint32_t mine = lines.point[e.value];
      if (mine == Dart::none_value) continue;
      if (found != Dart::none_value && lines.points[found] != lines.points[mine])
        file.source.fail(file.origins[e.value].offset,
                         fmt::format("dart {} gives its vertex a second point", e.value));
      if (found == Dart::none_value) found = mine;
    }
    if (found == Dart::none_value)
      file.source.fail(file.origins[d.value].offset,
                       fmt::format("no dart of the vertex of dart {} carries a point", d.value));
    for (const Dart e : darts) point[e.value] = found;
  });
  return point;
}

void read_moka(MeshFile& file) {
  Lines lines = read_lines(file);
  MapMesh mesh{{}, map_of(file, lines), {}};
  check_elements(file, mesh.map);
  mesh.point = spread(file, mesh.map, lines);
  mesh.points = std::move(lines.points);
  if (mesh.map.dimension() == 3) {
    const std::vector<Dart> order = cell_order(mesh);
    std::vector<Origin> origins;
    for (const Dart d : order) origins.push_back(file.origins[d.value]);
    mesh = renumbered(mesh, order);
    file.origins = std::move(origins);
  }
  file.mesh = std::move(mesh);
}

} // namespace

MeshReader moka_reader() {
  return {"Moka", {".moka"}, "a generalized map, dart by dart, as text", read_moka};
}

} // namespace rend
