#include "sim/scene/build_body.h"

#include "sim/scene/build_laws.h"
#include "sim/scene/build_matter.h"
#include "sim/scene/build_motion.h"
#include "sim/scene/build_probe.h"
#include "sim/scene/build_shape.h"

namespace rend {
namespace {

void build_contact(Body& body, const Node& node, std::optional<double> floor) {
  const Node* contact = node.child("contact");
  if (!contact) {
    if (!floor) return;
    body.left_out.push_back("contact: the floor is drawn, and this body falls through it (no <contact>)");
    body.notes.push_back(body.left_out.back());
    return;
  }
  if (!floor)
    throw UserError(Exit::BadInput, contact->place(), "there is no floor to be in contact with",
                    "add <world><floor z=\"0\"/></world>");
  body.floor_contact = FloorContact{*floor + contact->number("thickness"), contact->number("friction")};
}

} // namespace

std::unique_ptr<Body> build_body(const Node& node, const Vec3& gravity, std::optional<double> floor) {
  auto body = std::make_unique<Body>();
  body->name = node.text("name");
  body->node = &node;
  body->gravity = Record(gravity);
  build_shape(*body, node);
  build_matter(*body, node);
  build_motion(*body, node);
  build_laws(*body, node);
  if (body->interactions.empty())
    body->notes.push_back("nothing holds this body together: it has neither <springs> nor <elasticity>");
  build_contact(*body, node, floor);
  build_probes(*body, node);
  return body;
}

} // namespace rend
