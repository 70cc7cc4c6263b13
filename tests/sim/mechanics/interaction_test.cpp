// Every interaction, on irregular and warped sheets, against a reference computed from polygons.
#include "sim/brute_force.h"
#include "sim/mechanics/spring_law.h"
#include "sim/presets.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::interaction_test {
namespace {

using namespace meshes;

constexpr double damping = 0.8;

// A body with one interaction; null if it does not occur on the sheet.
std::unique_ptr<Body> body_with(const Spring& spring, const PolygonMesh& mesh,
                                Cumulated cumulated = Cumulated::Auto) {
  Recipe recipe;
  recipe.springs = {spring};
  recipe.cumulated = cumulated;
  recipe.criteria = {"atomic-border"};
  recipe.scheme = "rk4";
  std::unique_ptr<Body> made = body(mesh, recipe);
  return made->interactions.empty() ? nullptr : std::move(made);
}

struct Forces {
  std::vector<Record> folded, elementary, corner;
};
Forces forces_of(const Body& body) {
  Forces f;
  f.folded.resize(body.program->vertices());
  f.elementary = f.folded;
  f.corner.resize(body.map->cells(VertexOfFace).slots());
  body.program->forces(positions(body), velocities(body), f.folded.data());
  body.program->corner_forces(positions(body), velocities(body), f.corner.data(), f.elementary.data());
  return f;
}

// Calls f(body, reference) for every interaction on every sheet, away from rest.
template <class F> void on_every_sheet(F&& f) {
  for (const Named& sheet : irregular()) {
    for (const Spring& spring : all_springs(damping)) {
      SCOPED_TRACE(spring.element + " " + spring.kind + " on " + sheet.name);
      BruteForce brute(sheet.mesh);
      const auto body = body_with(spring, sheet.mesh);
      if (!body) continue;
      shake(*body, 0.15, 7);
      brute.look_at(*body);
      brute.add(spring);
      f(*body, brute);
    }
  }
}

TEST(Interaction, has_as_many_rows_as_the_polygons_have_springs) {
  on_every_sheet([](const Body& body, const BruteForce& brute) {
    EXPECT_EQ(body.program->elementary()[0].rows().live_count(), brute.units());
    const bool pairs = body.interactions[0]->law == spring_law();
    EXPECT_EQ(body.program->folded()[0].rows().live_count(), pairs ? brute.pairs() : brute.units());
  });
}

TEST(Interaction, has_the_618_folded_springs_of_the_thesis_on_ten_by_ten_quads) {
  const presets::Loaded scene = presets::load(presets::cloth("quads", 10));
  std::size_t rows = 0;
  for (const Binder& binder : scene.body().program->folded()) rows += binder.rows().live_count();
  EXPECT_EQ(rows, 618u);
}

TEST(Interaction, gives_the_forces_that_the_polygons_give) {
  on_every_sheet([](const Body& body, const BruteForce& brute) {
    const Forces f = forces_of(body);
    EXPECT_GT(largest(f.folded), 0.01);
    EXPECT_LT(difference(f.folded, brute.forces(body)), 1e-12);
    EXPECT_LT(difference(f.elementary, brute.forces(body)), 1e-12);
  });
}

TEST(Interaction, gives_each_element_the_share_that_the_polygons_give) {
  on_every_sheet([](const Body& body, const BruteForce& brute) {
    EXPECT_LT(difference(forces_of(body).corner, brute.corner_forces(body)), 1e-12);
  });
}

TEST(Interaction, gives_the_same_forces_unfolded) {
  for (const Spring& spring : all_springs(damping)) {
    const PolygonMesh mesh = warped(sheet(SheetPattern::Quads, 4, 4), 0.2, 3);
    const auto folded = body_with(spring, mesh), unfolded = body_with(spring, mesh, Cumulated::No);
    shake(*folded, 0.2, 5);
    shake(*unfolded, 0.2, 5);
    EXPECT_EQ(unfolded->program->folded()[0].rows().live_count(),
              unfolded->program->elementary()[0].rows().live_count());
    EXPECT_LT(difference(forces_of(*folded).folded, forces_of(*unfolded).folded), 1e-12);
  }
}

// Σf and Σ x×f relative to Σ|f| and Σ|x||f|.
std::pair<double, double> resultants(const Body& body, const std::vector<Record>& forces) {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double all = 0, all_moments = 0;
  for (std::size_t v = 0; v < forces.size(); ++v) {
    const Vec3 x = positions(body)[v], f = forces[v];
    force += f;
    moment += x.cross(f);
    all += f.norm();
    all_moments += x.norm() * f.norm();
  }
  return {force.norm() / all, moment.norm() / all_moments};
}

TEST(Interaction, conserves_linear_and_angular_momentum) {
  on_every_sheet([](const Body& body, const BruteForce&) {
    const Forces f = forces_of(body);
    for (const auto& forces : {f.folded, f.elementary}) {
      const auto [force, moment] = resultants(body, forces);
      EXPECT_LT(force, 1e-13);
      EXPECT_LT(moment, 1e-13);
    }
  });
}

TEST(Interaction, of_hinges_says_at_how_many_edges_it_fits_no_face) {
  PolygonMesh hexagons;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x) hexagons.points.push_back(Vec3(x, y, 0));
  hexagons.add({0, 1, 2, 5, 4, 3});
  hexagons.add({3, 4, 5, 8, 7, 6});
  std::vector<Named> all = irregular();
  all.push_back({"hexagons", hexagons});
  for (const Named& each : all) {
    SCOPED_TRACE(each.name);
    BruteForce brute(each.mesh);
    const auto map = sheet_from(each.mesh);
    brute.look_at(*body(each.mesh, {}));
    brute.add({"bend", "provot"});
    const std::size_t inner = brute.units() / 2; // one at each end of an edge
    brute.add({"bend", "angular"});
    std::vector<std::string> notes;
    const auto made = interaction(*map, {"bend", "angular"}, {}, &notes);
    EXPECT_EQ(made != nullptr, brute.units() > 0);
    const std::string expected =
        brute.units() == 0 ? "left out"
                           : fmt::format("no effect on {} of the {} edges", inner - brute.units(), inner);
    if (brute.units() == inner)
      EXPECT_THAT(notes, testing::IsEmpty());
    else
      EXPECT_THAT(notes, testing::ElementsAre(testing::HasSubstr(expected)));
  }
}

TEST(Interaction, is_at_rest_at_rest) {
  for (const Named& sheet : irregular()) {
    for (const Spring& spring : all_springs()) {
      const auto body = body_with(spring, sheet.mesh);
      if (!body) continue;
      EXPECT_LT(largest(forces_of(*body).folded), 1e-12) << spring.kind << " on " << sheet.name;
    }
  }
}

TEST(Interaction, dissipates_by_its_damping) {
  for (const Named& sheet : irregular()) {
    for (const Spring& spring : all_springs(damping)) {
      const auto body = body_with(spring, sheet.mesh);
      if (!body) continue;
      for (unsigned seed = 0; seed < 5; ++seed) {
        shake(*body, 0, seed); // at rest, so that only damping acts
        const std::vector<Record> f = forces_of(*body).folded;
        double power = 0;
        for (std::size_t v = 0; v < f.size(); ++v) power += f[v].vec().dot(velocities(*body)[v].vec());
        EXPECT_LT(power, 0) << spring.kind << " on " << sheet.name;
      }
    }
  }
}

} // namespace
} // namespace rend::interaction_test
