#include "sim/build/build_body.h"

#include "sim/build/build_contact.h"
#include "sim/build/build_laws.h"
#include "sim/build/build_matter.h"
#include "sim/build/build_motion.h"
#include "sim/build/build_probe.h"
#include "sim/build/build_shape.h"

namespace rend {

template <> const Fields<BodySettings>& fields_of() {
  using S = BodySettings;
  static const Fields<S> fields{field(&S::name, text("name", "name of the body; each body has its own"))};
  return fields;
}

std::unique_ptr<Body> build_body(const BodySettings& settings, const World& world) {
  auto body = std::make_unique<Body>();
  body->name = settings.name;
  body->gravity = Record(world.gravity);
  if (world.over > 0)
    body->changing_gravity = [whole = world.gravity, over = world.over](double time) {
      return Vec3(ramp(time, over) * whole);
    };
  build_shape(*body, settings);
  build_matter(*body, settings);
  build_motion(*body, settings);
  build_laws(*body, settings);
  if (body->interactions.empty())
    body->notes.emplace_back("nothing holds this body together: add <springs> or <elasticity>");
  build_contact(*body, settings, world);
  build_probes(*body, settings);
  if (world.wind) body->loads.set(WindLoad(*body->map, *world.wind));
  return body;
}

} // namespace rend
