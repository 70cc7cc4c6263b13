#include "sim/fracture/tear_law.h"

#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

namespace {

// "name: what; name: what"
template <class T> std::string told(const std::vector<T>& all) {
  std::string out;
  for (const T& each : all) out += (out.empty() ? "" : "; ") + each.name + ": " + each.what;
  return out;
}

} // namespace

template <> const Fields<LawSettings>& fields_of() {
  using S = LawSettings;
  constexpr bool required = true;
  static const Fields<S> fields{
      field(&S::criterion, all_criteria(), "criterion", told(all_criteria()), required),
      field(&S::threshold,
            number("threshold", "",
                   "the value above which it tears, in newtons, of stresses in pascals, of strains a ratio; a "
                   "low one and rend run --events tell what is reached")
                .above(0)
                .is_required()),
      field(&S::kind, word("kind", {"stretch", "shear", "bend"}, "of springs: which of them are measured")),
      field(&S::compression,
            flag("compression", "principal stresses and strains count in compression as well")),
      field(&S::change, all_changes(), "change",
            "what is done; default: that of the cell which the criterion measures; " + told(all_changes())),
      field(&S::from, number("from", "s", "not before").at_least(0)),
      field(&S::until, number("until", "s", "not after").at_least(0)),
      field(&S::max_per_step, integer("max-per-step", "the worst so many a step; 0: all").at_least(0))};
  return fields;
}

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

int TearLaw::apply(EmbeddedMap& map, const ForceView& view, std::vector<TearEvent>& events,
                   FragmentCounter* fragment_counter) {
  note_cells(map.map());
  int made = 0;
  map.edit([&](Edit& edit) {
    if (fragment_counter) fragment_counter->begin();
    for (std::size_t n = 0; n < candidates_.size(); ++n) {
      if (settings_.max_per_step > 0 && made == settings_.max_per_step) break;
      const std::span<const Dart> cell(darts_.data() + begin_[n], begin_[n + 1] - begin_[n]);
      left_.clear();
      for (Dart d : cell)
        if (map.map().alive(d)) left_.push_back(d);
      if (left_.empty()) continue; // the cell was removed by an earlier change
      if (!settings_.change->apply(edit, view, settings_.cell, candidates_[n], left_)) continue;
      events.push_back({.value = candidates_[n].value,
                        .dart = candidates_[n].dart,
                        .place = middle_of(map, view.position, cell)});
      if (fragment_counter) fragment_counter->note(*edit.journal());
      ++made;
    }
  });
  return made;
}

// The change of a candidate must not depend on whether an earlier change removed the cell's smallest dart.
void TearLaw::note_cells(const GMap& map) {
  const Orbit orbit = orbit_of(settings_.cell, map.dimension());
  darts_.clear();
  begin_.assign(1, 0);
  for (const Candidate& candidate : candidates_) {
    collect(map, orbit, candidate.dart, darts_);
    begin_.push_back(darts_.size());
  }
}

} // namespace rend
