// The nearest points of an edge and a face, and whether one passes through the other: against sampled points,
// and against the signs of volumes.
#include "sim/contact/edge_face.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

namespace rend::edge_face_test {
namespace {

class EdgeFace : public testing::Test {
protected:
  Vec3 point() {
    std::uniform_real_distribution<double> at(-1, 1);
    const double x = at(random_), y = at(random_), z = at(random_);
    return {x, y, z};
  }
  std::mt19937_64 random_{7};
};

double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

// The edge meets the plane of the face between its ends, and the face lies around it: five signs of volumes.
bool meet(const Segment& e, const TriangleCorners& f) {
  if (volume(f[0], f[1], f[2], e[0]) * volume(f[0], f[1], f[2], e[1]) >= 0) return false;
  const double a = volume(e[0], e[1], f[0], f[1]), b = volume(e[0], e[1], f[1], f[2]),
               c = volume(e[0], e[1], f[2], f[0]);
  return (a > 0) == (b > 0) && (b > 0) == (c > 0);
}

TEST_F(EdgeFace, passes_through_where_signs_of_volumes_say_so) {
  int through = 0;
  for (int n = 0; n < 20000; ++n) {
    const Segment e{point(), point()};
    const TriangleCorners f{point(), point(), point()};
    ASSERT_EQ(passes_through(e, f, 0), meet(e, f)) << n;
    through += meet(e, f);
  }
  EXPECT_GT(through, 500);
}

TEST_F(EdgeFace, what_is_less_deep_than_it_may_be_only_touches) {
  const TriangleCorners f{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  const auto through = [&](double x, double low) {
    return passes_through({Vec3(x, 0.2, low), Vec3(x, 0.2, 1)}, f, 1e-3);
  };
  EXPECT_TRUE(through(0.2, -2e-3));
  EXPECT_FALSE(through(0.2, -0.5e-3)) << "by an end";
  EXPECT_TRUE(through(0, -1)) << "at a side";
  EXPECT_TRUE(through(-0.5e-3, -1)) << "hardly beside it";
  EXPECT_FALSE(through(-2e-3, -1)) << "beside it";
  EXPECT_FALSE(passes_through({Vec3(0, 0, -1), Vec3(0, 0, 1)}, {f[0], f[1], f[1]}, 0)) << "a face without area";
}

// The least of many pairs of points: not below the distance, and hardly above it.
template <class P, class Q> double sampled_distance(const P& one, const Q& other) {
  double least = 1e300;
  for (const Vec3& p : one)
    for (const Vec3& q : other) least = std::min(least, (p - q).norm());
  return least;
}

std::vector<Vec3> points_of(const Segment& x) {
  std::vector<Vec3> all;
  for (int n = 0; n <= 40; ++n) all.push_back(point_at(x, n / 40.0));
  return all;
}

std::vector<Vec3> points_of(const TriangleCorners& x) {
  std::vector<Vec3> all;
  for (int a = 0; a <= 20; ++a)
    for (int b = 0; a + b <= 20; ++b)
      all.push_back(point_at(x, Weights{a / 20.0, b / 20.0, (20 - a - b) / 20.0}));
  return all;
}

TEST_F(EdgeFace, the_least_distance_of_segments_is_never_above_their_distance) {
  for (int n = 0; n < 3000; ++n) {
    const Segment p{point(), point()};
    const bool parallel = n % 3 == 0, short_one = n % 7 == 0;
    Segment q{point(), point()};
    if (parallel) q[1] = q[0] + 0.7 * (p[1] - p[0]) + 1e-4 * (n % 2) * point();
    if (short_one) q[1] = q[0];
    const double least = least_distance(p, q), near = sampled_distance(points_of(p), points_of(q));
    EXPECT_LE(least, near + 1e-12) << n;
    EXPECT_GT(least, near - 0.06) << n << ": it is of use";
  }
}

TEST_F(EdgeFace, what_planes_say_is_apart_is) {
  int apart = 0, far = 0;
  for (int n = 0; n < 3000; ++n) {
    const Segment e{point(), point()};
    const TriangleCorners f{point(), point(), point()};
    const double near = sampled_distance(points_of(e), points_of(f)), reach = 0.1;
    const bool says = apart_by_planes(e, f, reach);
    EXPECT_TRUE(!says || near > reach) << n;
    apart += says;
    far += near > reach + 0.1;
  }
  EXPECT_GT(apart, far / 2) << "it is of use";
  EXPECT_FALSE(
      apart_by_planes({Vec3(0, 0, 1), Vec3(1, 0, 1)}, {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 0, 0)}, 0.1))
      << "a face without area has no plane";
}

TEST_F(EdgeFace, the_nearest_points_are_nearer_than_any_others) {
  for (int n = 0; n < 300; ++n) {
    const Segment e{point(), point()};
    const TriangleCorners f{point(), point(), point()};
    if (meet(e, f)) continue;
    const EdgeFaceNearest near = nearest(e, f);
    const Weights& w = near.weight;
    ASSERT_NEAR((point_at(e, near.share) - point_at(f, w)).norm(), near.distance, 1e-15);
    ASSERT_TRUE(near.share >= 0 && near.share <= 1 && *std::min_element(w.begin(), w.end()) >= -1e-15);
    ASSERT_NEAR(w[0] + w[1] + w[2], 1, 1e-14);
    double sampled = 10;
    constexpr int parts = 40;
    for (int i = 0; i <= parts; ++i)
      for (int j = 0; i + j <= parts; ++j)
        for (int k = 0; k <= parts; ++k) {
          const double a = static_cast<double>(i) / parts, b = static_cast<double>(j) / parts;
          const Vec3 y = a * f[0] + b * f[1] + (1 - a - b) * f[2];
          sampled = std::min(sampled, (point_at(e, static_cast<double>(k) / parts) - y).norm());
        }
    ASSERT_LE(near.distance, sampled + 1e-12) << n;
    ASSERT_GE(near.distance, sampled - 0.15) << n; // the samples are so far apart
  }
}

} // namespace
} // namespace rend::edge_face_test
