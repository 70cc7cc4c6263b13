// Sheets built by rules, as in the thesis (3.4.2), against those of the generator, and the effect of
// subdivision on a body that already has masses and springs (thesis figs. 6.13 to 6.15).
#include "sim/house_rules/house_rules.h"
#include "sim/mesh/sheet.h"
#include "sim/rows/program.h"
#include "sim/rules/apply.h"
#include "sim/topology/count.h"
#include "sim/topology/isomorphism.h"
#include "sim/topology/walk.h"

#include <gtest/gtest.h>
#include <map>

#include "sim/assets.h"
#include "sim/random_meshes.h"

namespace rend::by_rules_test {
namespace {

using Owned = std::unique_ptr<EmbeddedMap>;

Owned by_generator(SheetPattern pattern, int cells) {
  SheetShape shape;
  shape.pattern = pattern;
  shape.nx = shape.ny = cells;
  shape.size = {1, 1};
  return sheet_from(sheet_polygons(shape));
}

// A square, subdivided `times` times: 2^times cells on a side.
Owned subdivided(int times) {
  auto map = std::make_unique<EmbeddedMap>(2);
  const Dart d =
      apply(rule("create-quad"), *map, {},
            assets::corners({assets::at(0, 0), assets::at(1, 0), assets::at(1, 1), assets::at(0, 1)}))
          .dart("a");
  for (int n = 0; n < times; ++n) EXPECT_TRUE(apply(rule("quarter-faces"), *map, d).ok);
  return map;
}

Vec3 centre_of(const EmbeddedMap& map, Dart d) {
  Vec3 sum = Vec3::Zero();
  const std::vector<Dart> darts = darts_of(map.map(), FaceOfVolume, d);
  for (Dart e : darts) sum += map.rest_of(e);
  return sum / static_cast<double>(darts.size());
}

// Triangulates those faces of a square of n × n cells that `chosen` selects by position.
template <class F> void cross(EmbeddedMap& map, int n, F&& chosen) {
  std::vector<Dart> faces;
  for_each_face(map, [&](Dart d) { faces.push_back(d); });
  for (Dart d : faces) {
    const Vec3 centre = centre_of(map, d) * n;
    if (!chosen(static_cast<int>(centre.x()), static_cast<int>(centre.y()))) continue;
    EXPECT_TRUE(apply(rule("star-face"), map, d).ok);
  }
}

Owned by_rules(SheetPattern pattern, int times) {
  Owned map = subdivided(times);
  if (pattern == SheetPattern::Crossed) cross(*map, 1 << times, [](int, int) { return true; });
  if (pattern == SheetPattern::Mixed) cross(*map, 1 << times, [](int x, int y) { return (x + y) % 2 == 1; });
  return map;
}

// Squares split along the diagonal from their first corner: triangles built by the rule, then sewn.
Owned halved_by_rules(int n) {
  auto map = std::make_unique<EmbeddedMap>(2);
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const auto at = [&](int i, int j) { return assets::at(double(x + i) / n, double(y + j) / n); };
      apply(rule("create-triangle"), *map, {}, assets::corners({at(0, 0), at(1, 0), at(1, 1)}));
      apply(rule("create-triangle"), *map, {}, assets::corners({at(0, 0), at(1, 1), at(0, 1)}));
    }
  assets::sew_coincident(*map);
  return map;
}

// The isomorphism from darts of a to darts of b with equal points; empty: the sheets differ.
std::vector<Dart> images(const EmbeddedMap& a, const EmbeddedMap& b) {
  const auto image =
      isomorphism(a.map(), b.map(), [&](Dart d, Dart e) { return a.rest_of(d) == b.rest_of(e); });
  return image ? *image : std::vector<Dart>{};
}

struct Pair {
  std::string name;
  std::function<Owned()> rules, generator;
};

std::vector<Pair> pairs() {
  std::vector<Pair> all;
  for (const SheetPattern pattern : {SheetPattern::Quads, SheetPattern::Crossed, SheetPattern::Mixed})
    for (int times = 1; times <= 4; ++times)
      all.push_back(
          {"pattern " + std::to_string(static_cast<int>(pattern)) + ", times " + std::to_string(times),
           [=] { return by_rules(pattern, times); }, [=] { return by_generator(pattern, 1 << times); }});
  all.push_back({"triangles", [] { return halved_by_rules(4); },
                 [] { return by_generator(SheetPattern::Triangles, 4); }});
  return all;
}

// A map with masses, viscosities and interactions, and their program.
struct MapWithProgram {
  EmbeddedMap& map;
  MassColumn& mass;
  DragColumn& drag;
  std::vector<std::unique_ptr<Interaction>> interactions;
  std::unique_ptr<Program> program;

