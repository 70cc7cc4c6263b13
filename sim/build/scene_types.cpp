#include "sim/build/scene_types.h"

#include "sim/build/build_contact.h"
#include "sim/build/build_laws.h"
#include "sim/build/build_matter.h"
#include "sim/build/build_motion.h"
#include "sim/build/build_probe.h"
#include "sim/build/build_shape.h"
#include "sim/build/build_world.h"
#include "sim/integrate/integrator.h"

#include <fmt/format.h>

namespace rend {

const ElementType& body_type() {
  static const ElementType type = [] {
    ElementType t{"body",
                  "a body that deforms",
                  {text("name", "to tell bodies apart; must differ").otherwise("body")},
                  {}};
    for (const auto& part : {shape_types(), matter_types(), motion_types(), law_types(), probe_types()})
      t.children.insert(t.children.end(), part.begin(), part.end());
    t.children.push_back({&contact_type(), 0, 1});
    return t;
  }();
  return type;
}

const ElementType& time_type() {
  static const ElementType type = [] {
    std::vector<std::string> names;
    for (const Scheme& scheme : all_schemes()) names.push_back(scheme.name);
    return ElementType{
        "time",
        "how time goes",
        {number_or("step", {"auto"}, "s",
                   "auto: 0.9 of what is stable (under rk45: with symplectic; under static: the duration)")
             .above(0)
             .otherwise("auto"),
         word("integrator", names, "the scheme").otherwise("symplectic"),
         number(
             "tolerance", "",
             "of rk45, which cuts each step into parts until what one part has wrong, in the mean over the "
             "body's mass, is below this share of the body's size (a velocity's error counts with the step's "
             "length)")
             .at_least(1e-14)
             .at_most(0.1)
             .otherwise("1e-6"),
         number("duration", "s", "of the clip; only static does without, and then it is 1").at_least(0)},
        {}};
  }();
  return type;
}

// An equilibrium takes no time: one step to the end, and any end.
double duration_of(const PresetNode& time) {
  if (time.has("duration")) return time.number("duration");
  if (time.text("integrator") == "static") return 1;
  const AttributeType& type = *time.type().find("duration");
  throw UserError(Exit::BadInput, time.place(), "<time> needs duration",
                  fmt::format("duration: {}; expected {}", type.what, expected(type)));
}

} // namespace rend
