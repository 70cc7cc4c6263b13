#include "sim/scene/scene_types.h"

#include "sim/fracture/change.h"
#include "sim/integrate/integrator.h"
#include "sim/mechanics/interaction.h"
#include "sim/scene/selector.h"

namespace rend {
namespace {

const ElementType& sheet_type() {
  static const ElementType type{
      "sheet",
      "a rectangular sheet, or a band",
      {word("pattern", {"quads", "triangles", "crossed", "mixed"},
            "cells: quads; each quad cut along a diagonal; cut in four around its centre; every second one so")
           .otherwise("quads"),
       integers("cells", 2, "how many along x and y").at_least(1).at_most(20000).is_required(),
       numbers("size", 2, "m", "lengths along x and y (of a band: around and across)").above(0),
       numbers("corners", 12, "m", "the four corners instead, around the sheet; points are bilinear"),
       word("close", {"none", "loop", "twist"}, "join the ends x = 0 and x = lx: a band, a Moebius band")
           .otherwise("none")},
      {}};
  return type;
}

const ElementType& place_type() {
  static const ElementType type{"place",
                                "where the body is at rest: scaled, then rotated, then moved",
                                {number("scale", "", "factor").above(0).otherwise("1"),
                                 numbers("rotate", 3, "degrees", "about x, then y, then z").otherwise("0 0 0"),
                                 numbers("translate", 3, "m", "moved by, last").otherwise("0 0 0")},
                                {}};
  return type;
}

const ElementType& mass_type() {
  static const ElementType type{"mass",
                                "the mass of the body",
                                {number("total", "kg", "of the whole body, spread by area").above(0),
                                 number("density", "kg/m3", "instead; needs the thickness of a sheet").above(0),
                                 number("thickness", "m", "of a sheet").above(0)},
                                {}};
  return type;
}

// <stretch>, <shear>, <bend>: one element for all interactions of that name, which differ by `kind`.
ElementType spring_element(const std::string& name) {
  ElementType type{name, "", {}, {}};
  std::vector<std::string> kinds;
  std::string unit;
  for (const InteractionType& interaction : all_interactions()) {
    if (interaction.element != name) continue;
    type.what += (type.what.empty() ? "" : "; ") + (interaction.kind.empty() ? "" : interaction.kind + ": ") +
                 interaction.what;
    if (!interaction.kind.empty()) kinds.push_back(interaction.kind);
    if (unit.find(interaction.k_unit) == std::string::npos)
      unit += (unit.empty() ? "" : " or ") + interaction.k_unit;
  }
  if (!kinds.empty()) {
    const std::string first = kinds.front();
    type.attributes.push_back(word("kind", kinds, "which one").otherwise(first));
  }
  type.attributes.push_back(
      number("k", unit, "stiffness of each elementary spring; or by formula from young").above(0));
  type.attributes.push_back(
      number("damping", "N.s/m", "along the spring (N.m.s/rad about a hinge)").at_least(0).otherwise("0"));
  return type;
}

const ElementType& springs_type() {
  static const ElementType stretch = spring_element("stretch");
  static const ElementType shear = spring_element("shear");
  static const ElementType bend = spring_element("bend");
  static const ElementType type{
      "springs",
      "masses and springs",
      {number("young", "Pa", "stiffness of stretch and shear by formula instead of k").above(0),
       number("poisson", "", "Poisson's ratio, for young")
           .at_least(0)
           .at_most(0.5)
           .otherwise("0.3333333333333333"),
       number("thickness", "m", "for young").above(0),
       word("cumulated", {"auto", "yes", "no"},
            "fold springs between the same particles into one: auto folds unless a law looks at each by itself")
           .otherwise("auto")},
      {{&stretch, 0, 1}, {&shear, 0, -1}, {&bend, 0, -1}}};
  return type;
}

const ElementType& viscosity_type() {
  static const ElementType type{
      "viscosity",
      "ambient viscosity: a force -value v",
      {number("value", "N.s/m", "the coefficient").at_least(0).is_required(),
       word("per", {"particle", "body"}, "each particle's, or shared by the body as its mass is")
           .otherwise("particle")},
      {}};
  return type;
}

const ElementType& fix_type() {
  static const ElementType type = [] {
    ElementType t{"fix", "vertices that stay where they are at rest", {}, {}};
    add_selector(t.attributes);
    t.attributes.push_back(
        word("axes", {"x", "y", "z", "xy", "xz", "yz", "xyz"}, "which coordinates").otherwise("xyz"));
    return t;
  }();
  return type;
}

const ElementType& drive_type() {
  static const ElementType type = [] {
    ElementType t{"drive", "vertices that move as prescribed", {}, {}};
    add_selector(t.attributes);
    t.attributes.push_back(numbers("velocity", 3, "m/s", "constant velocity"));
    t.attributes.push_back(numbers("displacement", 3, "m",
                                   "moved by so much between from and until (at once, if until is absent)"));
    t.attributes.push_back(
        numbers("gradient", 9, "", "u = G X, row after row, reached between from and until"));
    t.attributes.push_back(number("from", "s", "held before").at_least(0).otherwise("0"));
    t.attributes.push_back(number("until", "s", "for ever, if absent").at_least(0));
    t.attributes.push_back(word("then", {"hold", "free"}, "after until").otherwise("hold"));
    t.attributes.push_back(
        word("axes", {"x", "y", "z", "xy", "xz", "yz", "xyz"}, "which coordinates").otherwise("xyz"));
    return t;
  }();
  return type;
}

const ElementType& tear_type() {
  static const ElementType type = [] {
    std::vector<std::string> criteria, changes;
    std::string what;
    for (const CriterionType& c : all_criteria()) {
      criteria.push_back(c.name);
      what += (what.empty() ? "" : "; ") + c.name + ": " + c.what;
    }
    for (const ChangeType& c : all_changes()) changes.push_back(c.name);
    return ElementType{
        "tear",
        "a law: where the criterion exceeds the threshold, the change is made",
        {word("criterion", criteria, what).is_required(),
         number("threshold", "N", "the value above which it tears; rend run --events tells what was reached")
             .above(0)
             .is_required(),
         word("change", changes, "what is done; default: that of the criterion"),
         number("from", "s", "not before").at_least(0).otherwise("0"),
         number("until", "s", "not after").at_least(0),
         integer("max-per-step", "the worst so many a step; 0: all").at_least(0).otherwise("0")},
        {}};
  }();
  return type;
}

const ElementType& contact_type() {
  static const ElementType type{"contact",
                                "what the body does not pass through",
                                {word("with", {"floor"}, "what it meets").otherwise("floor"),
                                 number("thickness", "m", "kept from it").at_least(0).otherwise("0.002"),
                                 number("friction", "", "Coulomb's coefficient").at_least(0).otherwise("0.5")},
                                {}};
  return type;
}

const ElementType& look_type() {
  static const ElementType type{
      "look",
      "how the body is drawn",
      {text("colour", "#rrggbb").otherwise("#2a7f8e"),
       word("by", {"plain", "strain", "force", "fragment"}, "what the colour shows").otherwise("plain"),
       flag("edges", "draw the edges of cells").otherwise("yes")},
      {}};
  return type;
}

} // namespace

const ElementType& body_type() {
  static const ElementType type{"body",
                                "a body that deforms",
                                {text("name", "to tell bodies apart; must differ").otherwise("body")},
                                {{&sheet_type(), 1, 1},
                                 {&place_type(), 0, 1},
                                 {&mass_type(), 1, 1},
                                 {&springs_type(), 0, 1},
                                 {&viscosity_type(), 0, 1},
                                 {&fix_type(), 0, -1},
                                 {&drive_type(), 0, -1},
                                 {&tear_type(), 0, -1},
                                 {&contact_type(), 0, 1},
                                 {&look_type(), 0, 1}}};
  return type;
}

const ElementType& world_type() {
  static const ElementType floor{
      "floor", "a floor, drawn below the bodies", {number("z", "m", "its height").otherwise("0")}, {}};
  static const ElementType type{"world",
                                "what surrounds the bodies",
                                {numbers("gravity", 3, "m/s2", "its acceleration").otherwise("0 0 -9.81")},
                                {{&floor, 0, 1}}};
  return type;
}

const ElementType& time_type() {
  static const ElementType type = [] {
    std::vector<std::string> names;
    for (const Scheme& scheme : all_schemes()) names.push_back(scheme.name);
    return ElementType{
        "time",
        "how time goes",
        {number_or("step", {"auto"}, "s", "auto: 0.9 of what is stable").above(0).otherwise("auto"),
         word("integrator", names, "the scheme").otherwise("symplectic"),
         number("duration", "s", "of the clip").at_least(0).is_required()},
        {}};
  }();
  return type;
}

} // namespace rend
