// What contact remembers of a run: how near things came, and which obstacles were touched.
#include "sim/outside/contact_work.h"

#include "sim/presets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace rend::contact_work_test {
namespace {

presets::Loaded falling(const std::string& integrator, const std::string& z = "0.08",
                        const std::string& contact = "<contact thickness=\"0.01\"/>",
                        const SceneOptions& options = {}) {
  return presets::load(R"(<scene><body><sheet pattern="triangles" cells="4 4" size="1 1"/>
      <place rotate="0 3 0" translate="0 0 )" +
                           z + R"("/><mass total="0.1"/>
      <springs><stretch k="100" damping="0.02"/><bend kind="provot" k="2"/></springs>)" +
                           contact + R"(</body>
      <world><floor z="0"/><sphere centre="0.5 0.5 -0.05" radius="0.06"/>
      <box low="3 3 -1" high="4 4 0.1"/></world>
      <time step="5e-4" duration="2" integrator=")" +
                           integrator + R"("/></scene>)",
                       options);
}

void go(const presets::Loaded& scene, int steps) {
  for (int n = 0; n < steps; ++n) scene->step();
}

ContactWork contact(const presets::Loaded& scene) {
  return scene->energy().now.work.contact;
}

void expect_same(const presets::Loaded& a, const presets::Loaded& b) {
  EXPECT_EQ(contact(a).gap, contact(b).gap);
  EXPECT_EQ(contact(a).overlap, contact(b).overlap);
  for (std::size_t n = 0; n < a->world().obstacles(); ++n)
    EXPECT_EQ(a.body().work_meter->touched(n), b.body().work_meter->touched(n)) << n;
}

TEST(ContactWork, knows_how_near_things_came_and_what_was_touched) {
  for (const char* integrator : {"symplectic", "verlet", "rk4", "implicit"}) {
    const auto scene = falling(integrator, "0.1");
    EXPECT_TRUE(std::isinf(contact(scene).gap)) << integrator;
    EXPECT_FALSE(scene.body().work_meter->touched(0)) << integrator;
    go(scene, 800);
    EXPECT_NEAR(contact(scene).gap, 0.01, 1e-6) << integrator;
    EXPECT_NEAR(contact(scene).overlap, 0, 1e-6) << integrator;
    EXPECT_TRUE(scene.body().work_meter->touched(0)) << integrator << ": the floor";
    EXPECT_TRUE(scene.body().work_meter->touched(1)) << integrator << ": the sphere";
    EXPECT_FALSE(scene.body().work_meter->touched(2)) << integrator << ": the box is elsewhere";
  }
}

// What starts nearer than the distance that is kept stays there (contact_answer.h).
TEST(ContactWork, tells_the_overlap_of_what_started_too_near) {
  const auto scene = presets::load(R"(<scene><body><sheet cells="2 2" size="1 1"/><place translate="0 0 0.004"/>
      <mass total="0.1"/><springs><stretch k="100"/></springs><contact thickness="0.01"/></body>
      <world><floor z="0"/></world><time step="5e-4" duration="1"/></scene>)");
  go(scene, 100);
  EXPECT_NEAR(contact(scene).gap, 0.004, 1e-12);
  EXPECT_NEAR(contact(scene).overlap, 0.006, 1e-12);
}

TEST(ContactWork, lives_in_checkpoints) {
  const auto whole = falling("symplectic"), first = falling("symplectic"), second = falling("symplectic");
  go(whole, 600);
  go(first, 300);
  Archive written;
  first->store(written);
  Archive read(std::span<const std::uint8_t>(written.bytes()));
  second->store(read);
  expect_same(first, second);
  EXPECT_TRUE(second.body().work_meter->touched(0));
  go(second, 300);
  expect_same(whole, second);
}

// A sheet that falls flat loses all its motion in the step in which it strikes. The fault comes after contact
// of that step: what it had found is found again by those that are made in its place.
TEST(ContactWork, returns_with_a_rollback) {
  const auto flat = [](const SceneOptions& options) {
    return presets::load(R"(<scene><body><sheet cells="2 2" size="1 1"/><place translate="0 0 0.05"/>
        <mass total="0.1"/><springs><stretch k="100"/></springs><contact thickness="0.01"/></body>
        <world><floor z="0"/></world><time step="5e-4" duration="1"/></scene>)",
                         options);
  };
  const auto sound = flat({});
  int steps = 0;
  for (; !contact(sound).touched; ++steps) sound->step();
  SceneOptions options;
  options.fault = Fault{StepStage::Contact, steps - 1, false};
  const auto faulty = flat(options);
  go(faulty, steps);
  EXPECT_GE(faulty->guard().rejected, 1);
  EXPECT_NEAR(contact(sound).lost(), 0.1 * 9.81 * 0.04, 0.002);
  EXPECT_NEAR(contact(faulty).lost(), contact(sound).lost(), 0.002) << "once, not twice";
  EXPECT_NEAR(contact(faulty).overlap, 0, 1e-9);
}

TEST(ContactWork, is_nothing_where_nothing_is_in_contact) {
  const auto scene = falling("symplectic", "0.1", "");
  go(scene, 10);
  EXPECT_EQ(scene.body().work_meter, nullptr);
  EXPECT_TRUE(std::isinf(contact(scene).gap));
}

} // namespace
} // namespace rend::contact_work_test
