// The steps of a scene, and the handling of failed ones.
#include "sim/guard/guard.h"
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

struct Distrust { // thrown if the state about to be torn is not sound
  Trouble trouble;
};

} // namespace

void Scene::step() {
  const long entry = steps_done_;
  while (steps_done_ <= entry) {
    const Trouble trouble = try_step();
    if (trouble != Trouble::None)
      redo(trouble, entry);
    else if (time() >= next_answer_)
      measure_answers();
  }
}

Trouble Scene::try_step() {
  if (fault_ && fault_->step <= steps_done_) arm_fault();
  profile_->begin_step(steps_done_);
  const Trouble trouble = nominal_step();
  profile_->end_step();
  return trouble;
}

// With the number of substeps that the guard asks for. On failure, steps_done() counts the steps completed.
Trouble Scene::nominal_step() {
  const int substeps = guard_->parts(steps_done_);
  const double step = step_ / substeps;
  for (int n = 0; n < substeps; ++n)
    if (const Trouble trouble = substep(time() + n * step, step); trouble != Trouble::None) return trouble;
  ++steps_done_;
  unsolved_.reset();
  return guard_->after_step(steps_done_);
}

Trouble Scene::substep(double time, double step) {
  evaluate_forces();
  Trouble trouble = apply_laws();
  if (trouble == Trouble::None) trouble = integrate(time, step);
  if (trouble == Trouble::None) trouble = resolve_contacts(time, step);
  if (trouble != Trouble::None) return trouble;
  commit();
  guard_->after_part();
  return Trouble::None;
}

// Of the current state; if nobody needs them beforehand, the integrator evaluates them. A timed step separates
// forces from integration.
void Scene::evaluate_forces() {
  const bool wanted = profile_->timed() || guard_->asks_for_forces();
  for (auto& body : bodies_) {
    if (wanted || !body->may_defer_forces())
      body->evaluate();
    else
      body->defer_forces();
  }
}

// Laws are applied once per step, however often it is redone. (The guard never rolls back beyond a step that
// tore.)
Trouble Scene::apply_laws() {
  if (steps_done_ == looked_) return Trouble::None;
  const Within within(profile_.get(), Phase::Criteria);
  guard_->before_laws(steps_done_);
  const auto sound = [&] {
    if (const Trouble trouble = guard_->before_change(steps_done_); trouble != Trouble::None)
      throw Distrust{trouble};
  };
  try {
    for (auto& body : bodies_) body->tear(time(), steps_done_, sound);
  } catch (const Distrust& distrust) {
    return distrust.trouble;
  }
  looked_ = steps_done_;
  guard_->after_laws(steps_done_);
  return Trouble::None;
}

Trouble Scene::integrate(double time, double step) {
  for (auto& body : bodies_) {
    try {
      body->advance(time, step);
    } catch (const Unsolved& error) {
      if (!guard_->redoing() && (scheme().solves || !guard_->on())) stop(*body, error.what(), error.hint);
      unsolved_ = error; // an implicit scheme has already tried substeps
      return Trouble::NotFinite;
    }
  }
  return Trouble::None;
}

// All bodies are checked before one of them is committed.
Trouble Scene::resolve_contacts(double time, double step) {
  act_by_contacts(time, step);
  return finite() ? Trouble::None : Trouble::NotFinite;
}

void Scene::act_by_contacts(double time, double step) {
  const Within within(contacts_ ? profile_.get() : nullptr, Phase::Contact);
  if (contacts_) contacts_->advance(time, step);
  for (auto& body : bodies_) {
    if (body->faulty.armed(StepStage::Contact)) body->spoil_next();
    if (body->contact && body->contact->faces()) body->next.look(); // its values after contact
  }
}

void Scene::commit() {
  for (auto& body : bodies_) body->commit();
  for (Sphere& sphere : world_.spheres) sphere.commit();
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
  return std::all_of(bodies_.begin(), bodies_.end(), [](const auto& body) { return body->next.finite(); }) &&
         std::all_of(spheres.begin(), spheres.end(),
                     [](const Sphere& s) { return s.next_centre.allFinite() && s.next_velocity.allFinite(); });
}

