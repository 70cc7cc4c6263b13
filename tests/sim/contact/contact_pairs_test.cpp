// Pairs of the broad phase: none that may touch is missing, whatever moves how, and what is far from all is not
// searched.
#include "sim/contact/fragment_contact.h"

#include "sim/cubes.h"
#include "sim/presets.h"
#include "sim/random_meshes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <set>
#include <tuple>

namespace rend::contact_pairs_test {
namespace {

double distance_from_segment(const Vec3& x, const Vec3& a, const Vec3& b) {
  const double share = std::clamp((x - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (x - a - share * (b - a)).norm();
}

// By its plane if it projects into the triangle, by its edges otherwise.
double distance(const Vec3& x, const TriangleCorners& y) {
  const Vec3 normal = (y[1] - y[0]).cross(y[2] - y[0]).normalized();
  bool over = true;
  double nearest = 1e300;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &a = y[k], &b = y[(k + 1) % 3];
    over = over && normal.dot((b - a).cross(x - a)) > 0;
    nearest = std::min(nearest, distance_from_segment(x, a, b));
  }
  return over ? std::abs(normal.dot(x - y[0])) : nearest;
}

// Within the step, at five moments of it.
double nearest_within_step(const ContactPairs::Bodies& bodies, const ContactPair& pair) {
  double nearest = 1e300;
  for (int n = 0; n <= 4; ++n) {
    const auto at = [&](const ContactBody& body, Slot v) {
      return Vec3(body.from(v) + n / 4.0 * (body.position(v).vec() - body.from(v)));
    };
    const ContactBody& other = *bodies[pair.face_body];
    const auto& corner = other.faces->triangles()[pair.triangle].vertex;
    nearest = std::min(nearest, distance(at(*bodies[pair.body], pair.vertex),
                                         {at(other, corner[0]), at(other, corner[1]), at(other, corner[2])}));
  }
  return nearest;
}

struct Motion {
  Vec3 by = Vec3::Zero(); // [m] a step
  double turn = 0;        // [rad] a step, about a horizontal axis through the middle
  double noise_size = 0;  // [m], of each vertex by itself
};

void move(Body& body, const Motion& motion, meshes::Noise& noise) {
  std::vector<Record>& next = body.next.position;
  body.map->position().values() = next;
  Vec3 middle = Vec3::Zero();
  for (const Record& x : next) middle += x.vec() / static_cast<double>(next.size());
  const Eigen::Matrix3d turned = Eigen::AngleAxisd(motion.turn, Vec3(0.6, 0.8, 0)).toRotationMatrix();
  for (Record& x : next)
    x = Record(Vec3(middle + motion.by + turned * (x.vec() - middle) + motion.noise_size * noise.vector()));
}

struct Case {
  std::string shape, thick; // an attribute of the elasticity of sheets
  double thickness;         // [m]
  double turn, noise_size;
  double approach; // [m] a step
};

class FoundPairs : public testing::TestWithParam<Case> {};

// By brute force: what is close, and what FragmentContact answers.
TEST_P(FoundPairs, miss_nothing_that_is_close_and_nothing_that_touches) {
  const Case& with = GetParam();
  const std::string body = with.shape + R"(<mass total="1"/>
      <elasticity young="2e4" poisson="0.3")" +
                           with.thick + R"(/>
      <contact with="fragments" thickness=")" +
                           std::to_string(with.thickness) + R"("/>)";
  const auto scene = presets::load(
      "<scene><body name=\"a\">" + body + R"(<place translate="0 0 0.36"/></body><body name="b">)" + body +
      R"(</body><world gravity="0 0 0"/><time step="1e-4" duration="1"/></scene>)");
  scene->step();
  ContactPairs::Bodies bodies;
  for (std::size_t b = 0; b < 2; ++b) {
    scene.body(b).next.position = scene.body(b).map->position().values();
    bodies.push_back(std::make_unique<ContactBody>(scene.body(b), ContactIn::Step, b));
  }
  std::array<std::set<Slot>, 2> inner; // vertices of no face
  for (std::size_t b = 0; b < 2; ++b) {
    for (Slot v = 0; v < scene.body(b).vertices(); ++v) inner[b].insert(v);
    for (const auto& triangle : bodies[b]->faces->triangles())
      for (Slot v : triangle.vertex) inner[b].erase(v);
  }
  meshes::Noise noise(5);
  ContactPairs pairs;
  long passed_over = 0, touching = 0;
  const Vec3 together(0.01, 0, 0);
  Vec3 way = Vec3::Zero();
  for (int n = 0; n < 200 && !HasFailure(); ++n) {
    if (n % 25 == 0)
      way = 0.5 * with.approach * noise.vector() + Vec3(0, 0, n < 100 ? -with.approach : with.approach);
    move(scene.body(0), {together + way, with.turn, with.noise_size}, noise);
    move(scene.body(1), {together, 0, with.noise_size}, noise);
    std::set<std::tuple<std::uint32_t, Slot, std::uint32_t>> found; // body of the vertex, vertex, triangle
    for (const ContactPair& pair : pairs.find(bodies)) found.insert({pair.body, pair.vertex, pair.triangle});
    passed_over += static_cast<long>(pairs.pairs() - found.size());
    for (auto& each : bodies) each->changed = false;
    for (std::uint32_t b = 0; b < 2; ++b)
      for (Slot v = 0; v < scene.body(b).vertices(); ++v)
        for (std::uint32_t t = 0; t < bodies[1 - b]->faces->triangles().size() && !inner[b].contains(v); ++t) {
          const ContactPair pair{.body = b, .vertex = v, .face_body = 1 - b, .triangle = t};
          const bool touches = FragmentContact::touch(bodies, pair).has_value();
          touching += touches;
          EXPECT_TRUE(found.contains({b, v, t}) ||
                      (!touches && nearest_within_step(bodies, pair) > with.thickness))
              << "step " << n << ", vertex " << v << " of " << b << ", triangle " << t;
        }
  }
  EXPECT_GT(touching, 300);
  EXPECT_GT(passed_over, 300);
  EXPECT_LT(pairs.searches(), 190) << "in 200 steps";
}

INSTANTIATE_TEST_SUITE_P(Solids, FoundPairs,
                         testing::Values(Case{R"(<bar pattern="tetrahedra" cells="3 3 3" size="0.3 0.3 0.3"/>)",
                                              "", 0.01, 0, 2e-4, 8e-4},
                                         Case{R"(<bar pattern="tetrahedra" cells="3 3 3" size="0.3 0.3 0.3"/>)",
                                              "", 0.002, 0.02, 2e-3, 4e-3},
                                         Case{R"(<bar pattern="tetrahedra" cells="9 2 2" size="0.3 0.3 0.3"/>)",
                                              "", 0.001, 0.04, 1e-3, 4e-3}));
INSTANTIATE_TEST_SUITE_P(Sheets, FoundPairs,
                         testing::Values(Case{R"(<sheet pattern="crossed" cells="6 3" size="0.3 0.3"/>)",
                                              " thickness=\"0.01\"", 0.01, 0.01, 1e-3, 4e-3}));

using cubes::Cubes;

// Sorted, and all that touch of all vertices and all faces of other cubes. The number of those.
long expect_all(Cubes& all, ContactPairs& pairs, const std::string& when) {
  const std::vector<ContactPair>& found = pairs.find(all.bodies);
  const auto order = [](const ContactPair& p) { return std::tie(p.vertex, p.triangle); };
  EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [&](const auto& p, const auto& q) {
    return order(p) < order(q);
  })) << when;
  std::set<std::pair<Slot, std::uint32_t>> there;
  for (const ContactPair& pair : found) {
    EXPECT_FALSE(pair.neighbours) << when;
    EXPECT_TRUE(there.insert({pair.vertex, pair.triangle}).second) << when << ": twice";
  }
  const auto& triangles = all.bodies.front()->faces->triangles();
  long touching = 0;
  for (Slot v = 0; v < all.body.vertices(); ++v)
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (triangles[t].vertex[0] / 8 == v / 8) continue;
      if (!FragmentContact::touch(all.bodies, {.vertex = v, .triangle = t})) continue;
      ++touching;
      EXPECT_TRUE(there.contains({v, t})) << when << ", vertex " << v << ", triangle " << t;
    }
  return touching;
}

