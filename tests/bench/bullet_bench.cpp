// The cloth of figure/springs_64 as a soft body of Bullet: the same particles, masses and springs as its links,
// in float, one iteration of its solver, no collisions.
#include "bench/per_element.h"
#include "bench/plain_cloth.h"
#include "sim/presets.h"
#include "sim/random_meshes.h"

#include <BulletSoftBody/btSoftBody.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>

namespace rend {
namespace {

struct BulletWorld {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
};

btVector3 vector(const PlainCloth::P& p) {
  return {static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
}

void bullet_steps(benchmark::State& state) {
  presets::Loaded scene = presets::load(presets::cloth("quads", 64));
  meshes::Noise noise(1);
  const PlainCloth cloth(scene.body());
  std::vector<btVector3> x;
  for (const auto& p : cloth.x) x.push_back(vector(p));
  std::vector<float> mass;
  for (double inverse : cloth.inverse_mass) mass.push_back(static_cast<float>(1 / inverse));
  BulletWorld bullet;
  auto* const body =
      new btSoftBody(&bullet.world.getWorldInfo(), static_cast<int>(x.size()), x.data(), mass.data());
  for (std::size_t n = 0; n < cloth.k.size(); ++n) body->appendLink(cloth.i[n], cloth.j[n]);
  for (int n : cloth.fixed) body->setMass(n, 0);
  body->m_cfg.piterations = 1;
  body->m_cfg.collisions = 0;
  body->m_cfg.kDP = 0.01F;
  for (int n = 0; n < body->m_nodes.size(); ++n) {
    const Vec3 off = 0.02 / 64 * noise.vector();
    body->m_nodes[n].m_x += vector({off.x(), off.y(), off.z()});
  }
  bullet.world.addSoftBody(body);
  for (auto _ : state) bullet.world.stepSimulation(1e-6F, 0);
  count_elements(state, static_cast<double>(cloth.k.size()));
  bullet.world.removeSoftBody(body);
  delete body;
}
BENCHMARK(bullet_steps)->Name("figure/springs_64_bullet");

} // namespace
} // namespace rend
