// Error norms on constructed states, and samples of real scenes.
#include "sim/study/errors.h"
#include "tests/sim/presets.h"
#include "tests/sim/random_meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace rend::errors_test {
namespace {

// Points on the x axis with these masses, at rest at t = 0.
Trajectory still(const std::vector<double>& masses) {
  Trajectory t;
  t.mass = masses;
  for (std::size_t n = 0; n < masses.size(); ++n) t.rest.emplace_back(static_cast<double>(n), 0, 0);
  StateSample start;
  start.position = t.rest;
  start.velocity.assign(masses.size(), Vec3::Zero());
  t.samples.push_back(start);
  return t;
}

void add(Trajectory& t, double time, const std::vector<Vec3>& moved, const Vec3& velocity, double kinetic) {
  StateSample sample = t.samples.front();
  sample.time = time;
  for (std::size_t n = 0; n < moved.size(); ++n) sample.position[n] += moved[n];
  for (Vec3& v : sample.velocity) v = velocity;
  sample.kinetic = kinetic;
  t.samples.push_back(sample);
}

TEST(Errors, are_weighed_by_mass_over_all_samples_after_the_start) {
  Trajectory reference = still({1, 3}), run = still({1, 3});
  add(reference, 1, {{0, 0, 0}, {0, 0, 0}}, {0, 0, 0}, 2);
  add(reference, 2, {{0, 4, 0}, {0, 4, 0}}, {0, 0, 5}, 8);
  add(run, 1, {{0, 0, 2}, {0, 0, 0}}, {1, 0, 0}, 2.5);
  add(run, 2, {{0, 4, 0}, {0, 4, 6}}, {0, 0, 5}, 7);
  const auto errors = compare(run, reference);
  ASSERT_TRUE(errors);
  EXPECT_EQ(errors->samples, 2u);
  const double first = std::sqrt(1 * 4 / 4.0), second = std::sqrt(3 * 36 / 4.0);
  EXPECT_DOUBLE_EQ(errors->position.over_time, std::sqrt((first * first + second * second) / 2));
  EXPECT_DOUBLE_EQ(errors->position.final, second);
  EXPECT_DOUBLE_EQ(errors->position.over_time_max, 6);
  EXPECT_DOUBLE_EQ(errors->velocity.over_time, std::sqrt(0.5));
  EXPECT_DOUBLE_EQ(errors->velocity.final, 0);
  EXPECT_DOUBLE_EQ(errors->energy, 1);
  EXPECT_FALSE(errors->momentum) << "something may act from outside";
  const Scales scales = scales_of(reference);
  EXPECT_DOUBLE_EQ(scales.length, 4);
  EXPECT_DOUBLE_EQ(scales.speed, 5);
  EXPECT_DOUBLE_EQ(scales.energy, 8);
  EXPECT_DOUBLE_EQ(scales.mass, 4);
}

TEST(Errors, count_up_to_the_given_time_and_need_a_sample) {
  Trajectory reference = still({1}), run = still({1});
  for (double t : {1.0, 2.0, 3.0}) {
    add(reference, t, {{0, 0, 0}}, {0, 0, 0}, 0);
    add(run, t, {{0, 0, t}}, {0, 0, 0}, 0);
  }
  EXPECT_DOUBLE_EQ(compare(run, reference, 2)->position.over_time, std::sqrt(2.5));
  EXPECT_FALSE(compare(run, reference, 0.5));
  EXPECT_FALSE(compare(still({1}), reference));
}

TEST(Errors, leave_out_what_is_gone) {
  Trajectory reference = still({1, 1}), run = still({1, 1});
  const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  add(reference, 1, {{0, 0, 0}, nowhere}, {0, 0, 0}, 0);
  add(run, 1, {{0, 3, 0}, {0, 0, 0}}, {0, 0, 0}, 0);
  EXPECT_DOUBLE_EQ(compare(run, reference)->position.final, 3);
}

TEST(Errors, of_different_meshes_are_those_of_common_vertices) {
  const auto sampled = [](int cells) {
    const auto s = presets::load(presets::cloth("quads", cells));
    Sampler sampler(*s.scene);
    sampler.take(*s.scene);
    sampler.take(*s.scene);
    Trajectory t = sampler.finish(*s.scene);
    t.samples.back().time = 1;
    return t;
  };
  const Trajectory coarse = sampled(3);
  Trajectory fine = sampled(6);
  ASSERT_EQ(coarse.rest.size(), 16u);
  ASSERT_EQ(fine.rest.size(), 49u);
  for (Vec3& x : fine.samples.back().position) x += Vec3(0, 0, 0.5);
  EXPECT_NEAR(compare(coarse, fine)->position.final, 0.5, 1e-15);
}

TEST(Overlap, is_what_both_have_of_what_one_has) {
  const std::vector<TornSide> a{{0, Dart{1u}}, {0, Dart{5u}}, {1, Dart{1u}}},
      b{{0, Dart{5u}}, {1, Dart{1u}}, {1, Dart{2u}}};
  EXPECT_DOUBLE_EQ(overlap(a, b), 0.5);
  EXPECT_DOUBLE_EQ(overlap(a, a), 1);
  EXPECT_DOUBLE_EQ(overlap(a, {}), 0);
  EXPECT_DOUBLE_EQ(overlap({}, {}), 1);
}

TEST(Sampler, finds_the_sides_that_tore_and_keeps_corners_and_their_mass) {
  const auto s =
      presets::load(presets::cloth("quads", 4, R"(<tear criterion="global-border" threshold="0.05"/>)"));
  Sampler sampler(*s.scene);
  sampler.take(*s.scene);
  while (s->time() < 1 && s->tears() < 3) s->step();
  sampler.take(*s.scene);
  const Trajectory t = sampler.finish(*s.scene);
  ASSERT_GE(t.tear_count, 3u);
  EXPECT_EQ(t.rest.size(), 4u * 16u);
  double mass = 0;
  for (double m : t.mass) mass += m;
  EXPECT_NEAR(mass, 0.1, 1e-15);
  EXPECT_EQ(t.torn.size(), 2 * t.tear_count) << "each separation lays two sides bare";
  EXPECT_EQ(*t.first_tear, s.body().events.front().time);
  for (std::size_t n = 0; n < t.mass.size(); ++n) EXPECT_TRUE(t.samples.back().position[n].allFinite());
}

TEST(Sampler, finds_its_points_again_where_elements_are_gone_and_slots_were_numbered_anew) {
  const auto s =
      presets::load(presets::cloth("quads", 4, R"(<tear criterion="global-border" threshold="1e9"/>)"));
  Body& body = s.body();
  Sampler sampler(*s.scene);
  meshes::shake(body, 0.1, 1);
  body.map->edit([](Edit& edit) {
    for (const std::uint32_t first : {16U, 64U}) remove_orbit(edit, FaceOfVolume, Dart{first});
  });
  body.rebind();
  sampler.take(*s.scene);
  body.map->renumber();
  body.rebind();
  sampler.take(*s.scene);
  const Trajectory t = sampler.finish(*s.scene);
  const std::vector<Vec3>&before = t.samples[0].position, &after = t.samples[1].position;
  std::size_t gone = 0;
  for (std::size_t n = 0; n < before.size(); ++n) {
    gone += !after[n].allFinite();
    EXPECT_TRUE(before[n].allFinite() ? after[n] == before[n] : !after[n].allFinite());
  }
  EXPECT_EQ(gone, 8u);
}

} // namespace
} // namespace rend::errors_test
