#include "sim/contact/contacts.h"

#include "sim/base/archive.h"

namespace rend {

std::unique_ptr<Contacts> Contacts::of(World& world, const std::vector<std::unique_ptr<Body>>& bodies) {
  std::unique_ptr<Contacts> contacts(new Contacts(world));
  for (const auto& body : bodies)
    if (body->contact && body->contact->faces())
      contacts->bodies_.push_back(std::make_unique<ContactBody>(*body));
  for (const auto& body : contacts->bodies_)
    if (body->settings().fragments && !contacts->fragments_)
      contacts->fragments_ = std::make_unique<FragmentContact>();
  if (contacts->bodies_.empty() && world.spheres.empty()) return {};
  return contacts;
}

void Contacts::advance(double time, double step) {
  for (auto& body : bodies_)
    if (!body->body->next.finite()) return; // the scene is about to stop
  for (auto& body : bodies_) {
    body->prepare(time + step);
    if (body->body->work_meter) body->body->work_meter->before_contact(body->body->next);
  }
  if (fragments_) fragments_->advance(bodies_, step);
  obstacles_.advance(bodies_, time, step);
  for (auto& each : bodies_) {
    Body& body = *each->body;
    touched_.clear();
    if (body.floor_contact)
      body.floor_contact->apply(body.map->position().values().data(), body.next, step, touched_);
    body.constrain(time + step, body.next.position.data(), body.next.velocity.data());
    if (body.work_meter) body.work_meter->after_contact(body.metered(), step, body.next);
  }
}

void Contacts::store(Archive& archive) {
  archive.mark("contacts");
  for (auto& body : bodies_) {
    if (archive.reading()) body->faces.update();
    archive(body->changed);
  }
  if (fragments_) fragments_->store(archive, bodies_);
}

std::size_t Contacts::bytes() const {
  std::size_t sum = obstacles_.bytes() + (fragments_ ? fragments_->bytes() : 0);
  for (const auto& body : bodies_) sum += body->bytes();
  return sum;
}

} // namespace rend
