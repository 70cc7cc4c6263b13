// Stiffness from Young's modulus: by formula, and by pulling the sheet (thesis eq. 2.20 to 2.22;
// spring_stiffness.h).
#include "sim/mechanics/spring_stiffness.h"

#include "sim/presets.h"
#include "sim/random_meshes.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include <cmath>

namespace rend::spring_stiffness_test {
namespace {

using namespace meshes;

constexpr double E = 1000, h = 0.01;

// Membrane stiffness of a sheet of springs: the second derivatives of its energy per area under uniform strain
// (εx, εy, γ), at rest. `depth` cells from the border inwards are excluded, to avoid boundary effects.
Eigen::Matrix3d membrane(const PolygonMesh& mesh, double nu, int depth) {
  const auto map = sheet_from(mesh);
  const SpringMaterial material{E, nu, h};
  const auto stretch = interaction(*map, {"stretch", "", 0, 0}, material);
  std::vector<std::unique_ptr<Interaction>> all;
  all.push_back(interaction(*map, {"stretch", "", 0, 0}, material));
  if (auto shear = interaction(*map, {"shear", "isotropic", 0, 0}, material)) all.push_back(std::move(shear));
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Vec3& x : mesh.points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  Eigen::Matrix3d c = Eigen::Matrix3d::Zero();
  double area = 0;
  for_each_face(*map, [&](Dart d) {
    Vec3 centre = Vec3::Zero();
    int corners = 0;
    for (Dart at = d; corners == 0 || at != d; at = map->map().alpha(1, map->map().alpha(0, at)), ++corners)
      centre += map->rest_of(at);
    centre /= corners;
    if ((centre - low).head<2>().minCoeff() < depth || (high - centre).head<2>().minCoeff() < depth) return;
    area += rest_area(*map, d);
    const auto add = [&](const Interaction& kind, Slot owner, std::size_t unit, Dart from) {
      const auto& words = kind.pattern.units[unit];
      const Vec3 along =
          map->rest_of(map->map().follow(from, words[1])) - map->rest_of(map->map().follow(from, words[0]));
      const double l = along.norm(), x = along.x() / l, y = along.y() / l;
      const Eigen::Vector3d strain(x * x, y * y, x * y); // of the spring, per εx, εy, γ
      c += UnitParameters::of(kind.unit(owner, unit)).k * l * l * strain * strain.transpose();
    };
    Dart at = d;
    do {
      add(*all[0], map->slot(EdgeOfFace, at), 0, at);
      at = map->map().alpha(1, map->map().alpha(0, at));
    } while (at != d);
    if (all.size() > 1 && corners == 4)
      for (std::size_t unit = 0; unit < 2; ++unit) {
        const Slot face = map->slot(FaceOfVolume, d);
        add(*all[1], face, unit, map->cells(FaceOfVolume).first_dart(face));
      }
  });
  return c / area;
}

struct Elastic {
  double young, poisson, shear;
};
Elastic constants(const Eigen::Matrix3d& membrane) { // for a sheet of thickness h, stretched along x
  const Eigen::Matrix3d compliance = (membrane / h).inverse();
  return {1 / compliance(0, 0), -compliance(1, 0) / compliance(0, 0), 1 / compliance(2, 2)};
}

TEST(Young, is_given_back_by_rectangles_at_poisson_one_third) {
  for (const double width : {1.0, 1.3, 0.8}) {
    PolygonMesh mesh = sheet(SheetPattern::Quads, 6, 6);
    for (Vec3& x : mesh.points) x.x() *= width;
    const Elastic found = constants(membrane(mesh, 1.0 / 3, 0));
    EXPECT_NEAR(found.young, E, 1e-9 * E);
    EXPECT_NEAR(found.poisson, 1.0 / 3, 1e-12);
    EXPECT_NEAR(found.shear, E / (2 * (1 + 1.0 / 3)), 1e-9 * E);
  }
}

TEST(Young, of_rectangles_elsewhere_keeps_the_shear_modulus_alone) {
  const Elastic found = constants(membrane(sheet(SheetPattern::Quads, 6, 6), 0, 0));
  EXPECT_NEAR(found.young, 0.75 * E, 1e-9 * E);
  EXPECT_NEAR(found.poisson, 0.5, 1e-12);
  for (double nu : {0.0, 0.1, 0.25, 0.4, 0.5}) {
    const Elastic each = constants(membrane(sheet(SheetPattern::Quads, 6, 6), nu, 0));
    EXPECT_NEAR(each.poisson, 1 / (3 * nu + 2), 1e-12);
    EXPECT_NEAR(each.young, 3 * E * (1 + 3 * nu) / (2 * (2 + 3 * nu)), 1e-9 * E);
    EXPECT_NEAR(each.shear, E / (2 * (1 + nu)), 1e-9 * E);
  }
}

PolygonMesh equilateral(int n) {
  PolygonMesh mesh;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) mesh.points.push_back(Vec3(x + 0.5 * y, std::sqrt(0.75) * y, 0));
  const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      mesh.add({at(x, y), at(x + 1, y), at(x, y + 1)});
      mesh.add({at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  return mesh;
}

TEST(Young, is_given_back_by_equilateral_triangles_at_poisson_one_third) {
  const Elastic found = constants(membrane(equilateral(5), 1.0 / 3, 0));
  EXPECT_NEAR(found.young, E, 1e-9 * E);
  EXPECT_NEAR(found.poisson, 1.0 / 3, 1e-12);
}

TEST(Young, of_right_isosceles_triangles_is_what_the_note_to_the_author_says) {
  const Elastic found = constants(membrane(sheet(SheetPattern::Triangles, 6, 6), 1.0 / 3, 0));
  EXPECT_NEAR(found.young, 1.125 * E, 1e-9 * E);
  EXPECT_NEAR(found.poisson, 0, 1e-12);
}

// The same from dynamics: a strip of cells, pulled by forces, settles at the extension that E predicts.
TEST(Young, is_found_by_pulling_a_sheet_in_a_scene) {
  presets::Loaded scene =
      presets::load(R"(<scene name="pull"><body><sheet cells="8 8" size="1 1"/><mass total="1"/>
    <springs young="1000" poisson="0.3333333333333333" thickness="0.01"><stretch/><shear/></springs>
    <viscosity value="10" per="body"/>
    <fix side="-x" axes="x"/><fix near="0 0.5 0"/><fix all="yes" axes="z"/>
    <drive side="+x" axes="x" displacement="1e-5 0 0" from="0" until="0.01"/></body>
    <world gravity="0 0 0"/><time step="auto" duration="20"/></scene>)");
  while (scene->time() < 5) scene->step();
  Body& body = scene.body();
  double narrowest = 1, widest = 0;
  for (const Record& x : body.map->position().values()) {
    narrowest = std::min(narrowest, x.y);
    widest = std::max(widest, x.y);
  }
  EXPECT_NEAR((1 - (widest - narrowest)) / 1e-5, 1.0 / 3, 2e-4);
  body.evaluate();
  double pull = 0;
  for (Slot v = 0; v < body.program->vertices(); ++v)
    if (body.map->rest()[v].x == 1) pull -= body.force[v].x;
  EXPECT_NEAR(pull, E * h * 1 * 1e-5, 2e-3 * E * h * 1e-5);
}

std::string refusal(const std::string& sheet, const std::string& springs) {
  try {
    presets::load(R"(<scene name="x"><body>)" + sheet + R"(<mass total="1"/>)" + springs +
                  R"(</body><time step="1e-3" duration="1"/></scene>)");
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    EXPECT_FALSE(error.hint.empty());
    return error.what();
  }
  return "accepted";
}

TEST(Young, refuses_cells_that_would_be_pushed_apart) {
  const std::string springs =
      R"(<springs young="1000" poisson="0.3333333333333333" thickness="0.01"><stretch/></springs>)";
  // A side must not be longer than w √(3ν + 2) = 1.732 w.
  EXPECT_EQ(refusal(R"(<sheet cells="1 1" size="1.7 1"/>)", springs), "accepted");
  EXPECT_NE(refusal(R"(<sheet cells="1 1" size="1.8 1"/>)", springs).find("(0.9, 0, 0)"), std::string::npos);
  // The long side of two triangles with angles of 120° and more.
  const std::string blunt = R"(<sheet pattern="crossed" cells="1 1" size="1.8 1"/>)";
  EXPECT_NE(refusal(blunt, springs).find("triangle"), std::string::npos);
}

TEST(Young, refuses_no_stiffness_two_stiffnesses_and_no_formula) {
  const std::string sheet = R"(<sheet cells="2 2" size="1 1"/>)",
                    with = R"(<springs young="10" thickness="0.1">)";
  EXPECT_NE(refusal(sheet, "<springs><stretch/></springs>").find("needs its stiffness"), std::string::npos);
  EXPECT_NE(refusal(sheet, with + R"(<stretch k="3"/></springs>)").find("as well"), std::string::npos);
  EXPECT_NE(refusal(sheet, with + "<bend/></springs>").find("needs its stiffness"), std::string::npos);
  EXPECT_EQ(refusal(sheet, with + R"(<stretch/><bend k="2"/></springs>)"), "accepted");
  EXPECT_NE(refusal(sheet, R"(<springs young="10"><stretch/></springs>)").find("thickness"), std::string::npos);
}

TEST(Young, formula_gives_van_gelders_and_baudets_values) {
  const auto triangle = sheet_from([] {
    PolygonMesh mesh;
    mesh.points = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.3, 0.8, 0)};
    mesh.add({0, 1, 2});
    return mesh;
  }());
  const double nu = 0.25, area = 0.4, a2 = 0.7 * 0.7 + 0.64, b2 = 0.09 + 0.64, c2 = 1;
  const SpringMaterial m{E, nu, h};
  EXPECT_NEAR(edge_stiffness(m, *triangle, Dart{0u}),
              h * (E / (1 + nu) * area / c2 + E * nu / (1 - nu * nu) * (a2 + b2 - c2) / (8 * area)), 1e-12 * E);
  PolygonMesh rectangle = sheet(SheetPattern::Quads, 1, 1);
  for (Vec3& x : rectangle.points) x.y() *= 1.5;
  const auto quad = sheet_from(rectangle); // l = 1 along x, w = 1.5
  EXPECT_NEAR(edge_stiffness(m, *quad, Dart{0u}), h * E * (2.25 * (3 * nu + 2) - 1) / (4 * 1.5 * (1 + nu)),
              1e-12 * E);
  EXPECT_NEAR(edge_stiffness(m, *quad, Dart{2u}), h * E * ((3 * nu + 2) - 2.25) / (4 * 1.5 * (1 + nu)),
              1e-12 * E);
  EXPECT_NEAR(diagonal_stiffness(m, *quad, Dart{0u}), h * E * 3.25 / (4 * 1.5 * (1 + nu)), 1e-12 * E);
}

} // namespace
} // namespace rend::spring_stiffness_test
