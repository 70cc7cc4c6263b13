// What the values of divided cells become, against sums over polygons and particles.
#include "sim/embedding/inheritance.h"

#include "sim/base/check.h"
#include "sim/divided.h"
#include "sim/elements.h"
#include "sim/mechanics/mass.h"
#include "sim/mesh/bar.h"
#include "sim/random_meshes.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

namespace rend::inheritance_test {
namespace {

using namespace meshes;
using divided::any, divided::Division, divided::divisions, divided::flat;

// Twice the vector area of the face of d, at rest.
Vec3 twice_area(const EmbeddedMap& map, Dart d) {
  Vec3 sum = Vec3::Zero();
  Dart at = d;
  do {
    sum += map.rest_of(at).cross(map.rest_of(map.map().alpha(0, at)));
    at = map.map().alpha(1, map.map().alpha(0, at));
  } while (at != d);
  return sum;
}

template <class F> void each_face(const EmbeddedMap& map, F&& f) {
  for_each_face(map, [&](Dart d) { f(d); });
}

double sum_over_face(const EmbeddedMap& map, const ColumnBase& column, const std::vector<double>& values,
                     Dart d) {
  double sum = 0;
  Dart at = d;
  do {
    sum += values[map.slot(column.orbit(), at)];
    at = map.map().alpha(1, map.map().alpha(0, at));
  } while (at != d);
  return sum;
}

double sum_of_column(const EmbeddedMap& map, const ColumnBase& column, const std::vector<double>& values) {
  const CellIndex& cells = map.cells(column.orbit());
  long double sum = 0; // of thousands of values, to the last digits of a double
  for (Slot s = 0; s < cells.slots(); ++s)
    if (cells.alive(s)) sum += values[s];
  return static_cast<double>(sum);
}

void hurry(EmbeddedMap& map, unsigned seed) {
  Noise noise(seed);
  for (Record& v : map.velocity().values()) v = Record(noise.vector());
}

TEST(Inheritance, keeps_the_sums_of_mass_viscosity_and_momentum_of_any_sheet) {
  for (const Named& each : irregular())
    for (const Division& division : divisions()) {
      SCOPED_TRACE(each.name + ", " + division.name);
      const auto map = sheet_from(each.mesh);
      const auto& mass = map->add(CornerMass{.density = 0.3});
      const auto& drag = map->add(CornerDrag{.per_vertex = 0.7});
      hurry(*map, 4);
      const double m = total_mass(*map, mass), d = sum_of_column(*map, drag, drag.values());
      const Vec3 p = total_momentum(*map, mass);
      Noise noise(9);
      for (int times = 0; times < 2; ++times) map->edit([&](Edit& edit) { division.change(edit, noise); });
      EXPECT_EQ(validate(*map), std::nullopt);
      EXPECT_NEAR(total_mass(*map, mass), m, 1e-14 * m);
      EXPECT_NEAR(sum_of_column(*map, drag, drag.values()), d, 1e-14 * d);
      EXPECT_LT((total_momentum(*map, mass) - p).norm(), 1e-14 * m);
    }
}

TEST(Inheritance, gives_a_part_of_a_flat_face_the_density_of_the_whole) {
  for (const Named& each : irregular()) {
    if (each.name.find("band") != std::string::npos || each.name.find("loop") != std::string::npos) continue;
    for (const Division& division : divisions()) {
      const auto map = sheet_from(flat(each.mesh));
      auto& mass = map->add(CornerMass{.density = 1});
      const auto& drag = map->add(CornerDrag{.per_vertex = 0.7});
      // left of x = 2 the sheet is heavier: a density of the map, not of the embedding
      const auto density = [](double x) { return x < 2 ? 5.0 : 1.0; };
      const auto middle = [&](Dart d) { // of the smallest dart's face
        double x = 0, n = 0;
        for (const Dart e : darts_of(map->map(), FaceOfVolume, d)) x += map->rest_of(e).x(), n += 1;
        return x / n;
      };
      std::map<Slot, double> of_face;
      map->use(FaceOfVolume);
      each_face(*map, [&](Dart d) {
        for (const Dart e : darts_of(map->map(), FaceOfVolume, d))
          mass[map->slot(VertexOfFace, e)] =
              density(middle(d)) * 0.5 * twice_area(*map, d).norm() / sides_of_face(map->map(), d);
        of_face[map->slot(FaceOfVolume, d)] = density(middle(d));
      });
      struct Density { // copied to all parts
        using Value = double;
        std::string name = "density";
        Orbit orbit = FaceOfVolume;
        Orbit support = SingleDart;
        Value birth(const EmbeddedMap&, Dart) const { return 0; }
        Value split(const Value& whole) const { return whole; }
        Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
          return parents.front().value;
        }
      };
      auto& marked = map->add(Density{});
      for (const auto& [slot, value] : of_face) marked[slot] = value;
      Noise noise(3);
      map->edit([&](Edit& edit) { division.change(edit, noise); });
      each_face(*map, [&](Dart d) {
        const double expected = marked[map->slot(FaceOfVolume, d)] * 0.5 * twice_area(*map, d).norm();
        EXPECT_NEAR(sum_over_face(*map, mass, mass.values(), d), expected, 1e-13) << each.name << division.name;
        const double corner = sum_over_face(*map, mass, mass.values(), d) / sides_of_face(map->map(), d);
        for (const Dart e : darts_of(map->map(), FaceOfVolume, d))
          EXPECT_NEAR(mass[map->slot(VertexOfFace, e)], corner, 1e-14);
      });
      EXPECT_GT(sum_of_column(*map, drag, drag.values()), 0);
    }
  }
}

// The largest change of velocity of a vertex that was there before the subdivision.
double shift_of_old_vertices(PolygonMesh mesh) {
  const auto map = sheet_from(std::move(mesh));
  map->add(CornerMass{.density = 0.3});
  hurry(*map, 8);
  const std::vector<Record> before = map->velocity().values();
  map->edit([](Edit& edit) { ASSERT_TRUE(divided::subdivided(edit, Dart{0u})); });
  double most = 0;
  for (Slot v = 0; v < before.size(); ++v)
    most = std::max(most, (map->velocity()[v].vec() - before[v].vec()).norm());
  return most;
}

TEST(Inheritance, shifts_velocities_only_where_lumped_masses_do_not_keep_momentum_by_themselves) {
  PolygonMesh parallelograms = sheet(SheetPattern::Quads, 4, 3),
              triangles = sheet(SheetPattern::Triangles, 4, 3);
  for (PolygonMesh* mesh : {&parallelograms, &triangles})
    for (Vec3& x : mesh->points) x = Vec3(x.x() + 0.4 * x.y(), 0.7 * x.y(), 0.2 * x.x());
  EXPECT_LT(shift_of_old_vertices(parallelograms), 1e-14);
  EXPECT_LT(shift_of_old_vertices(triangles), 1e-14);
  EXPECT_LT(shift_of_old_vertices(flat(warped(triangles, 0.2, 5))), 1e-14);
  const double quads = shift_of_old_vertices(flat(warped(sheet(SheetPattern::Quads, 4, 3), 0.2, 5)));
  EXPECT_GT(quads, 1e-4);
  EXPECT_LT(quads, 0.2); // of velocities of about 1 m/s
}

TEST(Inheritance, of_momentum_shifts_the_vertices_of_one_divided_face_alike_and_no_other) {
  const auto map = sheet_from(flat(warped(sheet(SheetPattern::Quads, 5, 5), 0.3, 2)));
  map->add(CornerMass{.density = 0.3});
  hurry(*map, 8);
  const std::vector<Record> before = map->velocity().values(), places = map->position().values();
  const Dart d{8u * 12u};
  std::vector<Slot> around;
  for (const Dart e : darts_of(map->map(), FaceOfVolume, d)) around.push_back(map->vertex(e));
  map->edit([&](Edit& edit) { ASSERT_TRUE(divided::triangulated(edit, d)); });
  const Vec3 shift = map->velocity()[around[0]].vec() - before[around[0]].vec();
  EXPECT_GT(shift.norm(), 1e-5);
  for (Slot v = 0; v < before.size(); ++v) {
    const bool in = std::find(around.begin(), around.end(), v) != around.end();
    EXPECT_LT((map->velocity()[v].vec() - before[v].vec() - (in ? shift : Vec3(0, 0, 0))).norm(), 1e-15);
    EXPECT_EQ(map->position()[v].vec(), places[v].vec());
  }
}

// The value is linear in the rest position, so an inherited mean is what birth() would give.
struct Linear {
  using Value = double;
  std::string name = "linear";
  Orbit orbit = Vertex;
  Orbit support = SingleDart;
  long* inherited = nullptr;
  static double at(const Vec3& x) { return 1 + 2 * x.x() - 3 * x.y() + 0.5 * x.z(); }
  Value birth(const EmbeddedMap& map, Dart d) const { return inherited ? -1 : at(map.rest_of(d)); }
  Value split(const Value& whole) const { return whole; }
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    ++*inherited;
    double weights = 0;
    for (const Inherited<Value>& parent : parents) weights += parent.weight;
    EXPECT_NEAR(weights, 1, 1e-14);
    return sum_of(parents);
  }
};

