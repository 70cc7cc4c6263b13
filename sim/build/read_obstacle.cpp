#include "sim/build/read_obstacle.h"

#include "sim/base/math.h"
#include "sim/base/wording.h"
#include "sim/build/read_settings.h"
#include "sim/build/read_world.h"
#include "sim/topology/count.h"
#include "sim/topology/orientation.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

constexpr double flat_volume = 1e-9; // relative to the cube of its size: it encloses nothing

// A connected piece of a surface.
struct SurfacePart {
  std::vector<std::size_t> triangles; // their indices
  Eigen::AlignedBox3d bounds;         // [m]
  bool closed = true;
  double volume = 0; // [m³], negative: its faces are clockwise as seen from outside
};

// Adds the polygons of a map as triangles around their first corners.
class Triangles {
public:
  explicit Triangles(const EmbeddedMap& map) : map_(map), number_(map.cells(Vertex).slots(), none) {}
  void add(std::span<const Slot> ring) {
    for (std::size_t n = 1; n + 1 < ring.size(); ++n)
      out.triangles.push_back({point(ring[0]), point(ring[n]), point(ring[n + 1])});
  }
  ObstacleSurface out;

private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  std::uint32_t point(Slot v) {
    if (number_[v] == none) {
      number_[v] = static_cast<std::uint32_t>(out.points.size());
      out.points.push_back(map_.rest()[v].vec());
    }
    return number_[v];
  }
  const EmbeddedMap& map_;
  std::vector<std::uint32_t> number_; // of a point, one per vertex slot
};

ObstacleSurface surface_of_solid(EmbeddedMap& map) {
  Triangles triangles(map);
  Boundary boundary(map, nullptr);
  boundary.update();
  boundary.for_each_face([&](const BoundaryFaces::Face&, std::span<const Slot> ring) { triangles.add(ring); });
  triangles.out.closed = true;
  return std::move(triangles.out);
}

void measure(const ObstacleSurface& surface, std::vector<SurfacePart>& parts) {
  for (SurfacePart& part : parts) {
    for (const std::size_t t : part.triangles)
      for (const std::uint32_t corner : surface.triangles[t]) part.bounds.extend(surface.points[corner]);
    const Vec3 middle = part.bounds.center();
    for (const std::size_t t : part.triangles) {
      const auto& [a, b, c] = surface.triangles[t];
      const Vec3 x = surface.points[a] - middle, y = surface.points[b] - middle, z = surface.points[c] - middle;
      part.volume += x.dot(y.cross(z)) / 6;
    }
  }
}

// The triangles of a sheet, and its parts, in each of which neighbours agree.
ObstacleSurface surface_of_sheet(const EmbeddedMap& map, std::vector<SurfacePart>& parts) {
  Triangles triangles(map);
  const GMap& darts = map.map();
  const Sides sides = sides_of(darts);
  const std::vector<std::uint32_t> label = label_fragments(darts);
  std::vector<Slot> ring;
  const CellIndex faces(darts, FaceOfVolume);
  for (Slot f = 0; f < faces.slots(); ++f) {
    const Dart first = faces.first_dart(f);
    SurfacePart& part = parts[label[first.value]];
    const Dart start = sides.of_dart[first.value] == 1 ? first : darts.alpha(1, first);
    ring.clear();
    Dart d = start;
    do {
      ring.push_back(map.vertex(d));
      part.closed = part.closed && darts.alpha(2, d) != d;
      d = darts.alpha(1, darts.alpha(0, d));
    } while (d != start);
    const std::size_t before = triangles.out.triangles.size();
    triangles.add(ring);
    for (std::size_t t = before; t < triangles.out.triangles.size(); ++t) part.triangles.push_back(t);
  }
  for (SurfacePart& part : parts) part.closed = part.closed && sides.orientable;
  measure(triangles.out, parts);
  return std::move(triangles.out);
}

