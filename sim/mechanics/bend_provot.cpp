#include "sim/mechanics/bend_provot.h"

#include "sim/mechanics/spring_law.h"
#include "sim/mechanics/spring_stiffness.h"

namespace rend {
namespace {

const std::vector<Word> far_ends{"10", "210"};

bool is_strip(const GMap& map, Dart d, std::size_t = 0) {
  if (map.is_free(2, d)) return false;
  const Dart left = map.alpha(1, d), right = map.alpha(1, map.alpha(2, d));
  return !map.is_free(0, left) && !map.is_free(0, right) && left != d && right != map.alpha(2, d);
}

std::unique_ptr<Interaction> make_provot(EmbeddedMap& map, const InteractionRequest& request) {
  refuse_bend_of_solid(map, request);
  const bool there = has_inner_edge(map);
  if (!there && leave_out(request, "bend was left out: no edge lies between two faces")) return nullptr;
  Pattern pattern{.owner = EdgeEndOfVolume,
                  .support = FaceOfVolume,
                  .units = {far_ends},
                  .fold = {"0", "121"},
                  .present = &is_strip};
  const StiffnessOf k = stiffness_of(request, nullptr);
  const double damping = request.settings.damping;
  return make_or_await<1>(map, there, request, "bend provot", spring_law(), pattern,
                          [=](const EmbeddedMap& body, Dart d, int) {
                            const std::vector<Vec3> x = rest_positions(body, d, far_ends);
                            return UnitParameters{k(body, d), damping, (x[1] - x[0]).norm()};
                          });
}

} // namespace

InteractionType bend_provot() {
  return {"bend", "provot", "springs across two edges that lie one behind the other, between their far ends",
          "N/m", make_provot};
}

} // namespace rend
