#include "sim/mechanics/elasticity.h"

#include "sim/mechanics/mass.h"
#include "sim/mechanics/mass_tensor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// The values of an element law's unit, on the elements of one kind; 0 on others.
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

template <ElementKind kind>
std::unique_ptr<Interaction> made_of(EmbeddedMap& map, const std::shared_ptr<const ElementLaw>& law,
                                     double thickness, const Place& place) {
  using enum ElasticModel;
  using enum Formulation;
  if constexpr (can_be_enhanced(kind)) {
    if (law->formulation() == Enhanced && law->model() == Linear)
      return made<unit_values(kind, Linear, Enhanced)>(map, law, thickness, place);
    if (law->formulation() == Enhanced)
      return made<unit_values(kind, Corotational, Enhanced)>(map, law, thickness, place);
  }
  if (law->model() == Linear) return made<unit_values(kind, Linear)>(map, law, thickness, place);
  return made<unit_values(kind, Corotational)>(map, law, thickness, place);
}

std::unique_ptr<Interaction> make_one(EmbeddedMap& map, const std::shared_ptr<const ElementLaw>& law,
                                      double thickness, const Place& place) {
  using enum ElementKind;
  switch (law->shape().kind) {
  case Triangle:
    return made_of<Triangle>(map, law, thickness, place);
  case Quad:
    return made_of<Quad>(map, law, thickness, place);
  case Tetrahedron:
    return made_of<Tetrahedron>(map, law, thickness, place);
  case Hexahedron:
    return made_of<Hexahedron>(map, law, thickness, place);
  case Prism:
    return made_of<Prism>(map, law, thickness, place);
  case Pyramid:
    return made_of<Pyramid>(map, law, thickness, place);
  }
  return nullptr;
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
struct OnDemandUnits final : Interaction {
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

double thickness_of(const ElasticitySettings& settings, int dimension) {
  if (dimension == 3) {
    if (settings.thickness)
      settings.source.fail("thickness", "a solid has its own thickness", "leave it out; it is for sheets");
    return 1;
  }
  if (!settings.thickness)
    settings.source.fail("", "elasticity of a sheet needs its thickness", "thickness=\"0.001\"");
  return *settings.thickness;
}

ElasticMaterial material_of(const ElasticitySettings& settings, int dimension) {
  ElasticMaterial material = ElasticMaterial::of(settings.young, settings.poisson, dimension);
  material.damping = settings.damping_stiffness;
  return material;
}

// How much too stiff a single layer of plain rectangles or boxes bends, of length a along it and height b: they
// shear where they should curve, and cannot become narrower on one side,
//
//   sheet 1/(1 − ν²) + (a/b)²/(2 (1 + ν)),   solid (1 − ν)/((1 + ν)(1 − 2ν)) + (a/b)²/(2 (1 + ν))
//
// from the energy of u = κxy beside that of pure bending; n layers: 1 + (this − 1)/n².
double bending_excess(double aspect, double poisson, int dimension) {
  const double held =
      dimension == 2 ? 1 / (1 - poisson * poisson) : (1 - poisson) / ((1 + poisson) * (1 - 2 * poisson));
  return held + aspect * aspect / (2 * (1 + poisson));
}

// The largest ratio of two edges of one quad or hexahedron.
double largest_aspect(const EmbeddedMap& map) {
  const CellIndex& elements = map.cells(element_orbit(map.dimension()));
  double most = 1;
  for (Slot e = 0; e < elements.slots(); ++e) {
    if (!elements.alive(e)) continue;
    const Dart d = elements.first_dart(e);
    const auto at = element_at(map.map(), d);
    if (!at || !can_be_enhanced(at->kind)) continue;
    const std::vector<Vec3> rest = rest_positions(map, d, shape_of(at->kind).units[at->unit]);
    double longest = 0, shortest = HUGE_VAL;
    for (std::size_t n = 1; n < rest.size();
         n += n == 1 ? 2 : 1) { // the neighbours of the first corner: 1, 3, 4
      if (n > 4) break;
      longest = std::max(longest, (rest[n] - rest[0]).norm());
      shortest = std::min(shortest, (rest[n] - rest[0]).norm());
    }
    most = std::max(most, longest / shortest);
  }
  return most;
}

void note_bending(const EmbeddedMap& map, const ElasticitySettings& settings, const Census& census,
                  std::vector<std::string>& notes) {
  constexpr double bearable = 3;
  if (settings.formulation == Formulation::Enhanced) return;
  if (census.of_kind[static_cast<std::size_t>(map.dimension() == 2 ? ElementKind::Quad
                                                                   : ElementKind::Hexahedron)] == 0)
    return;
  const double aspect = largest_aspect(map);
  const double excess = bending_excess(aspect, settings.poisson, map.dimension());
  if (excess < bearable) return;
  notes.push_back(
      fmt::format("a single layer of these {} (edges up to 1 : {:.3g}, Poisson's ratio {:g}) bends {:.2g} "
                  "times too stiffly{}",
                  map.dimension() == 2 ? "quads in their plane" : "hexahedra", aspect, settings.poisson, excess,
                  settings.model == ContinuumModel::MassTensor ? "" : ": formulation=\"enhanced\" does not"));
}

} // namespace

template <> const Fields<ElasticitySettings>& fields_of() {
  using S = ElasticitySettings;
  static const Fields<S> fields{
      field(
          &S::model,
          word("model", {"linear", "corotational", "mass-tensor"},
               "kind of finite element\nlinear: for small displacements\ncorotational: for large ones; each "
               "element turns with its own frame\nmass-tensor: the linear one, stored on vertices and edges")),
      field(&S::young, number("young", "Pa", "Young's modulus").above(0).is_required()),
      field(&S::poisson, number("poisson", "", "Poisson's ratio").at_least(0).at_most(0.4999)),
      field(&S::thickness, number("thickness", "m", "thickness of the sheet").above(0)),
      field(&S::rotation, word("rotation", {"polar", "qr"},
                               "corotational: how the rotation of an element is found\npolar: the closest "
                               "rotation\nqr: Gram-Schmidt of its edges")),
      field(&S::formulation, word("formulation", {"plain", "enhanced"},
                                  "of quads and hexahedra\nplain: the displacement element, too stiff in "
                                  "bending\nenhanced: with inner "
                                  "modes for bending, which take longer")),
      field(&S::damping_mass,
            number("damping-mass", "1/s", "Rayleigh damping: a force -value m v").at_least(0)),
      field(&S::damping_stiffness,
            number("damping-stiffness", "s", "Rayleigh damping: a force -value K v").at_least(0)),
      field(&S::cumulated, word("cumulated", {"auto", "yes", "no"},
                                "mass-tensor: whether tensors between the same two vertices are merged into "
                                "one; auto: yes, unless a <tear> measures each element separately"))};
  return fields;
}

std::vector<std::unique_ptr<Interaction>> linear_elements(const EmbeddedMap& map,
                                                          const MassTensorRequest& request) {
  std::vector<std::unique_ptr<Interaction>> all;
  const Census census = count_elements(map);
  for (std::size_t n = 0; n < census.of_kind.size(); ++n) {
    const auto kind = static_cast<ElementKind>(n);
    if (shape_of(kind).dimension != map.dimension() || (census.of_kind[n] == 0 && !map.grows())) continue;
    auto made = std::make_unique<OnDemandUnits>();
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

void refuse_flat_element(const Place& place, const ElementShape& shape, const std::vector<Vec3>& rest) {
  std::string corners;
  for (const Vec3& x : rest) corners += fmt::format(" ({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z());
  throw UserError(Exit::BadInput, place,
                  fmt::format("the {} with the corners{} has no {}, or is folded", shape.name, corners,
                              shape.dimension == 2 ? "area" : "volume"),
                  "elasticity needs elements that are neither flat nor inside out: move these corners");
}

std::vector<std::unique_ptr<Interaction>> make_elasticity(EmbeddedMap& map, const ElasticitySettings& settings,
                                                          std::vector<std::string>& notes,
                                                          std::vector<AwaitedInteraction>* awaited) {
  const int dimension = map.dimension();
  const double thickness = thickness_of(settings, dimension);
  const ElasticMaterial material = material_of(settings, dimension);
  const Place place = settings.source.place();
  map.use(element_orbit(dimension));
  const Census census = count_elements(map);
  if (census.others > 0)
    notes.push_back(
        fmt::format("elasticity leaves out {} cells that are no {}", census.others,
                    dimension == 2 ? "triangles or quads" : "tetrahedra, hexahedra, prisms or pyramids"));
  std::vector<std::unique_ptr<Interaction>> all;
  if (settings.model == ContinuumModel::MassTensor) {
    if (settings.formulation == Formulation::Enhanced)
      settings.source.fail("formulation", "mass-tensors have no inner modes",
                           "model=\"corotational\" or model=\"linear\", or leave formulation out");
    all = make_mass_tensors(map, {material, thickness, place}, awaited);
  } else {
    const ElasticModel model =
        settings.model == ContinuumModel::Linear ? ElasticModel::Linear : ElasticModel::Corotational;
    for (std::size_t n = 0; n < census.of_kind.size(); ++n) {
      const auto kind = static_cast<ElementKind>(n);
      if (shape_of(kind).dimension != dimension || (census.of_kind[n] == 0 && !awaited)) continue;
      const auto law = element_law(kind, model, settings.rotation, material, settings.formulation);
      const auto make = [=](EmbeddedMap& to) { return make_one(to, law, thickness, place); };
      if (census.of_kind[n] > 0)
        all.push_back(make(map));
      else
        awaited->push_back({law->name(), law, pattern_of(law->shape()), make});
    }
  }
  note_bending(map, settings, census, notes);
  if (all.empty()) settings.source.fail("", "no cell of this body is an element that elasticity fits");
  return all;
}

} // namespace rend
