#include "sim/guard/state_copy.h"

#include "sim/base/archive.h"

#include <utility>

namespace rend {

void BodyCopy::copy_measures(const Body& body) {
  time = body.time();
  if (body.work_meter) meter = *body.work_meter;
  reached.clear();
  for (const TearLaw& law : body.tear_laws) reached.push_back(law.reached());
}

void BodyCopy::restore_measures(Body& body) const {
  if (meter) *body.work_meter = *meter;
  for (std::size_t n = 0; n < reached.size(); ++n) body.tear_laws[n].restore_reached(reached[n]);
}

void BodyCopy::copy(const Body& body) {
  state.position = body.map->position().values();
  state.velocity = body.map->velocity().values();
  if (body.scheme_acceleration) state.acceleration = body.scheme_acceleration->values();
  state.staggered = body.staggered;
  last_step = body.last_step();
  copy_measures(body);
}

void BodyCopy::exchange(Body& body) {
  body.exchange_state(state, time, last_step);
  if (meter) std::swap(*meter, *body.work_meter);
  for (std::size_t n = 0; n < reached.size(); ++n) {
    const Reached other = std::exchange(reached[n], body.tear_laws[n].reached());
    body.tear_laws[n].restore_reached(other);
  }
}

void BodyCopy::store(Archive& archive, std::size_t most) {
  state.store(archive, most);
  archive(time);
  if (meter) meter->store(archive, most);
  for (Reached& each : reached) each.store(archive);
}

void SphereCopy::copy(const Sphere& sphere) {
  *this = {sphere.centre, sphere.velocity, sphere.contact_work, sphere.gravity_work};
}

void SphereCopy::restore(Sphere& sphere) const {
  sphere.centre = centre;
  sphere.velocity = velocity;
  sphere.contact_work = contact_work;
  sphere.gravity_work = gravity_work;
}

void SphereCopy::store(Archive& archive) {
  archive(centre, velocity, contact_work, gravity_work);
}

void StateCopy::copy(const World& world, const Bodies& all) {
  bodies.resize(all.size());
  for (std::size_t b = 0; b < all.size(); ++b) bodies[b].copy(*all[b]);
  spheres.resize(world.spheres.size());
  for (std::size_t s = 0; s < spheres.size(); ++s) spheres[s].copy(world.spheres[s]);
}

void StateCopy::exchange(World& world, const Bodies& all) {
  for (std::size_t b = 0; b < all.size(); ++b) bodies[b].exchange(*all[b]);
  for (std::size_t s = 0; s < spheres.size(); ++s) {
    SphereCopy other;
    other.copy(world.spheres[s]);
    std::swap(other, spheres[s]);
    other.restore(world.spheres[s]);
  }
}

std::size_t StateCopy::bytes() const {
  std::size_t sum = 0;
  for (const BodyCopy& body : bodies) sum += body.bytes();
  return sum;
}

} // namespace rend