// Whether the current state is not the result of the steps since the start of the stretch, because it was set
// in between: then it is kept, and the saved start is discarded.
bool Scene::was_set() {
  const long done = steps_done_;
  const double time = bodies_.front()->time();
  there_.resize(bodies_.size());
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    there_[b].position = bodies_[b]->map->position().values();
    there_[b].velocity = bodies_[b]->map->velocity().values();
  }
  const std::vector<Sphere> spheres = world_.spheres;
  go_back(guard_->go_back());
  while (steps_done_ < done && try_step() == Trouble::None) continue;
  bool same = steps_done_ == done;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const EmbeddedMap& map = *bodies_[b]->map;
    same = same && equal_bytes(map.position().values(), there_[b].position) &&
           equal_bytes(map.velocity().values(), there_[b].velocity);
  }
  if (same) return false;
  for (std::size_t b = 0; b < bodies_.size(); ++b) bodies_[b]->go_back(there_[b], time);
  world_.spheres = spheres;
  go_back(done);
  looked_ = done - 1; // nothing tore in between
  guard_->forget();
  return true;
}

void Scene::redo(Trouble trouble, long entry) {
  if (!guard_->redoing() && guard_->on() && guard_->has_gone(steps_done_) && was_set()) return;
  if (const auto step = guard_->again(trouble, steps_done_))
    go_back(*step);
  else
    give_up(trouble, entry);
}

void Scene::go_back(long step) {
  steps_done_ = looked_ = step;
  for (auto& body : bodies_) body->faulty.disarm();
  forget_answers();
}

// Restores the state before the step: from the start of the stretch, repeating its steps.
void Scene::give_up(Trouble trouble, long entry) {
  const Body* body = bodies_.front().get();
  std::string what;
  double most = -1;
  for (const auto& each : bodies_) {
    const auto pair = fastest_neighbours(*each, each->map->velocity().values().data());
    if (!pair || pair->rate <= most) continue;
    most = pair->rate;
    body = each.get();
    const Vec3 at = body->map->position()[pair->a];
    what = fmt::format("; vertices {} and {}, joined by {}, near ({:.4g}, {:.4g}, {:.4g}) m, part fastest",
                       pair->a, pair->b, pair->joined, at.x(), at.y(), at.z());
  }
  if (guard_->on()) {
    go_back(guard_->go_back());
    while (steps_done_ < entry && try_step() == Trouble::None) continue;
  }
  const std::string parts = guard_->on() ? ", in 1024 parts of the step as well" : "";
  if (trouble == Trouble::NotFinite && unsolved_) stop(*body, unsolved_->what() + parts, unsolved_->hint);
  if (trouble == Trouble::NotFinite) what = whose_number(body) + parts;
  if (trouble == Trouble::Energy)
    what = "its energy grows beyond what gravity, loads and drives give it" + parts + what;
  if (trouble == Trouble::Passing) what = "neighbours pass each other within a step" + parts + what;
  stop(*body, what);
}

// Found by making the step once more, stage by stage.
std::string Scene::whose_number(const Body*& whose) {
  std::string found;
  const auto look = [&](const Body& body, StepStage stage, const Record* x, const Record* y) {
    for (std::size_t i = 0; i < body.vertices() && found.empty(); ++i) {
      if (body.program->inverse_mass()[i] == 0 || (x[i].vec().allFinite() && y[i].vec().allFinite())) continue;
      const Vec3 at = body.map->position()[static_cast<Slot>(i)];
      whose = &body;
      found = fmt::format("after {}, a number of vertex {}, at ({:.4g}, {:.4g}, {:.4g}) m, is not finite",
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
  if (found.empty() && integrate(time(), step_) == Trouble::None) look_at_next(StepStage::Integration);
  if (found.empty()) act_by_contacts(time(), step_);
  if (found.empty()) look_at_next(StepStage::Contact);
  return found.empty() ? "a number of its state is not finite" : found;
}

void Scene::check_sound() const {
  if (guard_->on() || steps_done_ == 0 || scheme().solves || scheme().adaptive) return;
  for (const auto& body : bodies_) {
    const auto pair = fastest_neighbours(*body, body->map->velocity().values().data());
    if (pair && pair->rate * step_ > most_rest_lengths)
      stop(*body, "neighbours joined by " + pair->joined + " pass each other within a step");
  }
}

void Scene::stop(const Body& body, const std::string& what) const {
  const double limit = stability_limit(), tried = guard_->on() ? step_ / 1024 : step_;
  std::string hint;
  if (limit <= 0)
    hint = fmt::format("no step is stable with '{}' here; use symplectic, verlet or rk4", scheme().name);
  else if (guard_->on() && tried < limit)
    hint = fmt::format("no smaller step would have held: parts of {:.3g} s did not", tried);
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
