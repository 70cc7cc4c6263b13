// A rule at one edge alone: selected by a box, or found by a test in a script.
#include "sim/topology/isomorphism.h"
#include "tests/sim/presets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

presets::Loaded sheet_with(const std::string& apply, const std::string& rules = "") {
  return presets::load("<scene>" + rules +
                       R"xml(<body><sheet pattern="triangles" cells="2 2" size="1 1"/>)xml" + apply +
                       R"xml(<mass total="1"/></body><time duration="0"/></scene>)xml");
}

double longest_edge(const EmbeddedMap& map) {
  double most = 0;
  map.map().for_each_dart([&](Dart d) {
    most = std::max(most, (map.position_of(d) - map.position_of(map.map().alpha(0, d))).norm());
  });
  return most;
}

// As presets/README.md has it: of the inner edges of a sheet one flips, to the other diagonal of its triangles.
TEST(OneEdge, is_selected_by_a_box_or_by_a_test_in_a_script) {
  const auto by_box = sheet_with(R"xml(<apply rule="flip-edge" box="0 0.5 0 0.5 0.5 0"/>)xml");
  const auto by_test = sheet_with(R"xml(<apply rule="flip-at" p="point(0.25, 0.5, 0)"/>)xml",
                                  R"xml(<script name="flip-at" hook="a*(0,1,2)">
      <where name="p" value="point(0, 0, 0)"/>
      <for each="e*(0,2)" where="norm(mean(e, edge) - p) &lt; 1e-3" apply="flip-edge"/></script>)xml");
  const EmbeddedMap &one = *by_box.body().map, &other = *by_test.body().map;
  EXPECT_TRUE(isomorphism(one.map(), other.map(), [&](Dart a, Dart b) {
    return (one.position_of(a) - other.position_of(b)).norm() < 1e-12;
  }));
  EXPECT_NEAR(longest_edge(*sheet_with("").body().map), std::sqrt(0.5), 1e-12);
  EXPECT_NEAR(longest_edge(one), std::hypot(0.5, 1.0), 1e-12);
}

} // namespace
} // namespace rend
