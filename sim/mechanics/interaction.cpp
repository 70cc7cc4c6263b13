#include "sim/mechanics/interaction.h"

#include "sim/mechanics/bend_angular.h"
#include "sim/mechanics/bend_provot.h"
#include "sim/mechanics/shear_face.h"
#include "sim/mechanics/shear_volume.h"
#include "sim/mechanics/stretch.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

const std::vector<InteractionType>& all_interactions() {
  static const std::vector<InteractionType> list{stretch(),
                                                 shear_face_isotropic(),
                                                 shear_face_anisotropic(),
                                                 shear_volume_isotropic(),
                                                 shear_volume_anisotropic(),
                                                 bend_provot(),
                                                 bend_angular()};
  return list;
}

std::string InteractionType::damping_unit() const {
  std::string unit = k_unit;
  return unit.insert(std::min(unit.find('/'), unit.size()), ".s");
}

bool leave_out(const InteractionRequest& request, std::string why) {
  request.notes.push_back(std::move(why));
  return !request.awaited;
}

void for_each_face(const EmbeddedMap& body, const std::function<void(Dart)>& f) {
  std::vector<char> seen(body.map().capacity(), 0);
  body.map().for_each_dart([&](Dart d) {
    if (seen[d.value]) return;
    walk_two(body.map(), 0, 1, d, [&](Dart e) { seen[e.value] = 1; });
    f(d);
  });
}

std::vector<Vec3> rest_positions(const EmbeddedMap& body, Dart d, const std::vector<Word>& unit) {
  std::vector<Vec3> points;
  points.reserve(unit.size());
  for (const Word& word : unit) points.push_back(body.rest_of(body.map().follow(d, word)));
  return points;
}

} // namespace rend
