#include "sim/check/linearised.h"

#include <algorithm>

namespace rend {

Linearised::Linearised(const Body& body, double time) {
  inverse_mass = body.program->inverse_mass();
  drag_rate = body.program->drag_rate();
  uniform_drag = body.uniform_drag;
  const Assembly assembly(*body.map, *body.program);
  const Record* x = body.map->position().values().data();
  const Records still(body.program->vertices());
  stiffness_.reset(assembly.pattern());
  assembly.add(x, still.data(), Tangent::SemiDefinite, 1, 0, stiffness_);
  const bool damped = std::any_of(body.interactions.begin(), body.interactions.end(),
                                  [](const auto& interaction) { return interaction->damped; });
  if (damped) {
    damping_.reset(assembly.pattern());
    assembly.add(x, still.data(), Tangent::SemiDefinite, 0, 1, damping_);
  }
  held_.assign(still.size(), 0);
  body.constraints.mark(time, held_.data());
  product_.resize(still.size());
}

HighestMode Linearised::highest() const {
  return highest_mode(stiffness_, inverse_mass, held_);
}

double Linearised::damping_rate(const Records& shape) const {
  double rate = uniform_drag;
  if (damping_.rows() > 0) {
    damping_.multiply(shape.data(), product_.data());
    rate += dot(1, shape, product_);
  }
  if (!drag_rate) return rate;
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (inverse_mass[i] > 0) rate += drag_rate[i] / inverse_mass[i] * shape[i].vec().squaredNorm();
  return rate;
}

void Linearised::forces(double, const Record* position, const Record* velocity, Record* force) {
  stiffness_.multiply(position, force);
  if (damping_.rows() > 0) damping_.multiply(velocity, product_.data());
  const bool damped = damping_.rows() > 0;
  for (std::size_t i = 0; i < held_.size(); ++i) {
    Double4 sum = rend::load(force[i]);
    if (damped) sum += rend::load(product_[i]);
    store(force[i], Double4{} - free_axes(held_[i]) * sum);
  }
}

void Linearised::constrain(double, Record* position, Record* velocity) {
  for (std::size_t i = 0; i < held_.size(); ++i) {
    store(position[i], free_axes(held_[i]) * rend::load(position[i]));
    store(velocity[i], free_axes(held_[i]) * rend::load(velocity[i]));
  }
}

} // namespace rend