TEST(Inheritance, parents_that_are_new_stand_for_their_own) {
  for (unsigned seed = 0; seed < 10; ++seed) {
    long inherited = 0;
    const auto map = sheet_from(warped(sheet(SheetPattern::Mixed, 3, 3), 0.2, seed));
    auto& column = map->add(Linear{.inherited = &inherited});
    for (Slot v = 0; v < column.values().size(); ++v) column[v] = Linear::at(map->rest()[v].vec());
    Noise noise(seed);
    map->edit([&](Edit& edit) {
      for (int n = 0; n < 12; ++n) divisions().back().change(edit, noise);
    });
    EXPECT_GT(inherited, 12);
    map->map().for_each_dart(
        [&](Dart d) { EXPECT_NEAR(column[map->vertex(d)], Linear::at(map->rest_of(d)), 1e-12); });
  }
}

TEST(Inheritance, a_child_of_a_vertex_from_nothing_is_born) {
  long inherited = 0;
  EmbeddedMap map(2);
  const Dart quad = assets::add_quad(map, 0, 0);
  auto& column = map.add(Linear{.inherited = &inherited});
  Dart lone, child;
  map.edit([&](Edit& edit) {
    lone = edit.add_dart();
    child = edit.add_dart();
    edit.give(lone, assets::at(3, 3));
    edit.give(child, assets::at(2, 2));
    edit.inherit(child, Vertex, std::array{Parent{quad, 0.5}, Parent{lone, 0.5}});
  });
  EXPECT_EQ(inherited, 0);
  EXPECT_EQ(column[map.vertex(child)], -1);
}