// They fly three edges apart, turning, come back until they overlap, and fly apart again, faster each time.
TEST(ContactPairs, of_fragments_that_fly_apart_turn_and_come_back_are_all_that_touch) {
  for (const double pace : {0.01, 0.04, 0.3}) {
    Cubes all({3, 2, 2});
    ContactPairs pairs;
    const Vec3 middle = (all.where(0) + all.where(all.number() - 1)) / 2, drift(0.02, -0.01, 0.005);
    long touching = 0, apart = 0;
    for (int n = 0; n < 160 && !HasFailure(); ++n) {
      const double size = 1.9 - 1.1 * std::cos(pace * n); // 0.8 to 3
      const auto place = [&](const Vec3& x) { return Vec3(middle + n * drift + size * (x - middle)); };
      all.step(place, (1 + 2 * pace) * 0.03);
      const long now = expect_all(all, pairs, "pace " + std::to_string(pace) + ", step " + std::to_string(n));
      touching += now;
      apart += now == 0;
    }
    EXPECT_GT(touching, 1000) << pace;
    EXPECT_GT(apart, 30) << pace;
  }
}

TEST(ContactPairs, of_what_has_flown_apart_are_not_searched) {
  Cubes all({6, 6, 6}, 4);
  ContactPairs pairs;
  for (int n = 0; n < 200; ++n) {
    all.step([&](const Vec3& x) { return Vec3((1 + 0.01 * n) * x); }, 0.05);
    EXPECT_TRUE(pairs.find(all.bodies).empty());
  }
  EXPECT_EQ(pairs.searches(), 0);
  EXPECT_EQ(pairs.pairs(), 0u);
  EXPECT_LT(pairs.sweeps(), 20) << "in 200 steps";
}

// The last cube leaves a heap that lies still, and flies on.
TEST(ContactPairs, of_a_heap_at_rest_are_not_searched_while_one_of_it_flies) {
  Cubes all({5, 5, 5}, 1.03);
  ContactPairs pairs;
  const auto go = [&](int n) {
    const Vec3 last = all.middle.back();
    all.step([&](const Vec3& x) { return x == last ? Vec3(x + n * Vec3(0.02, 0.03, 0.05)) : x; }, 0);
    EXPECT_FALSE(pairs.find(all.bodies).empty());
  };
  go(0);
  const long first = pairs.searches();
  EXPECT_GT(first, 500) << "each of the heap with its neighbours";
  for (int n = 1; n < 200; ++n) go(n);
  EXPECT_LE(pairs.searches() - first, 30);
  EXPECT_LT(pairs.sweeps(), 20) << "in 200 steps";
}

} // namespace
} // namespace rend::contact_pairs_test
