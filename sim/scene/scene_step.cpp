// The steps of a scene, and the handling of failed ones.
#include "sim/base/stop_request.h"
#include "sim/guard/guard.h"
#include "sim/integrate/state_keeper.h"
#include "sim/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rend {
namespace {

bool equal_bytes(const std::vector<Record>& a, const std::vector<Record>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Record)) == 0;
}

// The sum of squared speeds [m²/s²] up to which a kinetic energy is a number: of 1e30 kg in each cubic metre of
// a body of 1e30 m.
constexpr double most_motion = 1e180;

// Steps by which the account of energy is sampled earlier than it would be: of a scheme that drag alone keeps
// stable, which gains energy by itself wherever there is too little of it, and may lose it again.
long earlier_samples(const Scheme& scheme) {
  constexpr long often = 128; // steps; more than a stretch has
  const bool gains = scheme.limit({.omega_squared = 1}) <= 0;
  return gains ? EnergyAccount::period - often : 0;
}

struct UnsoundState { // thrown if the state about to be torn is not sound
  StepFailure failure;
};

struct StatesToShow {}; // thrown before a change of topology: those that are kept are of the one before

} // namespace

void Scene::step() {
  throw_if_stop_is_due();
  const long entry = steps_done_;
  if (account_.due(entry + earlier_samples(scheme())) && scheme().has_account())
    account_.add(entry, energy_state());
  if (scheme().solves || scheme().adaptive) keep_solver_states();
  try {
    reach(entry + 1);
  } catch (const StopRequested&) {
    return_to_start_of(entry);
    throw;
  }
}

void Scene::reach(long goal) {
  while (steps_done_ < goal) {
    try {
      const StepFailure failure = try_step();
      if (failure != StepFailure::None)
        redo(failure, goal - 1);
      else if (time() >= next_answer_)
        measure_answers();
    } catch (const StatesToShow&) { // the same step is tried again
    }
    if (is_settled()) show_settled();
  }
}

StepFailure Scene::try_step() {
  if (fault_ && fault_->step <= steps_done_) arm_fault();
  struct Timed {
    Profile& profile;
    ~Timed() { profile.end_step(); }
  };
  profile_->begin_step(steps_done_);
  const Timed timed{*profile_};
  return nominal_step();
}

void Scene::keep_solver_states() {
  solver_states_.resize(bodies_.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b)
    if (const auto* keeper = dynamic_cast<const StateKeeper*>(bodies_[b]->integrator.get()))
      keeper->keep_state(solver_states_[b]);
}

// After a stop within the step from `step` on. A scheme that solves begins a stretch at every step, after its
// laws; others repeat the steps since the start of theirs.
void Scene::return_to_start_of(long step) {
  const bool within_laws = laws_applied_at_ < steps_done_;
  if (within_laws || !guard_->on()) {
    can_be_stored_ = false;
    return;
  }
  returning_ = true;
  return_to(guard_->restore_start());
  while (steps_done_ < step && try_step() == StepFailure::None) continue;
  returning_ = false;
  can_be_stored_ = steps_done_ == step;
  for (std::size_t b = 0; b < solver_states_.size(); ++b)
    bodies_[b]->integrator->restore_state(solver_states_[b]);
}

// With the number of substeps that the guard asks for, once laws have changed what there is. On failure,
// steps_done() counts the steps completed.
StepFailure Scene::nominal_step() {
  if (!returning_ && guard_->redoing()) throw_if_stop_is_due();
  evaluate_forces();
  if (const StepFailure failure = apply_laws(); failure != StepFailure::None) return failure;
  const int substeps = guard_->substeps(steps_done_);
  const double step = step_ / substeps;
  for (int n = 0; n < substeps; ++n) {
    if (n > 0) {
      if (!returning_) throw_if_stop_is_due();
      evaluate_forces();
    }
    if (const StepFailure failure = substep(time() + n * step, step); failure != StepFailure::None)
      return failure;
  }
  ++steps_done_;
  not_converged_.reset();
  const StepFailure failure = guard_->after_step(steps_done_);
  if (failure == StepFailure::None && !kept_.empty()) keep_again();
  return failure;
}

