#include "sim/build/build_matter.h"

#include "sim/build/read_settings.h"
#include "sim/mechanics/elasticity.h"
#include "sim/mechanics/interaction.h"
#include "sim/topology/walk.h"

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
  for (AttributeType attribute : attributes_of<SpringSettings>()) {
    if (attribute.name == "k") attribute.unit = unit;
    type.attributes.push_back(std::move(attribute));
  }
  return type;
}

// What all springs of a body share.
struct SpringsSettings {
  std::optional<double> young;     // E [Pa]: stiffness by formula
  double poisson = 1.0 / 3;        // ν
  std::optional<double> thickness; // [m]
  Cumulated cumulated = Cumulated::Auto;
  enum class On { All, Surface } on = On::All;
  SettingsSource source = {};
};

struct ViscositySettings {
  double value = 0; // [N·s/m]
  enum class Per { Particle, Body } per = Per::Particle;
  SettingsSource source = {};
};

} // namespace

template <> const Fields<SpringsSettings>& fields_of() {
  using S = SpringsSettings;
  static const Fields<S> fields{
      field(&S::young,
            number("young", "Pa", "stiffness of stretch and shear by formula instead of k").above(0)),
      field(&S::poisson, number("poisson", "", "Poisson's ratio, for young").at_least(0).at_most(0.5)),
      field(&S::thickness, number("thickness", "m", "for young").above(0)),
      field(&S::cumulated, word("cumulated", {"auto", "yes", "no"},
                                "fold springs between the same particles into one: auto folds unless a law "
                                "looks at each by itself")),
      field(&S::on, word("on", {"all", "surface"},
                         "surface: only on the faces that are on the surface at the start (springs over finite "
                         "elements)"))};
  return fields;
}

template <> const Fields<ViscositySettings>& fields_of() {
  using S = ViscositySettings;
  static const Fields<S> fields{
      field(&S::value, number("value", "N.s/m", "the coefficient").at_least(0).is_required()),
      field(&S::per,
            word("per", {"particle", "body"}, "each particle's, or shared by the body as its mass is"))};
  return fields;
}

