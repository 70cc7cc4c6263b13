// The size of the steps of a scene.
#include "sim/guard/guard.h"
#include "sim/rows/frequency.h"
#include "sim/rows/vertex_bounds.h"
#include "sim/scene/mass_scaling.h"
#include "sim/scene/scene.h"
#include "sim/scene/step_cause.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double margin = 0.9; // of what is stable

// Whose limit counts: of an adaptive scheme symplectic's.
const Scheme& limiting(const Scheme& scheme) {
  return scheme.adaptive ? *find_scheme("symplectic") : scheme;
}

std::vector<ElementSteps> element_steps(const std::vector<std::unique_ptr<Body>>& bodies) {
  std::vector<ElementSteps> steps;
  for (const auto& body : bodies)
    steps.emplace_back(*body).add_damping(body->loads.damping_rate(*body->map, body->program->inverse_mass()));
  return steps;
}

} // namespace

StepCause cause_of_step(const Scene& scene) {
  return cause_of_step(element_steps(scene.bodies()), limiting(scene.scheme()));
}

void Scene::scale_masses() {
  if (!time_.mass_scaling) return;
  if (scheme().solves)
    time_.source.fail(
        "mass-scaling",
        fmt::format("nothing limits the step of '{}', and no element need be heavier", scheme().name),
        "leave it out");
  if (!rend::scale_masses(bodies_, limiting(scheme()), *time_.mass_scaling, time_.step))
    notes_.emplace_back("mass scaling: no element is heavier, since the step would hardly be larger");
}

// An adaptive scheme divides the step of the preset: the default is that of symplectic, so that laws are
// applied as often.
void Scene::set_step() {
  step_ = automatic_step() ? stable_step() : *time_.step;
  const double duration = duration_;
  if (automatic_step() && duration > 0)
    step_ = duration / std::ceil(duration / step_); // the last step ends with the clip
  if (const double limit = stability_limit(); !automatic_step() && step_ > limit)
    notes_.push_back(fmt::format("the step of {:.3g} s may be too large: up to {:.3g} s '{}' is certainly "
                                 "stable here (step=\"auto\" takes 0.9 of that); {}",
                                 step_, limit, scheme().name, cause_of_step(*this).words));
  if (duration / step_ > 1e12) refuse_so_many_steps();
}

void Scene::refuse_so_many_steps() const {
  const std::string what = fmt::format("{:g} s in steps of {:g} s are more than 1e12 steps", duration_, step_);
  if (!automatic_step()) time_.source.fail("step", what);
  time_.source.fail(
      "step", what + "; " + cause_of_step(*this).words,
      "look whether the material is too stiff or light, or the mesh is bad there (rend mesh info)");
}

// The least number of parts of a step, none of which is longer than that [s].
int Scene::parts_within(double limit) const {
  return static_cast<int>(std::clamp(std::ceil(step_ / limit), 1.0, double{Guard::most_substeps}));
}

// Where something touches, steps are those of velocity Verlet (ContactIn).
bool Scene::touches_by_verlet() const {
  return (scheme().contact == ContactIn::StepInstead || scheme().adaptive) && contacts_ &&
         !contacts_->bodies().empty();
}

void Scene::divide_for_contact() {
  if (touches_by_verlet()) guard_->divide_steps(parts_within(stability_limit(*find_scheme("verlet"))));
}

double Scene::stability_limit() const {
  return stability_limit(scheme());
}

double Scene::stability_limit(const Scheme& scheme) const {
  return limit_by(scheme, [&](std::size_t n) {
    const Body& body = *bodies_[n];
    return frequency_bounds(*body.map, body.interactions, *body.mass, body.drag);
  });
}

// A step that was given is divided only where something touches; an adaptive scheme divides its own.
bool Scene::divides_for_bounds() const {
  return touches_by_verlet() || (automatic_step() && !scheme().solves && !scheme().adaptive);
}

FrequencyBounds Scene::bounds_until_torn(std::size_t n) {
  const Body& body = *bodies_[n];
  if (!body.map->grows()) return frequency_bounds(*body.map, body.interactions, *body.mass, body.drag);
  bounds_.resize(bodies_.size());
  if (!bounds_[n])
    bounds_[n] = std::make_unique<VertexBounds>(*body.map, body.interactions, *body.mass, body.drag);
  return bounds_[n]->bounds();
}

// With a margin, as that of an automatic step.
double Scene::limit_until_torn() {
  std::vector<FrequencyBounds> found;
  for (std::size_t n = 0; n < bodies_.size(); ++n) found.push_back(bounds_until_torn(n));
  const auto bounds = [&](std::size_t n) { return found[n]; };
  double limit = std::numeric_limits<double>::infinity();
  if (automatic_step() && !scheme().adaptive) limit = limit_by(scheme(), bounds);
  if (touches_by_verlet()) limit = std::min(limit, limit_by(*find_scheme("verlet"), bounds));
  return margin * limit;
}

double Scene::limit_by(const Scheme& scheme,
                       const std::function<FrequencyBounds(std::size_t body)>& bounds_of) const {
  double limit = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < bodies_.size(); ++n) {
    const Body& body = *bodies_[n];
    const FrequencyBounds b = bounds_of(n);
    const double wind = body.loads.damping_rate(*body.map, body.program->inverse_mass());
    limit = std::min(limit, scheme.limit({b.omega_squared, b.damping_rate + wind + body.uniform_drag,
                                          b.least_drag_rate + body.uniform_drag}));
  }
  return limit;
}

double Scene::stable_step() {
  if (scheme().name == "static") return duration_ > 0 ? duration_ : 1; // one step, one equilibrium
  const Scheme& own = limiting(scheme());
  const std::vector<ElementSteps> steps = element_steps(bodies_);
  double limit = std::numeric_limits<double>::infinity();
  for (const ElementSteps& each : steps) limit = std::min(limit, each.least(own));
  if (limit <= 0)
    time_.source.fail(
        "step",
        fmt::format("no step is stable with the integrator '{}' here, because some motions are not damped",
                    scheme().name),
        "use symplectic, verlet or rk4, or add <viscosity>");
  if (std::isinf(limit) && duration_ == 0) return 1; // a scene that is only built makes no step
  if (std::isinf(limit))
    time_.source.fail(
        "step",
        scheme().solves
            ? fmt::format("step=\"auto\" is not possible with '{}', which is stable with every step",
                          scheme().name)
            : "step=\"auto\" is not possible: nothing in the scene limits the step",
        scheme().solves ? "give a step in seconds, such as step=\"0.01\"" : "give a step in seconds");
  constexpr double told = 10; // the gain from which a cause is told; rend info tells any
  if (const StepCause cause = unusual_cause_of_step(steps, own); cause.gain >= told)
    notes_.push_back(fmt::format("step=\"auto\" is {:.3g} s: {}", margin * limit, cause.words));
  return margin * limit;
}

} // namespace rend
