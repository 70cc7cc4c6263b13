#include "sim/mechanics/elasticity.h"

#include "sim/mechanics/mass.h"
#include "sim/mechanics/mass_tensor.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

// The numbers of an element law's unit, on the elements of one kind; 0 on others.
template <int Values> struct ElementEmbedding {
  using Value = std::array<double, Values>;
  std::string name;
  Orbit orbit, support;
  std::shared_ptr<const ElementLaw> law;
  double thickness;
  Place place;

  Value birth(const EmbeddedMap& map, Dart d) const {
    Value value{};
    const std::optional<ElementPlace> at = element_at(map.map(), d);
    if (!at || at->kind != law->shape().kind) return value;
    const std::vector<Vec3> rest = rest_positions(map, d, law->shape().units[at->unit]);
    if (!law->write_unit(rest.data(), thickness, value.data())) refuse_flat_element(place, law->shape(), rest);
    return value;
  }
  Value split(const Value& whole) const { return whole; }
};

template <int Values> struct ElementInteraction final : Interaction {
  const Column<ElementEmbedding<Values>>* column = nullptr;
  const double* unit(Slot owner, std::size_t) const override { return (*column)[owner].data(); }
};

bool (*present_of(ElementKind kind))(const GMap&, Dart, std::size_t) {
  using enum ElementKind;
  switch (kind) {
  case Triangle:
    return &element_present<Triangle>;
  case Quad:
    return &element_present<Quad>;
  case Tetrahedron:
    return &element_present<Tetrahedron>;
  case Hexahedron:
    return &element_present<Hexahedron>;
  case Prism:
    return &element_present<Prism>;
  case Pyramid:
    return &element_present<Pyramid>;
  }
  return nullptr;
}

Pattern pattern_of(const ElementShape& shape) {
  const Orbit owner = element_orbit(shape.dimension);
  return {
      .owner = owner, .support = owner, .units = shape.units, .fold = {}, .present = present_of(shape.kind)};
}

template <int Values>
std::unique_ptr<Interaction> made(EmbeddedMap& map, const std::shared_ptr<const ElementLaw>& law,
                                  double thickness, const Place& place) {
  const ElementShape& shape = law->shape();
  const Orbit owner = element_orbit(map.dimension());
  auto interaction = std::make_unique<ElementInteraction<Values>>();
  interaction->name = law->name();
  interaction->column = &map.add(ElementEmbedding<Values>{law->name(), owner, owner, law, thickness, place});
  interaction->law = law;
  interaction->pattern = pattern_of(shape);
  interaction->damped = law->material().damping > 0;
  return interaction;
}

std::unique_ptr<Interaction> make_one(EmbeddedMap& map, const std::shared_ptr<const ElementLaw>& law,
                                      double thickness, const Place& place) {
  switch (law->values()) {
  case 5:
    return made<5>(map, law, thickness, place);
  case 11:
    return made<11>(map, law, thickness, place);
  case 20:
    return made<20>(map, law, thickness, place);
  case 26:
    return made<26>(map, law, thickness, place);
  case 10:
    return made<10>(map, law, thickness, place);
  case 60:
    return made<60>(map, law, thickness, place);
  case 80:
    return made<80>(map, law, thickness, place);
  default:
    return nullptr;
  }
}

struct Census {
  std::array<std::size_t, element_kinds> of_kind{};
  std::size_t others = 0;
};

Census count_elements(const EmbeddedMap& map) {
  Census census;
  const CellIndex& elements = map.cells(element_orbit(map.dimension()));
  for (Slot e = 0; e < elements.slots(); ++e) {
    if (!elements.alive(e)) continue;
    if (const auto at = element_at(map.map(), elements.first_dart(e)))
      ++census.of_kind[static_cast<std::size_t>(at->kind)];
    else
      ++census.others;
  }
  return census;
}

// See linear_elements().
struct MadeWhenAsked final : Interaction {
  const EmbeddedMap* map = nullptr;
  double thickness = 0;
  mutable std::vector<double> values;

  const double* unit(Slot owner, std::size_t unit) const override {
    const auto& element = static_cast<const ElementLaw&>(*law);
    const std::vector<Vec3> rest =
        rest_positions(*map, map->cells(pattern.owner).first_dart(owner), pattern.units[unit]);
    values.resize(static_cast<std::size_t>(law->values()));
    if (!element.write_unit(rest.data(), thickness, values.data())) std::fill(values.begin(), values.end(), 0);
    return values.data();
  }
};

