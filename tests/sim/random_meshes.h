// Irregular, warped sheets, and bodies built from them without a preset: for tests that compare with references
// computed from polygons.
#pragma once

#include "sim/body/body.h"
#include "sim/build/scene_types.h"
#include "sim/fracture/pairs.h"
#include "sim/mesh/sheet.h"

#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace rend::meshes {

// Random numbers in [-1, 1), the same with every standard library.
class Noise {
public:
  explicit Noise(unsigned seed) : random_(seed) {}
  double operator()() { return static_cast<double>(random_()) / 2147483648.0 - 1; }
  Vec3 vector() {
    const double x = (*this)(), y = (*this)(), z = (*this)();
    return {x, y, z};
  }
  std::size_t below(std::size_t n) { return random_() % n; }

private:
  std::mt19937 random_;
};

// Cells of about unit size.
inline PolygonMesh sheet(SheetPattern pattern, int nx, int ny, SheetClosure closure = SheetClosure::None) {
  SheetShape shape;
  shape.pattern = pattern;
  shape.closure = closure;
  shape.nx = nx;
  shape.ny = ny;
  shape.size = {static_cast<double>(nx), static_cast<double>(ny)};
  return sheet_polygons(shape);
}

// Rows of bricks, each shifted by half a brick: hexagons, with triangles, quads and pentagons among them.
inline PolygonMesh bricks(int width, int rows) {
  PolygonMesh mesh;
  for (int y = 0; y <= rows; ++y)
    for (int x = 0; x <= width; ++x) mesh.points.push_back(Vec3(x, y, 0));
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (width + 1) + x); };
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < width;) {
      const bool whole = x + 2 <= width && (x > 0 || y % 2 == 0);
      const int n = mesh.polygons() % 4 == 3 ? 1 : 0; // every fourth has a corner cut off
      if (whole && n == 1) {
        mesh.add({at(x, y), at(x + 1, y), at(x, y + 1)});
        mesh.add({at(x + 1, y), at(x + 2, y), at(x + 2, y + 1), at(x + 1, y + 1), at(x, y + 1)});
      } else if (whole) {
        mesh.add({at(x, y), at(x + 1, y), at(x + 2, y), at(x + 2, y + 1), at(x + 1, y + 1), at(x, y + 1)});
      } else {
        mesh.add({at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
      }
      x += whole ? 2 : 1;
    }
  }
  return mesh;
}

// Displaces every point by up to `amount` in each direction.
inline PolygonMesh warped(PolygonMesh mesh, double amount, unsigned seed) {
  Noise noise(seed);
  for (Vec3& x : mesh.points) x += amount * noise.vector();
  return mesh;
}

struct Named {
  std::string name;
  PolygonMesh mesh;
};

// Every pattern and closure, warped.
inline std::vector<Named> irregular(double amount = 0.2) {
  using enum SheetPattern;
  using enum SheetClosure;
  std::vector<Named> all{{"quads", sheet(Quads, 5, 4)},
                         {"triangles", sheet(Triangles, 4, 4)},
                         {"crossed", sheet(Crossed, 3, 4)},
                         {"mixed", sheet(Mixed, 5, 4)},
                         {"bricks", bricks(8, 4)},
                         {"loop of quads", sheet(Quads, 6, 3, Loop)},
                         {"Moebius band of quads", sheet(Quads, 7, 3, Twist)},
                         {"Moebius band, mixed", sheet(Mixed, 8, 3, Twist)}};
  unsigned seed = 1;
  for (Named& each : all) each.mesh = warped(each.mesh, amount, seed++);
  return all;
}

struct Spring {
  std::string element, kind; // "shear", "isotropic"
  double k = 1, damping = 0;
};

// One of each interaction, with distinct stiffnesses.
inline std::vector<Spring> all_springs(double damping = 0) {
  return {{"stretch", "", 60, damping},
          {"shear", "isotropic", 43, 0.7 * damping},
          {"shear", "anisotropic", 17, 0.3 * damping},
          {"bend", "provot", 10, 0.9 * damping},
          {"bend", "angular", 2, 0.2 * damping}};
}

