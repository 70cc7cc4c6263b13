// What a selector selects, against conditions on rest positions written here.
#include "sim/embedding/selector.h"

#include "sim/presets.h"

#include <functional>
#include <gtest/gtest.h>

namespace rend::selector_test {
namespace {

// The rest positions selected by <fix>, of a placed cloth of 10 × 10 cells.
std::vector<Vec3> selected(const std::string& selector, const std::string& place = "",
                           const std::string& sheet = R"(cells="10 10" size="1 1")") {
  const auto scene = presets::load("<scene><body><sheet " + sheet + "/>" + place + R"(<mass total="1"/><fix )" +
                                   selector + R"(/></body><time step="1" duration="1"/></scene>)");
  std::vector<Vec3> points;
  for (Slot v : scene.body().constraints.vertices()) points.push_back(scene.body().map->rest()[v]);
  return points;
}

TEST(Selector, near_takes_the_closest_vertex) {
  EXPECT_EQ(selected(R"(near="1 0 0")"), std::vector<Vec3>{Vec3(1, 0, 0)});
  EXPECT_EQ(selected(R"(near="-5 9 2")"), std::vector<Vec3>{Vec3(0, 1, 0)});
  const std::vector<Vec3> inner = selected(R"(near="0.52 0.31 0.1")");
  ASSERT_EQ(inner.size(), 1u);
  EXPECT_LT((inner[0] - Vec3(0.5, 0.3, 0)).norm(), 1e-15);
  EXPECT_EQ(selected(R"(near="0.05 0 0")").size(), 1u); // equidistant vertices
}

TEST(Selector, side_takes_a_whole_end) {
  for (const char* side : {"-x", "+x", "-y", "+y"}) {
    const std::vector<Vec3> points = selected(std::string("side=\"") + side + '"');
    ASSERT_EQ(points.size(), 11u) << side;
    for (const Vec3& x : points) EXPECT_EQ(x[side[1] - 'x'], side[0] == '+' ? 1 : 0);
  }
  EXPECT_EQ(selected(R"(side="-z")").size(), 121u); // a flat sheet is at both ends of z
}

TEST(Selector, all_takes_all) {
  EXPECT_EQ(selected(R"(all="yes")").size(), 121u);
}

// Grid lines are rounded: 0.3 of a row may be 0.30000000000000004. A box that ends on a line takes the whole
// line.
TEST(Selector, box_takes_whole_grid_lines_where_it_ends_on_them) {
  for (int n = 0; n <= 10; ++n) {
    const std::string to = std::to_string(n / 10.0).substr(0, 3);
    EXPECT_EQ(selected("box=\"0 0 0 " + to + " 1 0\"").size(), 11u * static_cast<std::size_t>(n + 1)) << to;
    EXPECT_EQ(selected("box=\"0 " + to + " 0 1 1 0\"").size(), 11u * static_cast<std::size_t>(11 - n)) << to;
  }
  EXPECT_EQ(selected(R"(box="0 0 0 0.299999 1 0")").size(), 33u);
}

TEST(Selector, box_takes_its_corners_in_any_order) {
  EXPECT_EQ(selected(R"(box="0.45 0.8 1 -1 0.35 -1")"), selected(R"(box="-1 0.35 -1 0.45 0.8 1")"));
  EXPECT_EQ(selected(R"(box="0.45 0.8 1 -1 0.35 -1")").size(), 5u * 5);
}

TEST(Selector, looks_at_the_body_after_it_was_placed) {
  const std::string place = R"(<place scale="2" rotate="90 0 90" translate="5 0 0"/>)"; // x → y, y → z, doubled
  std::vector<Vec3> points = selected(R"(side="+z")", place);
  ASSERT_EQ(points.size(), 11u);
  for (const Vec3& x : points) {
    EXPECT_EQ(x.x(), 5);
    EXPECT_EQ(x.z(), 2);
  }
  points = selected(R"(near="5 2 0")", place);
  EXPECT_EQ(points, std::vector<Vec3>{Vec3(5, 2, 0)});
}

TEST(Selector, side_survives_a_rotation_that_rounds) {
  EXPECT_EQ(selected(R"(side="+x")", R"(<place rotate="0 37 0"/>)").size(), 11u);
  EXPECT_EQ(selected(R"(side="-y")", R"(<place rotate="0 37 0"/>)").size(), 11u);
}

TEST(Placement, scales_rotates_about_x_then_y_then_z_and_moves) {
  const auto scene = presets::load(R"(<scene><body><sheet cells="1 1" size="1 1"/>
      <place scale="3" rotate="30 -50 110" translate="1 2 3"/><mass total="1"/></body>
      <time step="1" duration="1"/></scene>)");
  const auto about = [](double degrees, const Vec3& axis) {
    return Eigen::AngleAxisd(degrees * 3.14159265358979323846 / 180, axis).toRotationMatrix();
  };
  const Eigen::Matrix3d turn = about(110, Vec3::UnitZ()) * about(-50, Vec3::UnitY()) * about(30, Vec3::UnitX());
  for (Slot v = 0; v < 4; ++v) {
    const Vec3 flat[4] = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0)};
    const Vec3 placed = 3 * turn * flat[v] + Vec3(1, 2, 3);
    double least = 1;
    for (Slot w = 0; w < 4; ++w) least = std::min(least, (scene.body().map->rest()[w].vec() - placed).norm());
    EXPECT_LT(least, 1e-14);
  }
}

} // namespace
} // namespace rend::selector_test
