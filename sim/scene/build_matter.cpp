#include "sim/scene/build_matter.h"

#include "sim/mechanics/interaction.h"

#include <fmt/format.h>

namespace rend {
namespace {

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

// How far a material's formulas can be trusted on the cells that there are.
void note_exactness(Body& body, const SpringMaterial& material) {
  bool triangles = false, quads = false;
  for_each_face(*body.map, [&](Dart d) {
    const int sides = sides_of_face(body.map->map(), d);
    triangles = triangles || sides == 3;
    quads = quads || sides == 4;
  });
  const double nu = material.poisson;
  if (quads && std::abs(nu - 1.0 / 3) > 1e-3)
    body.notes.push_back(fmt::format(
        "springs on rectangles keep the shear modulus, but behave as with poisson {:.4g} and young {:.4g} "
        "(exact at poisson 1/3 alone)",
        1 / (3 * nu + 2), 3 * material.young * (1 + 3 * nu) / (2 * (2 + 3 * nu))));
  if (triangles)
    body.notes.push_back(
        "springs on triangles give young and poisson back for equilateral ones at poisson 1/3 alone: squares "
        "halved "
        "along one diagonal then behave, along their sides, as with poisson 0 and 1.125 times young");
}

void build_springs(Body& body, const Node& node) {
  std::optional<SpringMaterial> material;
  if (node.given("young")) {
    if (!node.given("thickness"))
      node.fail("young", "stiffness from young needs the thickness of the sheet", "thickness=\"0.001\"");
    material = SpringMaterial{node.number("young"), node.number("poisson"), node.number("thickness")};
    note_exactness(body, *material);
  }
  for (const char* name : {"poisson", "thickness"})
    if (!material && node.given(name))
      node.fail(name, "has no use without young", "give young, or leave it out");
  const std::string& fold = node.text("cumulated");
  body.cumulated = fold == "auto" ? Cumulated::Auto : fold == "yes" ? Cumulated::Yes : Cumulated::No;
  for (const auto& child : node.children()) {
    for (const InteractionType& type : all_interactions()) {
      if (type.element != child->name() || (!type.kind.empty() && child->text("kind") != type.kind)) continue;
      std::vector<std::string> why_not;
      if (auto made = type.make(*body.map, {*child, material, why_not}))
        body.interactions.push_back(std::move(made));
      for (auto* list : {&body.left_out, &body.notes})
        list->insert(list->end(), why_not.begin(), why_not.end());
    }
  }
}

void build_viscosity(Body& body, const Node& node) {
  const double value = node.number("value");
  if (value == 0) return;
  if (node.text("per") == "body") { // as the mass is spread: one rate for all, and no array
    body.uniform_drag = value / total_mass(*body.map, *body.mass);
    return;
  }
  CornerDrag embedding;
  embedding.per_vertex = value;
  body.drag = &body.map->add(embedding.on(*body.map));
}

} // namespace

std::vector<ChildType> matter_types() {
  return {{&springs_type(), 0, 1}, {&viscosity_type(), 0, 1}};
}

void build_matter(Body& body, const Node& node) {
  if (const Node* springs = node.child("springs")) build_springs(body, *springs);
  if (const Node* viscosity = node.child("viscosity")) build_viscosity(body, *viscosity);
  if (!body.drag) body.left_out.push_back("viscosity per particle: none, so no array of it");
}

} // namespace rend