struct Recipe {
  std::vector<Spring> springs = all_springs();
  Cumulated cumulated = Cumulated::Auto;
  std::vector<std::string> criteria; // laws that never reach their threshold
  double threshold = 1e30;
  double drag = 0;    // per particle
  bool fixed = false; // the vertex of dart 0 is held
  std::string scheme = "symplectic";
  int threads = 1;
};

inline std::unique_ptr<Interaction> interaction(EmbeddedMap& map, const Spring& spring,
                                                const std::optional<SpringMaterial>& material = {},
                                                std::vector<std::string>* notes = nullptr) {
  SpringSettings settings;
  if (spring.k > 0) settings.k = spring.k;
  settings.damping = spring.damping;
  std::vector<std::string> unread;
  for (const InteractionType& each : all_interactions())
    if (each.element == spring.element && each.kind == spring.kind)
      return each.make(map, {settings, spring.element, material, notes ? *notes : unread});
  throw std::invalid_argument(spring.kind);
}

inline LawSettings law(const std::string& criterion, double threshold) {
  LawSettings settings;
  for (const CriterionType& type : all_criteria())
    if (type.name == criterion) settings.criterion = &type;
  if (settings.criterion) {
    settings.cell = settings.criterion->cell("");
    settings.change = &default_change(settings.cell);
  }
  settings.threshold = threshold;
  return settings;
}

inline std::unique_ptr<Body> body(const PolygonMesh& mesh, const Recipe& recipe = {}) {
  auto made = std::make_unique<Body>();
  made->map = sheet_from(mesh);
  CornerMass mass;
  mass.density = 0.1;
  made->mass = &made->map->add(mass);
  for (const Spring& spring : recipe.springs)
    if (auto added = interaction(*made->map, spring)) made->interactions.push_back(std::move(added));
  if (recipe.drag > 0) {
    CornerDrag drag;
    drag.per_vertex = recipe.drag;
    made->drag = &made->map->add(drag);
  }
  if (recipe.fixed) made->constraints.add(*made->map, Motion{}, {made->map->vertex(Dart{0u})});
  made->cumulated = recipe.cumulated;
  if (!recipe.criteria.empty()) made->border = &made->map->add(InitialBorder{});
  for (const std::string& name : recipe.criteria) {
    const LawSettings settings = law(name, recipe.threshold);
    made->tear_laws.emplace_back(made->request_for(settings), settings);
  }
  made->prepare(*find_scheme(recipe.scheme), {.threads = recipe.threads});
  return made;
}

// A state away from rest.
inline void shake(Body& body, double amount, unsigned seed) {
  Noise noise(seed);
  const CellIndex& vertices = body.map->cells(Vertex);
  for (Slot v = 0; v < vertices.slots(); ++v) {
    if (!vertices.alive(v)) continue;
    body.map->position()[v] = Record(body.map->rest()[v].vec() + amount * noise.vector());
    body.map->velocity()[v] = Record(noise.vector());
  }
}

inline const Record* positions(const Body& body) {
  return body.map->position().values().data();
}
inline const Record* velocities(const Body& body) {
  return body.map->velocity().values().data();
}

inline double largest(const std::vector<Record>& forces) {
  double most = 0;
  for (const Record& f : forces) most = std::max(most, f.vec().norm());
  return most;
}

// The largest difference of two lists of forces, relative to the largest force.
inline double difference(const std::vector<Record>& a, const std::vector<Record>& b) {
  if (a.size() != b.size()) return 1e300;
  double most = 0;
  for (std::size_t n = 0; n < a.size(); ++n) most = std::max(most, (a[n].vec() - b[n].vec()).norm());
  const double scale = std::max(largest(a), largest(b));
  return scale > 0 ? most / scale : most;
}

} // namespace rend::meshes
