#include "sim/mechanics/stretch.h"

#include "sim/mechanics/spring_law.h"
#include "sim/mechanics/spring_stiffness.h"

namespace rend {
namespace {

std::unique_ptr<Interaction> make_stretch(EmbeddedMap& map, const InteractionRequest& request) {
  Pattern pattern{.owner = EdgeOfFace,
                  .support = FaceOfVolume,
                  .units = {{"", "0"}},
                  .fold = {"2"},
                  .present = [](const GMap& m, Dart d, std::size_t) { return !m.is_free(0, d); }};
  if (map.dimension() == 3) pattern.fold.emplace_back("3");
  const StiffnessOf k = stiffness_of(request, &edge_stiffness);
  const double damping = request.settings.damping;
  return make_interaction<1>(
      map, "stretch", spring_law(), pattern, damping,
      [=, surface = request.surface](const EmbeddedMap& body, Dart d, int) {
        if (surface && !body.map().is_free(3, d)) return UnitParameters{};
        const Dart e = body.map().alpha(0, d);
        return UnitParameters{k(body, d), damping, (body.rest_of(e) - body.rest_of(d)).norm()};
      },
      InSeries{.k = request.settings.k.has_value(), .damping = true}); // a material knows the k of any side
}

} // namespace

InteractionType stretch() {
  return {.element = "stretch",
          .kind = "",
          .what = "a spring along each side of each face; an edge between two faces carries two",
          .k_unit = "N/m",
          .make = make_stretch,
          .by_formula = true};
}

} // namespace rend
