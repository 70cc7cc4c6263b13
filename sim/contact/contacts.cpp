#include "sim/contact/contacts.h"

#include "sim/base/archive.h"
#include "sim/contact/contact_names.h"

#include <algorithm>

namespace rend {

std::unique_ptr<Contacts> Contacts::of(World& world, const std::vector<std::unique_ptr<Body>>& bodies,
                                       const Scheme& scheme) {
  resolve_contact_names(world, bodies);
  if (scheme.solves) {
    refuse_restitution(world, bodies, scheme.name);
    refuse_mesh_obstacles(world, bodies, scheme.name);
  }
  std::unique_ptr<Contacts> contacts(new Contacts(world, scheme));
  for (std::size_t b = 0; b < bodies.size(); ++b)
    if (bodies[b]->contact && (bodies[b]->floor_contact || bodies[b]->contact->faces()))
      contacts->bodies_.push_back(std::make_unique<ContactBody>(*bodies[b], scheme.contact, b));
  contacts->moving_ = contacts->bodies_.size();
  contacts->add_meshes(world, bodies.size());
  for (const auto& body : contacts->moving())
    if (body->meets_faces() && !contacts->fragments_)
      contacts->fragments_ = std::make_unique<FragmentContact>(!scheme.solves);
  if (contacts->fragments_ && !scheme.solves) contacts->torn_ = std::make_unique<TornSides>();
  if (contacts->with_faces() && !scheme.solves) contacts->guard_ = std::make_unique<CrossingGuard>();
  const auto edges_with = [&](EdgeContact::With with) {
    return EdgeContact::is_asked_for(contacts->bodies_, with) ? std::make_unique<EdgeContact>(with) : nullptr;
  };
  contacts->edges_ = edges_with(EdgeContact::With::Bodies);
  contacts->obstacle_edges_ = edges_with(EdgeContact::With::Obstacles);
  for (const auto& body : contacts->moving()) body->body->drifts_always = scheme.contact == ContactIn::Step;
  if (contacts->bodies_.empty() && world.spheres.empty()) return {};
  return contacts;
}

void Contacts::add_meshes(const World& world, std::size_t bodies) {
  for (std::size_t m = 0; m < world.meshes.size(); ++m) {
    double thickness = -1; // [m], of the thickest body that meets it; none does
    for (const auto& body : moving()) {
      const bool meets =
          body->settings().obstacles && !body->body->contact_table.excludes_obstacle(world.number_of_mesh(m));
      if (!meets) continue;
      body->meets_obstacles = true;
      thickness = std::max(thickness, body->settings().thickness);
    }
    if (thickness >= 0)
      bodies_.push_back(
          std::make_unique<ContactBody>(world.meshes[m], world.number_of_mesh(m), bodies + m, thickness));
  }
}

void Contacts::advance(double time, double step) {
  for (const auto& body : moving())
    if (!body->body->next.finite()) return; // the scene is about to stop
  for (auto& body : bodies_) body->prepare(time + step, step);
  obstacles_.predict(time, step);
  detect();
  const bool again = in_ == ContactIn::StepInstead && anything();
  if (again) drift_all(time, step);
  answer_.solve(step);
  if (guard_)
    guard_->keep_apart(bodies_, lists(), obstacles_, answer_, step);
  else
    answer_.account();
  if (in_ != ContactIn::Result) end_step(time, step, again);
}

std::optional<ThroughEachOther> Contacts::crossing() const {
  return guard_ ? guard_->prescribed(bodies_, obstacles_) : std::nullopt;
}

bool Contacts::anything() {
  return !answer_.empty() || (guard_ && guard_->comes_through(bodies_, lists(), obstacles_, answer_));
}

// In place of what the scheme has made.
void Contacts::drift_all(double time, double step) {
  for (const auto& body : moving())
    if (!body->body->drifts()) body->body->drift_again(time, step);
  detect();
}

// As long as something touches, the state stays staggered. `drifted`: all bodies have.
void Contacts::end_step(double time, double step, bool drifted) {
  for (const auto& each : moving()) {
    Body& body = *each->body;
    if (!answer_.empty() || (guard_ && guard_->acted()))
      body.next.staggered = true;
    else if (drifted || body.drifts())
      body.kick(time, step);
  }
}

void Contacts::detect() {
  answer_.begin();
  if (torn_) torn_->detect(bodies_, answer_);
  if (fragments_) fragments_->detect(bodies_, answer_);
  for (EdgeContact* edges : {edges_.get(), obstacle_edges_.get()})
    if (edges) edges->detect(bodies_, answer_);
  obstacles_.detect(bodies_, answer_);
}

bool Contacts::with_faces() const {
  return std::any_of(bodies_.begin(), bodies_.end(), [](const auto& body) { return body->faces.has_value(); });
}

long Contacts::searches() const {
  long sum = fragments_ ? fragments_->searches() + fragments_->sweeps() : 0;
  for (const EdgeContact* edges : {edges_.get(), obstacle_edges_.get()})
    if (edges) sum += edges->searches();
  return sum;
}

void Contacts::store(Archive& archive) {
  archive.mark("contacts");
  if (!archive.reading()) return;
  for (auto& body : bodies_)
    if (body->faces) body->faces->update();
  if (fragments_) fragments_->forget();
  for (EdgeContact* edges : {edges_.get(), obstacle_edges_.get()})
    if (edges) edges->forget();
  if (torn_) torn_->forget();
}

std::size_t Contacts::bytes() const {
  std::size_t sum = obstacles_.bytes() + answer_.bytes() + (fragments_ ? fragments_->bytes() : 0) +
                    (edges_ ? edges_->bytes() : 0) + (obstacle_edges_ ? obstacle_edges_->bytes() : 0) +
                    (guard_ ? guard_->bytes() : 0) + (torn_ ? torn_->bytes() : 0);
  for (const auto& body : bodies_) sum += body->bytes();
  return sum;
}

} // namespace rend
