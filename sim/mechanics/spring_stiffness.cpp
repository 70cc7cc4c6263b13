#include "sim/mechanics/spring_stiffness.h"

#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <cmath>

namespace rend {
namespace {

// Lengths of the sides of the face of d, that of d first.
std::vector<double> side_lengths(const EmbeddedMap& map, Dart d) {
  std::vector<double> lengths;
  Dart at = d;
  do {
    const Dart end = map.map().alpha(0, at);
    lengths.push_back((map.rest_of(end) - map.rest_of(at)).norm());
    at = map.map().alpha(1, end);
  } while (at != d);
  return lengths;
}

// For a quad: the means of its opposite sides, the same for all corners.
std::pair<double, double> sides_of(const std::vector<double>& side) {
  return {0.5 * (side[0] + side[2]), 0.5 * (side[1] + side[3])};
}

std::string place_of(const EmbeddedMap& map, Dart d) {
  const Vec3 x = 0.5 * (map.rest_of(d) + map.rest_of(map.map().alpha(0, d)));
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", x.x(), x.y(), x.z());
}

} // namespace

template <> const Fields<SpringSettings>& fields_of() {
  using S = SpringSettings;
  static const Fields<S> fields{
      field(&S::k, number("k", "", "stiffness of each spring").above(0)), // units: those of each interaction
      field(&S::damping, number("damping", "", "damping of each spring").at_least(0))};
  return fields;
}

double edge_stiffness(const SpringMaterial& m, const EmbeddedMap& map, Dart d) {
  const double E = m.young, nu = m.poisson, h = m.thickness;
  const std::vector<double> side = side_lengths(map, d);
  double k = 0;
  if (side.size() == 3) {
    const double c = side[0], a = side[1], b = side[2], s = (a + b + c) / 2;
    const double area = std::sqrt(std::max(0.0, s * (s - a) * (s - b) * (s - c)));
    if (area > 0)
      k = h * (E / (1 + nu) * area / (c * c) + E * nu / (1 - nu * nu) * (a * a + b * b - c * c) / (8 * area));
  } else {
    const auto [l, w] = sides_of(side);
    k = h * E * (w * w * (3 * nu + 2) - l * l) / (4 * l * w * (1 + nu));
  }
  if (!(k > 0))
    throw std::domain_error(fmt::format("the formula gives the edge at {} the stiffness {:.4g} N/m in its {}",
                                        place_of(map, d), k, side.size() == 3 ? "triangle" : "quad"));
  return k;
}

double diagonal_stiffness(const SpringMaterial& m, const EmbeddedMap& map, Dart d) {
  const std::vector<double> side = side_lengths(map, d);
  const auto [l, w] = sides_of(side);
  return m.thickness * m.young * (l * l + w * w) / (4 * l * w * (1 + m.poisson));
}

StiffnessOf stiffness_of(const InteractionRequest& request, StiffnessFormula formula) {
  const SettingsSource& source = request.settings.source;
  if (request.settings.k) {
    if (request.material && formula)
      source.fail("k", "this spring has a stiffness of its own and a material (young) as well",
                  "leave out k here, or young in <springs>");
    return [k = *request.settings.k](const EmbeddedMap&, Dart) { return k; };
  }
  if (!formula || !request.material)
    source.fail("", fmt::format("<{}> needs its stiffness k", request.element),
                formula ? "give k, or, on a sheet, young, poisson and thickness in <springs>"
                        : "no formula gives this stiffness from young; give k");
  const SpringMaterial material = *request.material;
  const Place place = source.place();
  return [=](const EmbeddedMap& map, Dart d) {
    if (sides_of_face(map.map(), d) > 4)
      throw UserError(Exit::BadInput, place, "stiffness from young is known for triangles and quads alone",
                      "give k, or use other cells");
    try {
      return formula(material, map, d);
    } catch (const std::domain_error& error) {
      throw UserError(
          Exit::BadInput, place, error.what(),
          "a quad's edge may be at most w·sqrt(3·poisson + 2) long, a triangle must not be too obtuse: "
          "use other cells, or give k");
    }
  };
}

void refuse_bend_of_solid(const EmbeddedMap& map, const InteractionRequest& request) {
  if (map.dimension() == 3)
    throw UserError(Exit::BadInput, request.settings.source.place(), "<bend> is for sheets",
                    "a solid resists bending by its volume: leave it out, or add shear or elasticity");
}

bool has_inner_edge(const EmbeddedMap& map) {
  bool found = false;
  map.map().for_each_dart([&](Dart d) { found = found || !map.map().is_free(2, d); });
  return found;
}

} // namespace rend
