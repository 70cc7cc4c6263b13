#include "sim/build/build_body.h"

#include "sim/build/build_contact.h"
#include "sim/build/build_laws.h"
#include "sim/build/build_matter.h"
#include "sim/build/build_motion.h"
#include "sim/build/build_probe.h"
#include "sim/build/build_shape.h"

namespace rend {

std::unique_ptr<Body> build_body(const PresetNode& node, const World& world) {
  auto body = std::make_unique<Body>();
  body->name = node.text("name");
  body->node = &node;
  body->gravity = Record(world.gravity);
  build_shape(*body, node);
  build_matter(*body, node);
  build_motion(*body, node);
  build_laws(*body, node);
  if (body->interactions.empty())
    body->notes.emplace_back("nothing holds this body together: it has neither <springs> nor <elasticity>");
  build_contact(*body, node, world);
  build_probes(*body, node);
  return body;
}

} // namespace rend