TEST(Inheritance, weights_that_do_not_sum_up_to_one_are_our_slip) {
  const auto map = assets::grid(2, 1);
  EXPECT_THROW(map->edit([](Edit& edit) {
    edit.inherit(edit.add_dart(), Vertex, std::array{Parent{Dart{0u}, 0.4}});
  }),
               InternalError);
}

TEST(Inheritance, of_a_side_puts_springs_in_series) {
  const auto map = sheet_from(warped(sheet(SheetPattern::Mixed, 3, 3), 0.2, 1));
  const auto springs = interaction(*map, {"stretch", "", 60, 0.4});
  const auto unit = [&](Dart d) { return springs->unit(map->slot(EdgeOfFace, d), 0); };
  map->edit([](Edit& edit) { ASSERT_TRUE(divided::vertex_inserted(edit, Dart{9u})); });
  const GMap& g = map->map();
  int halves = 0, wholes = 0;
  g.for_each_dart([&](Dart d) {
    const double length = (map->rest_of(g.alpha(0, d)) - map->rest_of(d)).norm();
    EXPECT_EQ(unit(d)[2], length);
    const bool half = d == Dart{9u} || same_cell(g, EdgeOfVolume, d, Dart{9u}) ||
                      same_cell(g, EdgeOfVolume, d, g.alpha(1, g.alpha(0, Dart{9u})));
    (half ? halves : wholes) += 1;
    EXPECT_NEAR(unit(d)[0], half ? 120 : 60, 1e-12);
    EXPECT_NEAR(unit(d)[1], half ? 0.8 : 0.4, 1e-14);
  });
  EXPECT_GE(halves, 4);
  EXPECT_GT(wholes, 20);
  // again on a half: three parts, whose compliances sum up to that of the side
  map->edit([](Edit& edit) { ASSERT_TRUE(divided::vertex_inserted(edit, Dart{9u})); });
  double compliance = 0;
  Dart at{9u};
  for (int part = 0; part < 3; ++part) {
    compliance += 1 / unit(at)[0];
    at = g.alpha(1, g.alpha(0, at));
  }
  EXPECT_NEAR(compliance, 1 / 60.0, 1e-16);
}

