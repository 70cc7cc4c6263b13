#include "sim/build/body_types.h"

#include "sim/build/body_settings.h"

#include <algorithm>

namespace rend {
namespace {

void add_once(std::vector<std::string>& list, const std::string& word) {
  if (!word.empty() && std::find(list.begin(), list.end(), word) == list.end()) list.push_back(word);
}

std::string joined(const std::vector<std::string>& list, const char* between) {
  std::string out;
  for (const std::string& each : list) out += (out.empty() ? "" : between) + each;
  return out;
}

// "isotropic in a face"; empty: the only interaction of its element.
std::string variant_of(const InteractionType& interaction) {
  return interaction.kind + (interaction.where.empty() ? "" : " in a " + interaction.where);
}

// What help says of k: units of all interactions of the element, and which of them have a formula.
void describe_stiffness(AttributeType& k, const std::vector<const InteractionType*>& interactions) {
  std::vector<std::string> units, by_formula;
  bool all = true;
  for (const InteractionType* interaction : interactions) {
    add_once(units, interaction->k_unit);
    all = all && interaction->by_formula;
    if (interaction->by_formula) by_formula.push_back(variant_of(*interaction));
  }
  k.unit = joined(units, " or ");
  if (by_formula.empty()) return;
  k.what += "; or computed from young" + (all ? "" : " (" + joined(by_formula, ", ") + ")");
}

// <stretch>, <shear>, <bend>: one element for all interactions of that name, which differ by `kind` and
// `where`.
ElementType spring_element(const std::string& name) {
  ElementType type{name, "", {}, {}};
  std::vector<std::string> kinds, places, damping_units;
  std::vector<const InteractionType*> interactions;
  for (const InteractionType& interaction : all_interactions()) {
    if (interaction.element != name) continue;
    interactions.push_back(&interaction);
    const std::string which = variant_of(interaction);
    type.what += (type.what.empty() ? "" : "\n") + (which.empty() ? "" : which + ": ") + interaction.what;
    add_once(kinds, interaction.kind);
    add_once(places, interaction.where);
    add_once(damping_units, interaction.damping_unit());
  }
  if (!kinds.empty()) {
    const std::string first = kinds.front();
    type.attributes.push_back(word("kind", kinds, "which kind of spring").otherwise(first));
  }
  if (!places.empty()) {
    const std::string first = places.front();
    type.attributes.push_back(word("where", places, "face: in faces; volume: in hexahedra").otherwise(first));
  }
  for (AttributeType attribute : attributes_of<SpringSettings>()) {
    if (attribute.name == "k") describe_stiffness(attribute, interactions);
    if (attribute.name == "damping") attribute.unit = joined(damping_units, " or ");
    type.attributes.push_back(std::move(attribute));
  }
  return type;
}

const ElementType& springs_type() {
  static const ElementType stretch = spring_element("stretch");
  static const ElementType shear = spring_element("shear");
  static const ElementType bend = spring_element("bend");
  static const ElementType type{"springs",
                                "springs between the vertices, which carry the mass",
                                attributes_of<SpringsSettings>(),
                                {{&stretch, 0, 1}, {&shear, 0, -1}, {&bend, 0, -1}}};
  return type;
}

} // namespace

std::vector<ChildType> shape_types() {
  static const ElementType place =
      element_type_of<Placement>("place", "where the body is at rest: it is scaled, then rotated, then moved");
  static const ElementType mass = element_type_of<MassSettings>("mass", "the mass of the body");
  static const ElementType slit = element_type_of<SlitSettings>(
      "slit", "a cut that a sheet of triangles has from the start: the notch of a specimen, a perforation");
  static const ElementType pieces = element_type_of<PiecesSettings>(
      "pieces", "the body is weak between cells of its shape: sheets of triangles, solids of tetrahedra");
  std::vector<ChildType> types;
  for (const ShapeType& shape : all_shapes()) types.push_back({&shape.type(), 0, 1});
  types.push_back({&apply_type(), 0, -1});
  types.push_back({&subdivide_type(), 0, -1});
  types.push_back({&slit, 0, -1});
  types.push_back({&pieces, 0, 1});
  types.push_back({&place, 0, 1});
  types.push_back({&mass, 1, 1});
  return types;
}

std::vector<ChildType> matter_types() {
  static const ElementType elasticity = element_type_of<ElasticitySettings>(
      "elasticity",
      "a continuum: finite elements on triangles, quads, tetrahedra, hexahedra, prisms and pyramids");
  static const ElementType viscosity = element_type_of<ViscositySettings>(
      "viscosity", "drag of the surroundings: a force of -value times the velocity on each vertex");
  return {{&springs_type(), 0, 1}, {&elasticity, 0, 1}, {&viscosity, 0, 1}};
}

std::vector<ChildType> motion_types() {
  static const ElementType fix =
      element_type_of<FixSettings>("fix", "holds the selected vertices where they are at rest");
  static const ElementType drive =
      element_type_of<DriveSettings>("drive", "moves the selected vertices as prescribed");
  static const ElementType load = element_type_of<LoadSettings>(
      "load",
      "an external force on the selected boundary: spread by area over the outer faces of a solid, by length "
      "along the border of a sheet; where no whole face or edge is selected, in equal parts over the vertices");
  return {{&fix, 0, -1}, {&drive, 0, -1}, {&load, 0, -1}};
}

std::vector<ChildType> law_types() {
  static const ElementType tear = element_type_of<LawSettings>(
      "tear", "a law of tearing: wherever the criterion exceeds the threshold, the change is made");
  return {{&tear, 0, -1}};
}

std::vector<ChildType> probe_types() {
  static const ElementType probe = element_type_of<ProbeSettings>(
      "probe", "measures at the selected vertices: their mean position and displacement, the force of the "
               "supports where they are fixed or driven, and the mean stress of the elements there");
  static const ElementType answer = element_type_of<AnswerSettings>(
      "answer", "the value that a probe should measure; `rend run` compares them, and "
                "exits with 1 if they differ by more than the tolerance");
  return {{&probe, 0, -1}, {&answer, 0, -1}};
}

const ElementType& contact_type() {
  static const ElementType type = element_type_of<ContactSettings>(
      "contact", "what the body collides with; without it, the body passes through everything");
  return type;
}

} // namespace rend
