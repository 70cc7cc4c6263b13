// Masses of fragments: of a strip that is cut where the test says.
#include "sim/body/fragment_masses.h"

#include "sim/presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::fragment_masses_test {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::UnorderedElementsAre;

// Ten quads in a row, of 1 kg in all.
presets::Loaded strip() {
  return presets::load(R"(<scene><body><sheet cells="10 1" size="10 1"/><mass total="1"/>
      <springs><stretch k="60"/></springs><tear criterion="global-border" threshold="1e9"/></body>
      <time step="1e-3" duration="1"/></scene>)");
}

// Separates the quads on either side of the line x.
void cut_at(Body& body, double x) {
  body.map->edit([&](Edit& edit) {
    std::vector<Dart> across;
    edit.map().for_each_dart([&](Dart d) {
      const Dart end = edit.map().alpha(0, d);
      if (std::abs(body.map->rest_of(d).x() - x) < 1e-9 && std::abs(body.map->rest_of(end).x() - x) < 1e-9)
        across.push_back(d);
    });
    ASSERT_EQ(across.size(), 4u);
    unsew(edit, 2, across.front());
  });
}

TEST(FragmentMasses, are_those_of_the_quads_of_each) {
  const auto scene = strip();
  Body& body = scene.body();
  const auto near = [](double value) { return DoubleNear(value, 1e-12); };
  EXPECT_THAT(fragment_masses(*body.map, *body.mass), ElementsAre(near(1)));
  cut_at(body, 1);
  cut_at(body, 4);
  EXPECT_THAT(fragment_masses(*body.map, *body.mass), UnorderedElementsAre(near(0.1), near(0.3), near(0.6)));
}

} // namespace
} // namespace rend::fragment_masses_test