TEST(Inheritance, of_springs_from_a_material_is_what_a_new_body_has) {
  const auto map = sheet_from(sheet(SheetPattern::Quads, 3, 2));
  const SpringMaterial material{1000, 0.3, 0.01};
  const auto divided_springs = interaction(*map, {"stretch", "", 0, 0}, material);
  map->edit([](Edit& edit) { ASSERT_TRUE(divided::subdivided(edit, Dart{0u})); });
  SheetShape shape;
  shape.pattern = SheetPattern::Quads;
  shape.nx = 6;
  shape.ny = 4;
  shape.size = {3, 2};
  const auto fine = sheet_from(sheet_polygons(shape));
  const auto springs = interaction(*fine, {"stretch", "", 0, 0}, material);
  const double expected = springs->unit(0, 0)[0];
  map->map().for_each_dart([&](Dart d) {
    EXPECT_NEAR(divided_springs->unit(map->slot(EdgeOfFace, d), 0)[0], expected, 1e-12 * expected);
  });
}

TEST(Inheritance, of_solids_keeps_the_sums_of_mass_viscosity_and_momentum) {
  for (auto pattern : {BarPattern::Hexahedra, BarPattern::Tetrahedra, BarPattern::Prisms, BarPattern::Mixed}) {
    CellMesh mesh = bar_cells({pattern, 3, 2, 2, Vec3(1, 1, 1)});
    Noise noise(5);
    for (Vec3& x : mesh.points) x += 0.05 * noise.vector();
    const auto map = solid_from(mesh);
    const auto& mass = map->add(CornerMass{.density = 1000}.on(*map));
    const auto& drag = map->add(CornerDrag{.per_vertex = 0.7}.on(*map));
    hurry(*map, 1);
    const double m = total_mass(*map, mass), d = sum_of_column(*map, drag, drag.values());
    const Vec3 p = total_momentum(*map, mass);
    for (int n = 0; n < 8; ++n)
      map->edit([&](Edit& edit) {
        ASSERT_TRUE(divided::vertex_inserted(edit, any(edit.map(), noise)));
        ASSERT_TRUE(divided::triangulated_both_sides(edit, any(edit.map(), noise)));
      });
    EXPECT_EQ(validate(*map), std::nullopt);
    EXPECT_NEAR(total_mass(*map, mass), m, 1e-14 * m);
    EXPECT_NEAR(sum_of_column(*map, drag, drag.values()), d, 1e-14 * d);
    EXPECT_LT((total_momentum(*map, mass) - p).norm(), 1e-14 * m);
  }
}

TEST(Inheritance, a_copy_has_the_density_of_what_it_was_copied_from) {
  EmbeddedMap map(2);
  const Dart quad = assets::add_quad(map, 0, 0);
  auto& mass = map.add(CornerMass{.density = 1});
  for (double& each : mass.values()) each = 0.5; // 2 kg/m²
  std::vector<Dart> made;
  map.edit([&](Edit& edit) {
    const std::array<Point, 3> points{assets::at(5, 0), assets::at(8, 0), assets::at(5, 2)}; // 3 m²
    made = assets::create_polygon(edit, points);
    for (const Dart d : made) edit.inherit(d, FaceOfVolume, std::array{Parent{quad, 1}});
  });
  EXPECT_NEAR(sum_over_face(map, mass, mass.values(), made[0]), 6, 1e-14);
  EXPECT_EQ(sum_over_face(map, mass, mass.values(), quad), 2);
}

