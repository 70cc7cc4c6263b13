#include "sim/build/build_matter.h"

#include "sim/mechanics/elasticity.h"
#include "sim/mechanics/interaction.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

void add_once(std::vector<std::string>& list, const std::string& word) {
  if (!word.empty() && std::find(list.begin(), list.end(), word) == list.end()) list.push_back(word);
}

// <stretch>, <shear>, <bend>: one element for all interactions of that name, which differ by `kind` and
// `where`.
ElementType spring_element(const std::string& name) {
  ElementType type{name, "", {}, {}};
  std::vector<std::string> kinds, places;
  std::string unit;
  for (const InteractionType& interaction : all_interactions()) {
    if (interaction.element != name) continue;
    const std::string which =
        interaction.kind + (interaction.where.empty() ? "" : " in a " + interaction.where);
    type.what += (type.what.empty() ? "" : "; ") + (which.empty() ? "" : which + ": ") + interaction.what;
    add_once(kinds, interaction.kind);
    add_once(places, interaction.where);
    if (unit.find(interaction.k_unit) == std::string::npos)
      unit += (unit.empty() ? "" : " or ") + interaction.k_unit;
  }
  if (!kinds.empty()) {
    const std::string first = kinds.front();
    type.attributes.push_back(word("kind", kinds, "which one").otherwise(first));
  }
  if (!places.empty()) {
    const std::string first = places.front();
    type.attributes.push_back(word("where", places, "in faces, or in hexahedra").otherwise(first));
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
           .otherwise("auto"),
       word("on", {"all", "surface"},
            "surface: only on the faces that are on the surface at the start (springs over finite elements)")
           .otherwise("all")},
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

Cumulated cumulated_of(const Node& node) {
  const std::string& fold = node.text("cumulated");
  return fold == "auto" ? Cumulated::Auto : fold == "yes" ? Cumulated::Yes : Cumulated::No;
}

std::optional<SpringMaterial> spring_material(Body& body, const Node& node) {
  std::optional<SpringMaterial> material;
  if (node.given("young")) {
    if (body.map->dimension() == 3)
      node.fail("young", "no formula gives the springs of a solid their stiffness",
                "give each its k, or use <elasticity> for a material");
    if (!node.given("thickness"))
      node.fail("young", "stiffness from young needs the thickness of the sheet", "thickness=\"0.001\"");
    material = SpringMaterial{node.number("young"), node.number("poisson"), node.number("thickness")};
    note_exactness(body, *material);
  }
  for (const char* name : {"poisson", "thickness"})
    if (!material && node.given(name))
      node.fail(name, "has no use without young", "give young, or leave it out");
  return material;
}

bool is_meant(const InteractionType& type, const Node& node) {
  return type.element == node.name() && (type.kind.empty() || node.text("kind") == type.kind) &&
         (type.where.empty() || node.text("where") == type.where);
}

void build_springs(Body& body, const Node& node) {
  const std::optional<SpringMaterial> material = spring_material(body, node);
  body.cumulated = cumulated_of(node);
  for (const auto& child : node.children()) {
    for (const InteractionType& type : all_interactions()) {
      if (!is_meant(type, *child)) continue;
      std::vector<std::string> why_not;
      if (auto made = type.make(*body.map, {*child, material, why_not, node.text("on") == "surface"}))
        body.interactions.push_back(std::move(made));
      for (auto* list : {&body.left_out, &body.notes})
        list->insert(list->end(), why_not.begin(), why_not.end());
    }
  }
}

// Small strain gives a sheet no stiffness out of its plane: it must lie in a plane of two axes and be held
// there.
void check_flat(const Body& body, const Node& elasticity, const Node& node) {
  if (body.map->dimension() == 3 || elasticity.text("model") == "corotational") return;
  Vec3 low = Vec3::Constant(1e300), high = -low;
  body.map->map().for_each_dart([&](Dart d) {
    low = low.cwiseMin(body.map->rest_of(d));
    high = high.cwiseMax(body.map->rest_of(d));
  });
  Vec3::Index axis = 0;
  const double depth = (high - low).minCoeff(&axis);
  const char letter = static_cast<char>('x' + axis);
  const bool flat = depth <= 1e-9 * (high - low).norm();
  for (const Node* fix : node.all("fix"))
    if (flat && fix->given("all") && fix->flag("all") && fix->text("axes").find(letter) != std::string::npos)
      return;
  elasticity.fail("model",
                  fmt::format("'{}' gives a sheet no stiffness out of its plane", elasticity.text("model")),
                  flat ? fmt::format("keep it there with <fix all=\"yes\" axes=\"{}\"/>, or take "
                                     "model=\"corotational\"",
                                     letter)
                       : "take model=\"corotational\", or a sheet in the plane of two axes that is held there");
}

void build_elasticity(Body& body, const Node& elasticity, const Node& node) {
  check_flat(body, elasticity, node);
  for (auto& made : make_elasticity(*body.map, {elasticity, body.notes}))
    body.interactions.push_back(std::move(made));
  body.uniform_drag += elasticity.number("damping-mass");
  if (!elasticity.given("cumulated")) return;
  const Cumulated wanted = cumulated_of(elasticity);
  const Node* springs = node.child("springs");
  if (springs && springs->given("cumulated") && wanted != body.cumulated)
    elasticity.fail("cumulated", "differs from that of <springs>",
                    "a body folds all of its interactions or none");
  body.cumulated = wanted;
}

void build_viscosity(Body& body, const Node& node) {
  const double value = node.number("value");
  if (value == 0) return;
  if (node.text("per") == "body") { // as the mass is spread: one rate for all, and no array
    body.uniform_drag += value / total_mass(*body.map, *body.mass);
    return;
  }
  CornerDrag embedding;
  embedding.per_vertex = value;
  body.drag = &body.map->add(embedding.on(*body.map));
}

} // namespace

std::vector<ChildType> matter_types() {
  return {{&springs_type(), 0, 1}, {&elasticity_type(), 0, 1}, {&viscosity_type(), 0, 1}};
}

void build_matter(Body& body, const Node& node) {
  if (const Node* springs = node.child("springs")) build_springs(body, *springs);
  if (const Node* elasticity = node.child("elasticity")) build_elasticity(body, *elasticity, node);
  if (const Node* viscosity = node.child("viscosity")) build_viscosity(body, *viscosity);
  if (!body.drag) body.left_out.emplace_back("viscosity per particle: none, so no array of it");
}

} // namespace rend
