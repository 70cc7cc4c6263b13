// What moves through a step as one rigid body keeps momentum and angular momentum, and gains no energy.
#include "sim/contact/contact_zone.h"

#include <gtest/gtest.h>

#include <random>

namespace rend::contact_zone_test {
namespace {

class ContactZone : public testing::Test {
protected:
  Vec3 point(double size) {
    std::uniform_real_distribution<double> at(-size, size);
    const double x = at(random_), y = at(random_), z = at(random_);
    return {x, y, z};
  }
  std::vector<ZoneMember> members(double step) {
    std::vector<ZoneMember> all(5);
    for (ZoneMember& one : all) {
      one.mass = 0.1 + point(1).squaredNorm();
      one.from = point(1);
      one.to = one.from + point(step);
    }
    return all;
  }
  std::mt19937_64 random_{11};
};

TEST_F(ContactZone, keeps_distances_and_momentum_and_gains_no_energy) {
  constexpr double step = 1e-3;
  for (int n = 0; n < 500; ++n) {
    const auto all = members(step);
    const auto motion = nearest_rigid_motion(all);
    Vec3 momentum = Vec3::Zero(), turning = Vec3::Zero();
    double before = 0, after = 0;
    for (const ZoneMember& one : all) {
      const Vec3 to = motion(one.from);
      momentum += one.mass * (to - one.to);
      turning += one.mass * one.from.cross(to - one.to);
      before += one.mass * (one.to - one.from).squaredNorm();
      after += one.mass * (to - one.from).squaredNorm();
      for (const ZoneMember& other : all)
        ASSERT_NEAR((to - motion(other.from)).norm(), (one.from - other.from).norm(), 1e-14);
    }
    ASSERT_LT(momentum.norm(), 1e-15) << n;
    ASSERT_LT(turning.norm(), 30 * step * step) << n << ": of second order in the angle";
    ASSERT_LE(after, before * (1 + 5 * step)) << n;
  }
}

TEST_F(ContactZone, leaves_a_rigid_motion_as_it_is) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.01, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  auto all = members(1);
  for (ZoneMember& one : all) one.to = turn * one.from + Vec3(0.1, 0.2, 0.3);
  const auto motion = nearest_rigid_motion(all);
  for (const ZoneMember& one : all) EXPECT_LT((motion(one.from) - one.to).norm(), 1e-4) << "to second order";
}

TEST_F(ContactZone, goes_where_a_prescribed_member_goes) {
  auto all = members(1e-3);
  all[2].prescribed = true;
  const auto motion = nearest_rigid_motion(all);
  EXPECT_LT((motion(all[2].from) - all[2].to).norm(), 1e-8);
}

TEST_F(ContactZone, of_members_on_a_line_does_not_turn_about_it) {
  std::vector<ZoneMember> all(3);
  for (int k = 0; k < 3; ++k) all[k] = {1, false, Vec3(k, 0, 0), Vec3(k, k == 1 ? 1e-3 : 0, 0)};
  const auto motion = nearest_rigid_motion(all);
  const Vec3 beside = motion(Vec3(1, 0, 1));
  EXPECT_NEAR(beside.z(), 1, 1e-12);
  EXPECT_TRUE(beside.allFinite());
}

TEST(ContactZones, that_share_a_part_are_one) {
  ContactZones zones;
  const auto part = [](std::uint32_t n) { return ZonePart{0, n}; };
  EXPECT_TRUE(zones.unite(std::array{part(1), part(2)}));
  EXPECT_FALSE(zones.unite(std::array{part(2), part(1)}));
  zones.unite(std::array{part(3), part(4)});
  zones.unite(std::array{part(5), ZonePart{ZonePart::box, 1}});
  EXPECT_EQ(zones.all().size(), 3u);
  zones.unite(std::array{part(2), part(3)});
  const auto all = zones.all();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0], (std::vector{part(1), part(2), part(3), part(4)}));
  EXPECT_TRUE(all[1].back().is_box());
}

} // namespace
} // namespace rend::contact_zone_test