TEST(Inheritance, without_parents_there_is_birth) {
  EmbeddedMap map(2);
  assets::add_quad(map, 0, 0);
  auto& mass = map.add(CornerMass{.density = 1});
  for (double& each : mass.values()) each = 7; // what birth() does not give
  std::vector<Dart> made;
  map.edit([&](Edit& edit) {
    const std::array<Point, 3> points{assets::at(5, 0), assets::at(8, 0), assets::at(5, 2)}; // 3 m²
    made = assets::create_polygon(edit, points);
  });
  EXPECT_NEAR(sum_over_face(map, mass, mass.values(), made[0]), 3, 1e-14);
  EXPECT_EQ(total_mass(map, mass), 31);
}

TEST(Inheritance, a_division_at_rest_makes_no_force) {
  for (const Division& division : divisions())
    for (const Named& each : irregular()) {
      if (each.name.find("bricks") != std::string::npos) continue;
      Recipe recipe;
      std::erase_if(recipe.springs, [](const Spring& spring) { return spring.kind == "anisotropic"; });
      const auto made = body(each.mesh, recipe);
      Noise noise(2);
      made->map->edit([&](Edit& edit) { division.change(edit, noise); });
      made->rebind();
      std::vector<Record> force(made->vertices());
      made->forces(0, made->map->rest().values().data(), velocities(*made), force.data());
      EXPECT_LT(largest(force), 1e-12 * 60) << each.name << ", " << division.name;
    }
}

TEST(Inheritance, of_elements_makes_them_as_a_body_built_of_the_parts_has_them) {
  for (const char* model : {"linear", "corotational", "mass-tensor"}) {
    const PolygonMesh mesh = warped(sheet(SheetPattern::Quads, 3, 3), 0.1, 4);
    const auto divided_body = elements::elastic_body(sheet_from(mesh), {.model = model});
    EmbeddedMap& map = *divided_body->map;
    map.edit([](Edit& edit) { ASSERT_TRUE(divided::subdivided(edit, Dart{0u})); });
    const auto bind = [](Body& body) {
      body.program =
          std::make_unique<Program>(*body.map, body.interactions, *body.mass, nullptr, ProgramOptions{});
    };
    bind(*divided_body);
    const auto forces = [](Body& body, const Record* x) {
      std::vector<Record> force(body.map->cells(Vertex).slots());
      body.program->forces(x, velocities(body), force.data());
      return force;
    };
    EXPECT_LT(largest(forces(*divided_body, map.rest().values().data())), 1e-12 * 100) << model; // E h L [N]

    const auto built =
        elements::elastic_body(std::make_unique<EmbeddedMap>(map.map(),
                                                             [&](Dart d) {
                                                               return Point{map.rest_of(d), map.rest_of(d)};
                                                             }),
                               {.model = model});
    Noise noise(1);
    for (Slot v = 0; v < map.position().values().size(); ++v) {
      const Vec3 x = map.rest()[v].vec() + 0.05 * noise.vector();
      map.position()[v] = Record(x);
      built->map->position()[built->map->vertex(map.cells(Vertex).first_dart(v))] = Record(x);
    }
    const auto one = forces(*divided_body, positions(*divided_body)), other = forces(*built, positions(*built));
    EXPECT_GT(largest(one), 0.1) << model;
    for (Slot v = 0; v < one.size(); ++v) {
      const Slot same = built->map->vertex(map.cells(Vertex).first_dart(v));
      EXPECT_LT((one[v].vec() - other[same].vec()).norm(), 1e-12 * largest(one)) << model;
    }
  }
}

} // namespace
} // namespace rend::inheritance_test