double thickness_of(const Node& node, int dimension) {
  if (dimension == 3) {
    if (node.given("thickness"))
      node.fail("thickness", "a solid has its own thickness", "leave it out; it is for sheets");
    return 1;
  }
  if (!node.given("thickness"))
    throw UserError(Exit::BadInput, node.place(), "elasticity of a sheet needs its thickness",
                    "thickness=\"0.001\"");
  return node.number("thickness");
}

} // namespace

const ElementType& elasticity_type() {
  static const ElementType type{
      "elasticity",
      "a continuum: finite elements on triangles, quads, tetrahedra, hexahedra, prisms and pyramids",
      {word(
           "model", {"linear", "corotational", "mass-tensor"},
           "linear: small displacements; corotational: large ones, each element in its own frame; mass-tensor: "
           "linear, stored on vertices and edges")
           .otherwise("corotational"),
       number("young", "Pa", "Young's modulus").above(0).is_required(),
       number("poisson", "", "Poisson's ratio").at_least(0).at_most(0.4999).otherwise("0.3"),
       number("thickness", "m", "of a sheet").above(0),
       word("rotation", {"polar", "qr"}, "corotational: the closest rotation, or Gram-Schmidt of the edges")
           .otherwise("polar"),
       number("damping-mass", "1/s", "Rayleigh damping: a force -value m v").at_least(0).otherwise("0"),
       number("damping-stiffness", "s", "Rayleigh damping: a force -value K v").at_least(0).otherwise("0"),
       word("cumulated", {"auto", "yes", "no"},
            "mass-tensor: fold tensors between the same particles into one: auto folds unless a law looks at "
            "each "
            "element by itself")
           .otherwise("auto")},
      {}};
  return type;
}

std::vector<std::unique_ptr<Interaction>> linear_elements(const EmbeddedMap& map,
                                                          const MassTensorRequest& request) {
  std::vector<std::unique_ptr<Interaction>> all;
  const Census census = count_elements(map);
  for (std::size_t n = 0; n < census.of_kind.size(); ++n) {
    if (census.of_kind[n] == 0) continue;
    const auto kind = static_cast<ElementKind>(n);
    auto made = std::make_unique<MadeWhenAsked>();
    made->law = element_law(kind, ElasticModel::Linear, Rotation::Polar, request.material);
    made->name = made->law->name();
    made->pattern = pattern_of(shape_of(kind));
    made->damped = request.material.damping > 0;
    made->map = &map;
    made->thickness = request.thickness;
    all.push_back(std::move(made));
  }
  return all;
}

ElasticMaterial elastic_material(const Node& node, int dimension) {
  ElasticMaterial material = ElasticMaterial::of(node.number("young"), node.number("poisson"), dimension);
  material.damping = node.number("damping-stiffness");
  return material;
}

void refuse_flat_element(const Place& place, const ElementShape& shape, const std::vector<Vec3>& rest) {
  std::string corners;
  for (const Vec3& x : rest) corners += fmt::format(" ({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z());
  throw UserError(Exit::BadInput, place,
                  fmt::format("the {} with the corners{} has no {}, or is folded", shape.name, corners,
                              shape.dimension == 2 ? "area" : "volume"),
                  "elasticity needs elements that are neither flat nor inside out: move these corners");
}

std::vector<std::unique_ptr<Interaction>> make_elasticity(EmbeddedMap& map, const ElasticityRequest& request) {
  const Node& node = request.node;
  const int dimension = map.dimension();
  const double thickness = thickness_of(node, dimension);
  const ElasticMaterial material = elastic_material(node, dimension);
  map.use(element_orbit(dimension));
  const Census census = count_elements(map);
  if (census.others > 0)
    request.notes.push_back(
        fmt::format("elasticity leaves out {} cells that are no {}", census.others,
                    dimension == 2 ? "triangles or quads" : "tetrahedra, hexahedra, prisms or pyramids"));
  std::vector<std::unique_ptr<Interaction>> all;
  if (node.text("model") == "mass-tensor") {
    all = make_mass_tensors(map, {material, thickness, node.place()});
  } else {
    const ElasticModel model =
        node.text("model") == "linear" ? ElasticModel::Linear : ElasticModel::Corotational;
    const Rotation rotation = node.text("rotation") == "qr" ? Rotation::Qr : Rotation::Polar;
    for (std::size_t kind = 0; kind < census.of_kind.size(); ++kind)
      if (census.of_kind[kind] > 0)
        all.push_back(make_one(map, element_law(static_cast<ElementKind>(kind), model, rotation, material),
                               thickness, node.place()));
  }
  if (all.empty())
    throw UserError(Exit::BadInput, node.place(), "no cell of this body is an element that elasticity fits");
  return all;
}

} // namespace rend
