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
namespace {

const ElementType& look_type() {
  static const ElementType type{
      "look",
      "how the body is drawn",
      {text("colour", "#rrggbb").otherwise("#2a7f8e"),
       text("back", "#rrggbb, of a sheet's far side; default: the colour, a shade darker"),
       text("inside", "#rrggbb, of the faces of a solid that fracture lays bare").otherwise("#e8b27a"),
       word("by", {"plain", "strain", "stress", "force", "fragment"},
            "what the colour shows, on a scale from 0 to the most of the clip so far: the largest "
            "principal strain or stress [Pa] of the elements there (of springs: elongation), or force [N]")
           .otherwise("plain"),
       number("most", "",
              "the quantity at the end of the scale; default: the most of the clip so far, rounded up")
           .above(0),
       flag("edges", "draw the edges of cells").otherwise("yes"),
       word("as", {"surface", "wires", "exploded", "darts"},
            "what is drawn: the surface; its edges alone; every cell by itself, moved away from the middle; "
            "the darts "
            "of the map and the links between them")
           .otherwise("surface"),
       number("apart", "",
              "of exploded cells: how far they are moved, in shares of their distance from the middle")
           .above(0)
           .at_most(10)
           .otherwise("0.4"),
       text("finish", "cloth, matte, rubber, organ or brittle: how it takes the light").otherwise("cloth")},
      {}};
  return type;
}

} // namespace

const ElementType& body_type() {
  static const ElementType type = [] {
    ElementType t{"body",
                  "a body that deforms",
                  {text("name", "to tell bodies apart; must differ").otherwise("body")},
                  {}};
    for (const auto& part : {shape_types(), matter_types(), motion_types(), law_types(), probe_types()})
      t.children.insert(t.children.end(), part.begin(), part.end());
    t.children.push_back({&contact_type(), 0, 1});
    t.children.push_back({&look_type(), 0, 1});
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