// From the forces of the current state.
StepFailure Scene::substep(double time, double step) {
  StepFailure failure = integrate(time, step);
  if (failure == StepFailure::None) failure = resolve_contacts(time, step);
  if (failure != StepFailure::None) return failure;
  commit(step);
  guard_->after_substep();
  return StepFailure::None;
}

// Of the current state; if nobody needs them beforehand, the integrator evaluates them. A timed step separates
// forces from integration.
void Scene::evaluate_forces() {
  const bool wanted = profile_->timed() || guard_->needs_forces();
  for (auto& body : bodies_) {
    if (wanted || !body->may_defer_forces())
      body->evaluate();
    else
      body->defer_forces();
  }
}

// Laws are applied once per step, however often it is redone. (The guard never rolls back beyond a step that
// tore.)
StepFailure Scene::apply_laws() {
  if (steps_done_ == laws_applied_at_) return StepFailure::None;
  const PhaseScope within(profile_.get(), Phase::Criteria);
  guard_->before_laws(steps_done_);
  const auto sound = [&] {
    if (const StepFailure failure = guard_->before_change(steps_done_); failure != StepFailure::None)
      throw UnsoundState{failure};
    if (has_states_to_show()) throw StatesToShow();
  };
  bool bounds_changed = false;
  try {
    for (auto& body : bodies_)
      if (body->tear(time(), steps_done_, sound) > 0 && body->map->grows()) bounds_changed = true;
  } catch (const UnsoundState& unsound) {
    return unsound.failure;
  } catch (const UserError& error) { // of a change that a law cannot make
    throw Unstable(Exit::Unstable, {}, error.what(), error.hint);
  }
  // A step that was chosen for the elements at the start may be too large for those that laws have made; and
  // the bound of what there is then holds until something is separated.
  if (bounds_changed && divides_for_bounds()) guard_->divide_steps(parts_within(limit_until_torn()));
  laws_applied_at_ = steps_done_;
  guard_->after_laws(steps_done_);
  return StepFailure::None;
}

StepFailure Scene::integrate(double time, double step) {
  for (auto& body : bodies_) {
    try {
      body->advance(time, step);
    } catch (const NotConverged& error) {
      if (!guard_->redoing() && (scheme().solves || !guard_->on())) stop(*body, error.what(), error.hint);
      not_converged_ = error; // an implicit scheme has already tried substeps
      return StepFailure::NotFinite;
    }
  }
  return StepFailure::None;
}

// All bodies are checked before one of them is committed.
StepFailure Scene::resolve_contacts(double time, double step) {
  apply_contacts(time, step);
  if (!finite()) return StepFailure::NotFinite;
  if (const auto through = contacts_ ? contacts_->crossing() : std::nullopt) stop_crossing(*through);
  return StepFailure::None;
}

void Scene::apply_contacts(double time, double step) {
  const PhaseScope within(contacts_ ? profile_.get() : nullptr, Phase::Contact);
  if (contacts_) contacts_->advance(time, step);
  for (auto& body : bodies_) {
    if (body->faulty.armed(StepStage::Contact)) body->inject_into_next();
    if (body->contact && body->contact->faces()) body->next.probe_all(); // its values after contact
  }
}

void Scene::commit(double step) {
  const double time = bodies_.front()->time();
  for (Sphere& sphere : world_.spheres) sphere.commit(world_.gravity_at(time), world_.gravity_at(time + step));
  for (auto& body : bodies_) body->commit();
}

// Arms or disarms the fault for the current step.
void Scene::arm_fault() {
  const auto has = [&](const std::unique_ptr<Body>& body) {
    return body->map->map().dart_count() > 0 && (fault_->stage != StepStage::Loads || !body->loads.empty());
  };
  const auto body = std::find_if(bodies_.begin(), bodies_.end(), has);
  const bool now = fault_->step == steps_done_;
  if (now && body != bodies_.end()) (*body)->faulty.arm(*fault_);
  if (!now)
    for (auto& each : bodies_) each->faulty.disarm();
  if (!now || !fault_->lasting) fault_.reset();
}

