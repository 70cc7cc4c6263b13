// Pairs of the broad phase: none that may touch is missing or passed over, whatever moves how.
#include "sim/contact/contact_pairs.h"

#include "sim/presets.h"
#include "sim/random_meshes.h"

#include <gtest/gtest.h>

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

// Moves both: together, and each vertex by itself.
void drift(Body& body, const Vec3& by, double noise_size, meshes::Noise& noise) {
  body.map->position().values() = body.next.position;
  for (Slot v = 0; v < body.vertices(); ++v)
    body.next.position[v] = Record(Vec3(body.next.position[v].vec() + by + noise_size * noise.vector()));
}

TEST(ContactPairs, none_that_may_touch_is_missing_or_passed_over) {
  const std::string shape = R"(<bar pattern="tetrahedra" cells="3 3 3" size="0.3 0.3 0.3"/><mass total="1"/>
      <elasticity model="corotational" young="2e4" poisson="0.3"/>
      <contact with="fragments" thickness="0.01"/>)";
  const auto scene = presets::load(
      "<scene><body name=\"a\">" + shape + R"(<place translate="0 0 0.36"/></body><body name="b">)" + shape +
      R"(</body><world gravity="0 0 0"/><time step="1e-4" duration="1"/></scene>)");
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
  long passed_over = 0, near = 0;
  Vec3 way = Vec3::Zero();
  for (int n = 0; n < 400; ++n) {
    if (n % 50 == 0) way = 0.001 * noise.vector() - Vec3(0, 0, n < 200 ? 0.0008 : -0.0008);
    drift(scene.body(0), way + Vec3(0.01, 0, 0), 2e-4, noise);
    drift(scene.body(1), Vec3(0.01, 0, 0), 2e-4, noise);
    std::set<std::tuple<std::uint32_t, Slot, std::uint32_t>> looked_at; // body of the vertex, vertex, triangle
    for (const ContactPair& pair : pairs.find(bodies)) {
      passed_over += pairs.apart(bodies, pair);
      if (!pairs.apart(bodies, pair)) looked_at.insert({pair.body, pair.vertex, pair.triangle});
    }
    for (auto& body : bodies) body->changed = false;
    for (std::uint32_t b = 0; b < 2; ++b)
      for (Slot v = 0; v < scene.body(b).vertices(); ++v)
        for (std::uint32_t t = 0; t < bodies[1 - b]->faces->triangles().size(); ++t) {
          const ContactPair pair{.body = b, .vertex = v, .face_body = 1 - b, .triangle = t};
          if (inner[b].contains(v) || looked_at.contains({b, v, t})) continue;
          if (nearest_within_step(bodies, pair) > 0.01) continue;
          ADD_FAILURE() << "step " << n << ", vertex " << v << " of " << b << ", triangle " << t;
        }
    near += static_cast<long>(looked_at.size());
    if (HasFailure()) return;
  }
  EXPECT_GT(near, 1000);
  EXPECT_GT(passed_over, 1000);
  EXPECT_LT(pairs.searches(), 200);
}

} // namespace
} // namespace rend::contact_pairs_test