  MapWithProgram(EmbeddedMap& body, const std::vector<meshes::Spring>& springs)
      : map(body), mass(body.add(CornerMass{.density = 0.3})), drag(body.add(CornerDrag{.per_vertex = 0.2})) {
    for (const meshes::Spring& spring : springs)
      if (auto made = meshes::interaction(map, spring)) interactions.push_back(std::move(made));
  }
  Program& run() {
    program = std::make_unique<Program>(map, interactions, mass, &drag, ProgramOptions{});
    return *program;
  }
};

// The sum of all corner masses in extended precision.
double exact_mass(const MapWithProgram& body) {
  const CellIndex& corners = body.map.cells(VertexOfFace);
  long double sum = 0;
  for (Slot c = 0; c < corners.slots(); ++c)
    if (corners.alive(c)) sum += body.mass[c];
  return static_cast<double>(sum);
}

// Compares the embedded values of two sheets, dart by dart, through the isomorphism.
void expect_same_load(const MapWithProgram& a, const MapWithProgram& b, const std::vector<Dart>& image,
                      bool drag = true) {
  ASSERT_EQ(a.interactions.size(), b.interactions.size());
  a.map.map().for_each_dart([&](Dart d) {
    const Dart e = image[d.value];
    EXPECT_NEAR(a.mass[a.map.slot(VertexOfFace, d)], b.mass[b.map.slot(VertexOfFace, e)], 1e-16);
    if (drag) {
      EXPECT_NEAR(a.drag[a.map.slot(VertexOfFace, d)], b.drag[b.map.slot(VertexOfFace, e)], 1e-16);
    }
    for (std::size_t n = 0; n < a.interactions.size(); ++n) {
      const Interaction &one = *a.interactions[n], &other = *b.interactions[n];
      ASSERT_EQ(one.name, other.name);
      if (one.name == "shear anisotropic") continue; // which corners own it depends on the numbers of darts
      for (std::size_t unit = 0; unit < one.pattern.units.size(); ++unit) {
        ASSERT_EQ(one.pattern.present(a.map.map(), d, unit), other.pattern.present(b.map.map(), e, unit));
        if (!one.pattern.present(a.map.map(), d, unit)) continue;
        const auto p = UnitParameters::of(one.unit(a.map.slot(one.pattern.owner, d), unit));
        const auto q = UnitParameters::of(other.unit(b.map.slot(other.pattern.owner, e), unit));
        EXPECT_EQ(p.k, q.k) << one.name;
        EXPECT_EQ(p.damping, q.damping) << one.name;
        EXPECT_NEAR(p.rest, q.rest, 1e-15) << one.name;
      }
    }
  });
}

// Sets the same state on both, by rest positions; returns the largest difference of forces relative to the
// largest force.
double difference_of_forces(MapWithProgram& a, MapWithProgram& b, const std::vector<Dart>& image) {
  const auto moved = [](const Vec3& x) {
    return Vec3(x +
                0.05 * Vec3(std::sin(7 * x.y() + x.x()), std::cos(5 * x.x()), std::sin(9 * x.x() + 4 * x.y())));
  };
  const auto speed = [](const Vec3& x) {
    return Vec3(std::sin(11 * x.x()), std::sin(3 * x.y()), std::cos(8 * x.y()));
  };
  const auto forces_of = [&](MapWithProgram& each) {
    std::vector<Record> x(each.map.position().values().size()), v(x.size()), f(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) {
      x[n] = Record(moved(each.map.rest().values()[n].vec()));
      v[n] = Record(speed(each.map.rest().values()[n].vec()));
    }
    each.run().forces(x.data(), v.data(), f.data());
    return f;
  };
  const std::vector<Record> f = forces_of(a), g = forces_of(b);
  double most = 0;
  a.map.map().for_each_dart([&](Dart d) {
    most = std::max(most, (f[a.map.vertex(d)].vec() - g[b.map.vertex(image[d.value])].vec()).norm());
  });
  return most / meshes::largest(f);
}

TEST(SheetByRules, is_the_generators_sheet) {
  for (const Pair& pair : pairs()) {
    SCOPED_TRACE(pair.name);
    const Owned rules = pair.rules(), generator = pair.generator();
    ASSERT_EQ(validate(*rules), std::nullopt);
    EXPECT_EQ(rules->map().dart_count(), generator->map().dart_count());
    EXPECT_FALSE(images(*rules, *generator).empty());
  }
}

TEST(SheetByRules, carries_what_the_generators_sheet_carries) {
  for (const Pair& pair : pairs()) {
    SCOPED_TRACE(pair.name);
    const Owned rules = pair.rules(), generator = pair.generator();
    MapWithProgram a(*rules, meshes::all_springs(0.1)), b(*generator, meshes::all_springs(0.1));
    const std::vector<Dart> image = images(*rules, *generator);
    ASSERT_FALSE(image.empty());
    expect_same_load(a, b, image);
    EXPECT_LT(difference_of_forces(a, b, image), 1e-13);
    EXPECT_NEAR(exact_mass(a), 0.3, 1e-15);
  }
}

// Interactions that existed before a rule are updated by their policies alone.
TEST(SheetByRules, carries_the_same_where_the_load_was_there_before_the_rules) {
  for (const SheetPattern pattern : {SheetPattern::Quads, SheetPattern::Crossed, SheetPattern::Mixed}) {
    for (int times = 2; times <= 4; ++times) {
      SCOPED_TRACE("pattern " + std::to_string(static_cast<int>(pattern)) + ", times " + std::to_string(times));
      const Owned rules = subdivided(1), generator = by_generator(pattern, 1 << times);
      MapWithProgram a(*rules, meshes::all_springs(0.1)), b(*generator, meshes::all_springs(0.1));
      for (int n = 1; n < times; ++n) ASSERT_TRUE(apply(rule("quarter-faces"), *rules, Dart{0u}).ok);
      if (pattern == SheetPattern::Crossed) cross(*rules, 1 << times, [](int, int) { return true; });
      if (pattern == SheetPattern::Mixed)
        cross(*rules, 1 << times, [](int x, int y) { return (x + y) % 2 == 1; });
      const std::vector<Dart> image = images(*rules, *generator);
      ASSERT_FALSE(image.empty());
      // Halved sides are stiffer, as Subdivision.* shows.
      for (MapWithProgram* each : {&a, &b})
        std::erase_if(each->interactions, [](const auto& one) { return one->name == "stretch"; });
      if (pattern == SheetPattern::Crossed) // the generator omits shear springs outside of quads
        std::erase_if(a.interactions, [](const auto& each) { return each->name.starts_with("shear"); });
      expect_same_load(a, b, image, false); // shares of viscosity are inherited: their sum is kept
      EXPECT_LT(difference_of_forces(a, b, image), 1e-13);
    }
  }
}

TEST(Subdivision, quarters_corner_masses_halves_rest_lengths_and_divides_springs_in_series) {
  const Owned map = by_generator(SheetPattern::Quads, 3);
  MapWithProgram body(*map,
                      {{"stretch", "", 60, 0.1}, {"shear", "isotropic", 43, 0.2}, {"bend", "provot", 10, 0.3}});
  const double mass = exact_mass(body);
  double corner = body.mass[map->slot(VertexOfFace, Dart{0u})], side = 1.0 / 3, faces = 9;
  for (int n = 0; n < 3; ++n) {
    ASSERT_TRUE(apply(rule("quarter-faces"), *map, Dart{0u}).ok);
    corner /= 4;
    side /= 2;
    faces *= 4;
    EXPECT_EQ(static_cast<double>(count_cells(map->map()).faces), faces);
    EXPECT_NEAR(exact_mass(body), mass, 1e-14 * mass);
    const std::map<std::string, std::pair<double, double>> known{
        // k of new springs; the rest length is that of the new edge
        {"stretch", {60, side}},
        {"shear isotropic", {43, std::sqrt(2.0) * side}},
        {"bend provot", {10, 2 * side}}};
    map->map().for_each_dart([&](Dart d) {
      EXPECT_NEAR(body.mass[map->slot(VertexOfFace, d)], corner, 1e-14 * corner);
      for (const auto& each : body.interactions) {
        if (!each->pattern.present(map->map(), d, 0)) continue;
        const auto p = UnitParameters::of(each->unit(map->slot(each->pattern.owner, d), 0));
        if (each->name == "stretch") { // k times length stays, where a side is halved
          const Vec3 x = map->rest_of(d), y = map->rest_of(map->map().alpha(0, d));
          const auto on_grid = [](double s) { return std::abs(3 * s - std::round(3 * s)) < 1e-9; };
          const bool old = (std::abs(x.x() - y.x()) < 1e-9 && on_grid(x.x())) ||
                           (std::abs(x.y() - y.y()) < 1e-9 && on_grid(x.y()));
          const double halved = std::log2(p.k / 60);
          EXPECT_NEAR(halved, std::round(halved), 1e-12);
          EXPECT_GE(halved, -1e-12);
          EXPECT_LE(halved, n + 1 + 1e-9);
          EXPECT_EQ(std::abs(halved - (n + 1)) < 1e-9, old);
        } else {
          EXPECT_EQ(p.k, known.at(each->name).first);
        }
        EXPECT_NEAR(p.rest, known.at(each->name).second, 1e-15) << each->name;
      }
    });
  }
}

TEST(Subdivision, brings_a_program_up_to_date) {
  const Owned map = by_generator(SheetPattern::Mixed, 4);
  MapWithProgram body(*map, meshes::all_springs(0.1));
  Program& program = body.run();
  for (int n = 0; n < 2; ++n) {
    ASSERT_TRUE(apply(rule("quarter-faces"), *map, Dart{0u}).ok);
    program.rebind();
    EXPECT_TRUE(program.same_as(Program(*map, body.interactions, body.mass, &body.drag, ProgramOptions{})));
  }
}

TEST(Subdivision, keeps_the_mass_of_irregular_cells) {
  PolygonMesh mesh = meshes::warped(meshes::bricks(6, 4), 0.15, 5);
  for (Vec3& x : mesh.points) x.z() = 0.5 * x.x(); // planar, but inclined
  const Owned map = sheet_from(mesh);
  MapWithProgram body(*map, meshes::all_springs());
  const double mass = exact_mass(body);
  ASSERT_TRUE(apply(rule("quarter-faces"), *map, Dart{0u}).ok);
  EXPECT_NEAR(exact_mass(body), mass, 1e-14 * mass);
}

TEST(Subdivision, of_a_deformed_body_puts_points_in_the_middle_and_looks_at_the_rest_alone) {
  const Owned map = by_generator(SheetPattern::Quads, 4), calm = by_generator(SheetPattern::Quads, 4);
  MapWithProgram body(*map, meshes::all_springs()), other(*calm, meshes::all_springs());
  const auto deformed = [](const Vec3& x) {
    return Vec3(2 * x.x() + 0.3 * x.y(), x.y() - x.x(), 3 * x.x() + 1);
  };
  for (std::size_t n = 0; n < map->position().values().size(); ++n) {
    map->position().values()[n] = Record(deformed(map->rest().values()[n].vec()));
    map->velocity().values()[n] = Record(deformed(map->rest().values()[n].vec()) * 7);
  }
  for (EmbeddedMap* each : {map.get(), calm.get()})
    ASSERT_TRUE(apply(rule("quarter-faces"), *each, Dart{0u}).ok);
  map->map().for_each_dart([&](Dart d) { // affine maps preserve means
    EXPECT_NEAR((map->position_of(d) - deformed(map->rest_of(d))).norm(), 0, 1e-14);
    EXPECT_NEAR((map->velocity()[map->vertex(d)].vec() - 7 * deformed(map->rest_of(d))).norm(), 0, 1e-13);
  });
  const std::vector<Dart> image = images(*map, *calm);
  ASSERT_FALSE(image.empty());
  expect_same_load(body, other, image);
}

} // namespace
} // namespace rend::by_rules_test