bool Scene::finite() const {
  const auto& spheres = world_.spheres;
  return std::all_of(bodies_.begin(), bodies_.end(),
                     [](const auto& body) { return body->next.motion() <= most_motion; }) &&
         std::all_of(spheres.begin(), spheres.end(), [](const Sphere& s) {
           return s.next_centre.allFinite() && s.next_velocity.squaredNorm() <= most_motion;
         });
}

// Whether the current state is not the result of the steps since the start of the stretch, because it was set
// in between: then it is kept, and the saved start is discarded.
bool Scene::state_was_set() {
  const long done = steps_done_;
  const double time = bodies_.front()->time();
  current_.resize(bodies_.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    current_[b].position = bodies_[b]->map->position().values();
    current_[b].velocity = bodies_[b]->map->velocity().values();
    current_[b].staggered = bodies_[b]->staggered;
  }
  const std::vector<Sphere> spheres = world_.spheres;
  return_to(guard_->restore_start());
  while (steps_done_ < done && try_step() == StepFailure::None) continue;
  bool same = steps_done_ == done;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const EmbeddedMap& map = *bodies_[b]->map;
    same = same && equal_bytes(map.position().values(), current_[b].position) &&
           equal_bytes(map.velocity().values(), current_[b].velocity);
  }
  if (same) return false;
  for (std::size_t b = 0; b < bodies_.size(); ++b) bodies_[b]->restore_state(current_[b], time);
  world_.spheres = spheres;
  return_to(done);
  keep_again();
  laws_applied_at_ = done - 1; // nothing tore in between
  guard_->discard_start();
  account_.restart();
  return true;
}

void Scene::redo(StepFailure failure, long entry) {
  const bool may_be_set = finds_set_states_ && !guard_->redoing() && guard_->on();
  if (may_be_set && guard_->has_advanced(steps_done_) && state_was_set()) return;
  if (const auto step = guard_->roll_back(failure, steps_done_))
    return_to(*step);
  else
    fail_step(failure, entry);
}

void Scene::return_to(long step) {
  steps_done_ = laws_applied_at_ = step;
  account_.roll_back(step);
  for (auto& body : bodies_) body->faulty.disarm();
  forget_answers();
}

// Restores the state before the step: from the start of the stretch, repeating its steps.
void Scene::fail_step(StepFailure failure, long entry) {
  const Body* body = bodies_.front().get();
  std::string what;
  double most = -1;
  for (const auto& each : bodies_) {
    const auto pair = fastest_neighbours(*each, each->map->velocity().values().data());
    if (!pair || pair->rate <= most) continue;
    most = pair->rate;
    body = each.get();
    const Vec3 at = body->map->position()[pair->a];
    what = fmt::format(
        "; fastest-separating pair: vertices {} and {}, joined by {}, near ({:.4g}, {:.4g}, {:.4g}) m", pair->a,
        pair->b, pair->joined, at.x(), at.y(), at.z());
  }
  if (guard_->on()) {
    return_to(guard_->restore_start());
    while (steps_done_ < entry && try_step() == StepFailure::None) continue;
  }
  const std::string parts =
      guard_->on() ? fmt::format(", even with the step divided by {}", Guard::most_substeps) : "";
  if (failure == StepFailure::NotFinite && not_converged_)
    stop(*body, not_converged_->what() + parts, not_converged_->hint);
  if (failure == StepFailure::NotFinite) what = find_non_finite(body) + parts;
  if (failure == StepFailure::Energy)
    what = "its energy grows by more than gravity, loads, drives and contact supply" + parts + what;
  if (failure == StepFailure::PassThrough)
    what = "neighbouring vertices pass each other within one step" + parts + what;
  stop(*body, what);
}