bool is_hollow(const SurfacePart& part, const std::vector<SurfacePart>& all) {
  return std::ranges::any_of(
      all, [&](const SurfacePart& other) { return &other != &part && other.bounds.contains(part.bounds); });
}

// How many faces were turned.
std::size_t turn_outward(ObstacleSurface& surface, const std::vector<SurfacePart>& parts) {
  std::size_t turned = 0;
  for (const SurfacePart& part : parts) {
    if (part.volume >= 0 || is_hollow(part, parts)) continue;
    for (const std::size_t t : part.triangles) std::swap(surface.triangles[t][1], surface.triangles[t][2]);
    turned += part.triangles.size();
  }
  return turned;
}

const ElementType& obstacle_place_type() {
  static const ElementType type{
      "place", "where the obstacle is: it is scaled, then rotated, then moved", attributes_at_rest(), {}};
  return type;
}

// Of an obstacle: a placement that does not say how it starts to move.
Placement read_place(const PresetNode& node) {
  Placement place;
  for (const Field<Placement>& field : fields_of<Placement>())
    if (obstacle_place_type().find(field.type.name))
      if (const AttributeValue* value = node.find(field.type.name)) field.take(place, *value);
  place.source = source_of(node);
  return place;
}

} // namespace

ObstacleSurface obstacle_surface(EmbeddedMap& map, std::vector<std::string>& notes) {
  if (map.dimension() == 3) return surface_of_solid(map);
  const auto label = label_fragments(map.map());
  std::vector<SurfacePart> parts;
  map.map().for_each_dart(
      [&](Dart d) { parts.resize(std::max<std::size_t>(parts.size(), label[d.value] + 1)); });
  ObstacleSurface surface = surface_of_sheet(map, parts);
  const auto open = std::ranges::count_if(parts, [](const SurfacePart& part) { return !part.closed; });
  surface.closed = open == 0 && !parts.empty();
  if (surface.closed) {
    if (turn_outward(surface, parts) > 0)
      notes.emplace_back("its faces were inside out, or did not agree, and have been turned outward");
  } else if (static_cast<std::size_t>(open) < parts.size()) {
    notes.push_back(
        fmt::format("{} of its {} parts are not closed, so that all of it counts as a sheet, which things "
                    "do not pass, and not as something with an inside",
                    open, parts.size()));
  }
  return surface;
}

const ElementType& obstacle_type() {
  static const ElementType type{"obstacle",
                                "a rigid obstacle of any shape, which bodies with <contact> collide with: what "
                                "is closed keeps things out, "
                                "what is open is a wall that they do not pass",
                                attributes_of<MeshObstacleSettings>(),
                                {{&obstacle_place_type(), 0, 1}, {&key_type(), 0, -1}}};
  return type;
}

MeshObstacle build_obstacle(const MeshObstacleSettings& settings, const Placement& place) {
  check_settings(settings);
  check_settings(place);
  MeshFile file = read_mesh_of(settings.source, settings.file);
  place.apply(file.points());
  const std::string name = file.source.name();
  const MeshBody mesh = sew(std::move(file));
  std::vector<std::string> notes;
  MeshObstacle obstacle(settings, obstacle_surface(*mesh.map, notes));
  if (obstacle.surface.closed &&
      !(obstacle.volume() > flat_volume * power(obstacle.bounds.diagonal().norm(), 3)))
    settings.source.fail("file", "the obstacle is closed and encloses no volume",
                         "leave one side of it open: it is then a sheet, which things do not pass");
  for (const std::string& note : notes)
    obstacle.notes.push_back(fmt::format("obstacle {}: {}", in_quotes(name), note));
  return obstacle;
}

MeshObstacle read_obstacle(const PresetNode& node) {
  auto settings = read_settings<MeshObstacleSettings>(node);
  settings.motion.keys = read_keys(node);
  const PresetNode* place = node.child("place");
  return build_obstacle(settings, place ? read_place(*place) : Placement{});
}

} // namespace rend