namespace {

const ElementType& springs_type() {
  static const ElementType stretch = spring_element("stretch");
  static const ElementType shear = spring_element("shear");
  static const ElementType bend = spring_element("bend");
  static const ElementType type{"springs",
                                "masses and springs",
                                attributes_of<SpringsSettings>(),
                                {{&stretch, 0, 1}, {&shear, 0, -1}, {&bend, 0, -1}}};
  return type;
}

const ElementType& elasticity_type() {
  static const ElementType type{
      "elasticity",
      "a continuum: finite elements on triangles, quads, tetrahedra, hexahedra, prisms and pyramids",
      attributes_of<ElasticitySettings>(),
      {}};
  return type;
}

const ElementType& viscosity_type() {
  static const ElementType type{
      "viscosity", "ambient viscosity: a force -value v", attributes_of<ViscositySettings>(), {}};
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

std::optional<SpringMaterial> spring_material(Body& body, const SpringsSettings& springs) {
  std::optional<SpringMaterial> material;
  if (springs.young) {
    if (body.map->dimension() == 3)
      springs.source.fail("young", "no formula gives the springs of a solid their stiffness",
                          "give each its k, or use <elasticity> for a material");
    if (!springs.thickness)
      springs.source.fail("young", "stiffness from young needs the thickness of the sheet",
                          "thickness=\"0.001\"");
    material = SpringMaterial{*springs.young, springs.poisson, *springs.thickness};
    note_exactness(body, *material);
  }
  for (const char* name : {"poisson", "thickness"})
    if (!material && springs.source.given(name))
      springs.source.fail(name, "has no use without young", "give young, or leave it out");
  return material;
}

bool is_meant(const InteractionType& type, const PresetNode& node) {
  return type.element == node.name() && (type.kind.empty() || node.text("kind") == type.kind) &&
         (type.where.empty() || node.text("where") == type.where);
}

void build_springs(Body& body, const PresetNode& node) {
  const auto springs = read_settings<SpringsSettings>(node);
  const std::optional<SpringMaterial> material = spring_material(body, springs);
  const bool surface = springs.on == SpringsSettings::On::Surface;
  body.cumulated = springs.cumulated;
  for (const auto& child : node.children()) {
    const auto settings = read_settings<SpringSettings>(*child);
    for (const InteractionType& type : all_interactions()) {
      if (!is_meant(type, *child)) continue;
      std::vector<std::string> why_not;
      if (auto made = type.make(*body.map, {settings, child->name(), material, why_not, surface}))
        body.interactions.push_back(std::move(made));
      for (auto* list : {&body.left_out, &body.notes})
        list->insert(list->end(), why_not.begin(), why_not.end());
    }
  }
}

// Small strain gives a sheet no stiffness out of its plane: it must lie in a plane of two axes and be held
// there.
void check_flat(const Body& body, const ElasticitySettings& elasticity, const PresetNode& node) {
  if (body.map->dimension() == 3 || elasticity.model == ContinuumModel::Corotational) return;
  Vec3 low = Vec3::Constant(1e300), high = -low;
  body.map->map().for_each_dart([&](Dart d) {
    low = low.cwiseMin(body.map->rest_of(d));
    high = high.cwiseMax(body.map->rest_of(d));
  });
  Vec3::Index axis = 0;
  const double depth = (high - low).minCoeff(&axis);
  const char letter = static_cast<char>('x' + axis);
  const bool flat = depth <= 1e-9 * (high - low).norm();
  for (const PresetNode* fix : node.all("fix"))
    if (flat && fix->given("all") && fix->flag("all") && fix->text("axes").find(letter) != std::string::npos)
      return;
  elasticity.source.fail(
      "model",
      fmt::format("'{}' gives a sheet no stiffness out of its plane",
                  elasticity.model == ContinuumModel::Linear ? "linear" : "mass-tensor"),
      flat ? fmt::format("keep it there with <fix all=\"yes\" axes=\"{}\"/>, or take "
                         "model=\"corotational\"",
                         letter)
           : "take model=\"corotational\", or a sheet in the plane of two axes that is held there");
}

void build_elasticity(Body& body, const PresetNode& element, const PresetNode& node) {
  const auto elasticity = read_settings<ElasticitySettings>(element);
  check_flat(body, elasticity, node);
  for (auto& made : make_elasticity(*body.map, elasticity, body.notes))
    body.interactions.push_back(std::move(made));
  body.uniform_drag += elasticity.damping_mass;
  if (!elasticity.source.given("cumulated")) return;
  const PresetNode* springs = node.child("springs");
  if (springs && springs->given("cumulated") && elasticity.cumulated != body.cumulated)
    elasticity.source.fail("cumulated", "differs from that of <springs>",
                           "a body folds all of its interactions or none");
  body.cumulated = elasticity.cumulated;
}

void build_viscosity(Body& body, const PresetNode& node) {
  const auto viscosity = read_settings<ViscositySettings>(node);
  if (viscosity.value == 0) return;
  if (viscosity.per == ViscositySettings::Per::Body) { // as the mass is spread: one rate for all, and no array
    body.uniform_drag += viscosity.value / total_mass(*body.map, *body.mass);
    return;
  }
  CornerDrag embedding;
  embedding.per_vertex = viscosity.value;
  body.drag = &body.map->add(embedding.on(*body.map));
}

} // namespace

std::vector<ChildType> matter_types() {
  return {{&springs_type(), 0, 1}, {&elasticity_type(), 0, 1}, {&viscosity_type(), 0, 1}};
}

void build_matter(Body& body, const PresetNode& node) {
  if (const PresetNode* springs = node.child("springs")) build_springs(body, *springs);
  if (const PresetNode* elasticity = node.child("elasticity")) build_elasticity(body, *elasticity, node);
  if (const PresetNode* viscosity = node.child("viscosity")) build_viscosity(body, *viscosity);
  if (!body.drag) body.left_out.emplace_back("viscosity per particle: none, so no array of it");
}

} // namespace rend
