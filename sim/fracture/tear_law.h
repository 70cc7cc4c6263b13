// A fracture law: a criterion, a threshold and a change, combined freely (thesis 7.1). Where the criterion
// measures cells of another kind than the change acts on, transfer.h says at which.
//
// Where its strength differs from place to place (strength.h), the largest value and those of events are
// relative to it, so that they can be compared with the threshold.
//
// A law also remembers the largest value that its criterion has reached, so that a threshold can be chosen: at
// the steps at which it is told to look, it asks the criterion for what exceeds the largest value so far
// instead of the threshold, which a criterion's bounds keep cheap (criterion.h: find()). What exceeds the
// threshold is known at every step anyway.
//
// All candidates of a law, and the places where they would change the map, are found on the unchanged map; then
// the changes are made in order, the largest value first, ties by smallest dart, each checked again for being
// possible; and the embeddings are updated once.
#pragma once

#include "sim/base/settings.h"
#include "sim/fracture/change.h"
#include "sim/fracture/criterion.h"
#include "sim/fracture/fragment_counter.h"
#include "sim/fracture/least_piece.h"
#include "sim/fracture/strength.h"
#include "sim/fracture/transfer.h"

#include <limits>
#include <memory>

namespace rend {

struct LawSettings {
  const CriterionType* criterion = nullptr; // one of all_criteria()
  double threshold = 0;                     // in the criterion's unit
  std::string kind = {};                    // of springs: CriterionRequest
  bool compression = false;
  const ChangeType* change = nullptr; // one of all_changes(); null: that of the criterion's cell
  std::string rule = {};              // instead of a change: the name of a rule; empty: none
  double smallest_part = LeastPart{}.size;
  StrengthSettings strength = {};
  GrainSettings grain = {};
  double from = 0, until = std::numeric_limits<double>::infinity(); // [s]
  int max_per_step = 0;                                             // 0: any number
  double min_piece = 0; // of what is torn off, the least share of the mass; 0: any
  SettingsSource source = {};

  // Found when it is put on a body.
  Cell cell = Cell::Borders;                      // of the criterion
  std::string unit = {};                          // of the threshold
  std::shared_ptr<const ChangeType> by_rule = {}; // what `change` is then
  std::shared_ptr<Strength> by_place = {};        // null: the same everywhere
};

template <> const Fields<LawSettings>& fields_of();

// The largest value of a criterion at the steps at which its law has looked.
struct Reached {
  double value = 0;          // in the criterion's unit; 0: nothing above 0 was found
  double time = 0;           // [s]
  Vec3 place = Vec3::Zero(); // [m], the middle of the cell
  void store(Archive& archive);
};

class TearLaw {
public:
  TearLaw(const CriterionRequest& request, const LawSettings& settings);
  void make_anew(const CriterionRequest& request); // for a body that has got further interactions

  const LawSettings& settings() const { return settings_; }
  // Values are divided by the strength of their place.
  bool differs_by_strength() const { return settings_.by_place && settings_.by_place->differs(); }
  bool active(double time) const { return time >= settings_.from && time <= settings_.until; }

  // Needs the forces of each element by itself; they are enough where ForceView::corner_buffer says so.
  bool elementary() const { return settings_.criterion->elementary || transfer_->find; }
  bool by_sums() const { return settings_.criterion->by_sums && !transfer_->find; }

  // The candidates above the threshold, sorted. Changes nothing.
  const std::vector<Candidate>& find(const ForceView& view);
  // The same at a time [s] of the run: what is above the largest value so far is noted. `look`: also where that
  // is below the threshold.
  const std::vector<Candidate>& find_and_note(const ForceView& view, double time, bool look);
  const Reached& reached() const { return reached_; }
  void restore_reached(const Reached& before) { reached_ = before; } // of a state that is returned to
  // Of candidates at which the change was not possible, at every step again.
  Refusals refusals() const;
  // What was reached, and refusals; nothing is reached later than now [s].
  void store(Archive& archive, double now);

  // Makes the changes at the candidates of find(). Returns how many were made; appends an event for each, and
  // notes it in `fragment_counter` if given. `before_closing` is called once if any were made, while all values
  // and rows are still those before.
  int apply(EmbeddedMap& map, const ForceView& view, std::vector<TearEvent>& events,
            FragmentCounter* fragment_counter = nullptr, const std::function<void()>& before_closing = {});

  void rebind(const Changes& changes);
  void reserve_for_separations();
  std::size_t bytes() const;

private:
  void scan(const ForceView& view, double above);
  void sort_candidates();
  void find_largest(const ForceView& view);
  void note_reached(const ForceView& view, double time);
  void note_cells(const GMap& map);
  void note_places(const ForceView& view);
  std::span<const Dart> cell(std::size_t candidate) const;
  bool change_at(Edit& edit, const ForceView& view, std::size_t candidate);
  bool make_change(Edit& edit, const ForceView& view, const FoundPlace& found, bool wall);
  bool try_change(Edit& edit, const ForceView& view, const FoundPlace& found, bool wall);

  LawSettings settings_;
  const Transfer* transfer_;
  std::unique_ptr<Criterion> criterion_;
  std::vector<Candidate> candidates_;
  Reached reached_;
  std::vector<Dart> darts_;        // of the candidates' cells before the edit, cell by cell
  std::vector<std::size_t> begin_; // first entry of each candidate in darts_
  Places places_;                  // of all candidates, before the edit; empty if the cells are the places
  std::vector<std::size_t> first_place_;  // of each candidate in places_
  std::vector<Dart> left_;                // scratch: the darts of one cell that still exist
  const char* otherwise_ = nullptr;       // why the change was not asked for at the current candidate
  std::optional<LeastPiece> least_piece_; // none: what is torn off may have any mass
  std::uint64_t too_small_ = 0;           // candidates at which it was less
  bool is_too_small_ = false;             // it was at a place of the candidate that is tried
};

} // namespace rend
