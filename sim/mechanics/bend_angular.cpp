#include "sim/mechanics/bend_angular.h"

#include "sim/mechanics/hinge_law.h"
#include "sim/mechanics/young.h"

#include <algorithm>

namespace rend {
namespace {

const std::vector<Word> hinge{"", "0", "10", "010", "2", "20", "210", "2010"};

bool present(const GMap& map, Dart d, std::size_t = 0) {
  if (map.is_free(2, d)) return false;
  const int one = sides_of_face(map, d), two = sides_of_face(map, map.alpha(2, d));
  return one >= 3 && one <= 4 && two >= 3 && two <= 4;
}

std::unique_ptr<Interaction> make(EmbeddedMap& map, const InteractionRequest& request) {
  refuse_bend_of_solid(map, request);
  if (!has_inner_edge(map)) {
    request.notes.push_back("bend was left out: no edge lies between two faces");
    return nullptr;
  }
  const Pattern pattern{
      .owner = EdgeOfVolume, .support = FaceOfVolume, .units = {hinge}, .fold = {}, .present = &present};
  const StiffnessOf k = stiffness_of(request, nullptr);
  const double damping = request.node.number("damping");
  return make_interaction<1>(map, "bend angular", hinge_law(), pattern, damping,
                             [=](const EmbeddedMap& body, Dart d, int) {
                               if (!present(body.map(), d)) return UnitParameters{};
                               const std::vector<Vec3> rest = rest_positions(body, d, hinge);
                               HingePoints x;
                               std::copy(rest.begin(), rest.end(), x.begin());
                               return UnitParameters{k(body, d), damping, hinge_angle(x)};
                             });
}

} // namespace

InteractionType bend_angular() {
  return {"bend", "angular", "an angular spring on each edge between two triangles or quads", "N.m/rad", make};
}

} // namespace rend