// Found by making the step once more, stage by stage.
std::string Scene::find_non_finite(const Body*& whose) {
  std::string found;
  const auto look = [&](const Body& body, StepStage stage, const Record* x, const Record* y) {
    for (std::size_t i = 0; i < body.vertices() && found.empty(); ++i) {
      if (body.program->inverse_mass()[i] == 0 || (x[i].vec().allFinite() && y[i].vec().allFinite())) continue;
      const Vec3 at = body.map->position()[static_cast<Slot>(i)];
      whose = &body;
      found =
          fmt::format("after {}, vertex {}, near ({:.4g}, {:.4g}, {:.4g}) m, has a number that is not finite",
                      name_of(stage), i, at.x(), at.y(), at.z());
    }
  };
  if (fault_ && fault_->step == steps_done_) arm_fault();
  for (auto& body : bodies_) {
    body->evaluate();
    look(*body, StepStage::Forces, body->force.data(), body->force.data());
    if (body->load) look(*body, StepStage::Loads, body->load, body->load);
  }
  const auto look_at_next = [&](StepStage stage) {
    for (auto& body : bodies_) look(*body, stage, body->next.position.data(), body->next.velocity.data());
  };
  if (found.empty() && integrate(time(), step_) == StepFailure::None) look_at_next(StepStage::Integration);
  if (found.empty()) apply_contacts(time(), step_);
  if (found.empty()) look_at_next(StepStage::Contact);
  return found.empty() ? "a number of its state is not finite, or a speed exceeds 1e90 m/s" : found;
}

void Scene::check_sound() const {
  if (guard_->on() || steps_done_ == 0 || scheme().solves || scheme().adaptive) return;
  for (const auto& body : bodies_) {
    const auto pair = fastest_neighbours(*body, body->map->velocity().values().data());
    if (pair && pair->rate * step_ > most_rest_lengths)
      stop(*body, "neighbouring vertices joined by " + pair->joined + " pass each other within one step");
  }
}

void Scene::check_account() const {
  // what contact pushes out after a solve has no cause, and goes with the next one
  if (!account_.open() || (scheme().solves && contacts_)) return;
  const EnergyFigures e = energy();
  if (e.gained_share() <= most_gained_share) return;
  throw Unstable(
      Exit::Unstable, step_place_,
      fmt::format("the motion is not to be trusted: {:.3g} J of energy appeared that no load, drive, "
                  "contact or weight gave, where there were {:.3g} J at most",
                  e.gained, e.scale),
      scheme().limit == &no_limit ? "take a smaller step"
                                  : "take a smaller step, another integrator, or add viscosity");
}

// The state in which they cross is not committed.
void Scene::stop_crossing(const ThroughEachOther& through) const {
  std::string with = "itself";
  if (through.obstacle)
    with = world_.called(*through.obstacle);
  else if (through.other != through.body)
    with = fmt::format("body '{}'", through.other->name);
  throw Unstable(Exit::Unstable, step_place_,
                 fmt::format("the simulation was stopped at {:.6g} s (step {} of {:.3g} s): body '{}' would go "
                             "through {}, and both are held, driven or moved as prescribed",
                             time(), steps_done_, step_, through.body->name, with),
                 "keep them apart, or do not ask for contact between them");
}

void Scene::stop(const Body& body, const std::string& what) const {
  const double limit = stability_limit(), tried = guard_->on() ? step_ / Guard::most_substeps : step_;
  std::string hint;
  if (limit <= 0)
    hint = fmt::format("no step is stable with '{}' here; use symplectic, verlet or rk4", scheme().name);
  else if (guard_->on() && tried < limit)
    hint = fmt::format("a smaller step does not help: steps of {:.3g} s failed as well; look near that place "
                       "for elements that are very stiff, light or flat",
                       tried);
  else if (!std::isinf(limit))
    hint = fmt::format("at rest, steps up to {:.3g} s are stable with '{}' (step=\"auto\" takes 0.9 of it)",
                       limit, scheme().name);
  stop(body, what, hint);
}

void Scene::stop(const Body& body, const std::string& what, const std::string& hint) const {
  throw Unstable(
      Exit::Unstable, step_place_,
      fmt::format("the simulation was stopped as unstable at {:.6g} s (step {} of {:.3g} s) in body '{}': {}",
                  time(), steps_done_, step_, body.name, what),
      hint);
}

} // namespace rend
