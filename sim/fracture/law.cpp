#include "sim/fracture/law.h"

#include <algorithm>

namespace rend {

TearLaw::TearLaw(const CriterionRequest& request, const LawSettings& settings)
    : settings_(settings), criterion_(settings.criterion->make(request)) {}

const std::vector<Candidate>& TearLaw::find(const ForceView& view) {
  candidates_.clear();
  criterion_->find(view, settings_.threshold, candidates_);
  std::sort(candidates_.begin(), candidates_.end(), [](const Candidate& a, const Candidate& b) {
    return a.value != b.value ? a.value > b.value : a.dart < b.dart;
  });
  return candidates_;
}

int TearLaw::apply(EmbeddedMap& map, const ForceView& view, std::vector<TearEvent>& events, Births* births) {
  int made = 0;
  map.edit([&](Edit& edit) {
    if (births) births->begin();
    for (const Candidate& candidate : candidates_) {
      if (settings_.max_per_step > 0 && made == settings_.max_per_step) break;
      if (!map.map().alive(candidate.dart)) continue; // it went with another
      const Vec3 place = middle_of(map, view.position, settings_.cell, candidate.dart);
      if (!settings_.change->apply(edit, view, settings_.cell, candidate)) continue;
      events.push_back({.value = candidate.value, .dart = candidate.dart, .place = place});
      if (births) births->note(*edit.journal());
      ++made;
    }
  });
  return made;
}

} // namespace rend
