// A law of tearing: a criterion, a threshold and a change, freely combined where their places fit (thesis 7.1).
//
// All candidates of a law are found on the unchanged map; then the changes are made in order, the largest value
// first, ties by smallest dart, each checked again for being still possible; and the map is brought up to date
// once.
#pragma once

#include "sim/base/settings.h"
#include "sim/fracture/births.h"
#include "sim/fracture/change.h"
#include "sim/fracture/criterion.h"

#include <limits>

namespace rend {

struct LawSettings {
  const CriterionType* criterion = nullptr; // one of all_criteria()
  double threshold = 0;                     // in the criterion's unit
  std::string kind = {};                    // of springs: CriterionRequest
  bool compression = false;
  const ChangeType* change = nullptr; // one of all_changes(); null: that of the criterion's cell
  double from = 0, until = std::numeric_limits<double>::infinity(); // [s]
  int max_per_step = 0;                                             // 0: any number
  SettingsSource source = {};

  // Found when it is put on a body.
  Cell cell = Cell::Borders; // of the criterion
  std::string unit = {};     // of the threshold

  bool elementary() const { return criterion->elementary || change->elementary(cell); }
  bool by_sums() const { return criterion->by_sums && !change->elementary(cell); }
};

template <> const Fields<LawSettings>& fields_of();

class TearLaw {
public:
  TearLaw(const CriterionRequest& request, const LawSettings& settings);

  const LawSettings& settings() const { return settings_; }
  bool active(double time) const { return time >= settings_.from && time <= settings_.until; }

  // What exceeds the threshold, sorted. Looks, and changes nothing.
  const std::vector<Candidate>& find(const ForceView& view);

  // Makes the changes that find() asked for. Returns how many were made; appends an event for each, and what it
  // undid to `births`, if there is one.
  int apply(EmbeddedMap& map, const ForceView& view, std::vector<TearEvent>& events, Births* births = nullptr);

  void rebind(const Changes& changes) { criterion_->rebind(changes); }
  void reserve_for_separations() { criterion_->reserve_for_separations(); }
  std::size_t bytes() const { return criterion_->bytes() + candidates_.capacity() * sizeof(Candidate); }

private:
  void note_cells(const GMap& map);
  LawSettings settings_;
  std::unique_ptr<Criterion> criterion_;
  std::vector<Candidate> candidates_;
  std::vector<Dart> darts_;        // of the candidates' cells before the edit, one cell after another
  std::vector<std::size_t> begin_; // of each in darts_
  std::vector<Dart> left_;         // scratch: of one cell, those that are left
};

} // namespace rend
