#include "sim/fracture/law.h"

#include <algorithm>

namespace rend {

TearLaw::TearLaw(EmbeddedMap& map, const LawSettings& settings)
    : settings_(settings), criterion_(settings.criterion->make(map)) {}

const std::vector<Candidate>& TearLaw::find(const ForceView& view) {
  candidates_.clear();
  criterion_->find(view, settings_.threshold, candidates_);
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return a.value != b.value ? a.value > b.value : a.dart < b.dart;
  });
  return candidates_;
}

int TearLaw::apply(EmbeddedMap& map, const ForceView& view, std::vector<TearEvent>& events) {
  int made = 0;
  map.edit([&](Edit& edit) {
    for (const Candidate& candidate : candidates_) {
      if (settings_.max_per_step > 0 && made == settings_.max_per_step) break;
      const Vec3 a = view.position[map.vertex(candidate.dart)];
      const Vec3 b = view.position[map.vertex(map.map().alpha(0, candidate.dart))];
      if (!settings_.change->apply(edit, view, candidate)) continue;
      events.push_back({0, 0, 0, candidate.value, candidate.dart, 0.5 * (a + b)});
      ++made;
    }
  });
  return made;
}

} // namespace rend
