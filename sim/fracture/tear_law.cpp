#include "sim/fracture/tear_law.h"

#include "sim/base/archive.h"
#include "sim/base/stop_request.h"
#include "sim/cuts/touched_darts.h"
#include "sim/fracture/counted_change.h"
#include "sim/fracture/split_vertex.h"
#include "sim/topology/index_set.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace rend {

namespace {

// A line for each: "name: what".
template <class T> std::string told(const std::vector<T>& all) {
  std::string out;
  for (const T& each : all) out += (out.empty() ? "" : "\n") + each.name + ": " + each.what;
  return out;
}

// The largest value first, then the smallest dart.
bool has_larger_value(const Candidate& a, const Candidate& b) {
  return a.relative() != b.relative() ? a.relative() > b.relative() : a.dart < b.dart;
}

} // namespace

template <> const Fields<LawSettings>& fields_of() {
  using S = LawSettings;
  constexpr bool required = true;
  static const Fields<S> fields =
      Fields<S>{
          field(&S::criterion, all_criteria(), "criterion", "what is measured\n" + told(all_criteria()),
                required),
          field(
              &S::threshold,
              number(
                  "threshold", "",
                  "the body tears where the criterion's value is larger than this: a force [N], a stress [Pa] "
                  "or a strain (a ratio); rend run PRESET --reach tells which values are reached")
                  .above(0)
                  .is_required()),
          field(&S::kind, word("kind", {"stretch", "shear", "bend"},
                               "which springs are measured: for atomic-spring and strain")),
          field(&S::compression,
                flag("compression", "yes: compression counts as well as tension (for stresses and strains)")),
          field(&S::change, all_changes(), "change",
                "what happens where it tears; every change goes with every criterion (rend help tear says "
                "where it is made); default: the first of these that acts on what the criterion measures\n" +
                    told(all_changes())),
          field(&S::rule, text("rule", "a rule to apply instead of a change: one of this scene, or a built-in "
                                       "one (rend rule list)")),
          field(
              &S::smallest_part,
              number(
                  "smallest-part", "",
                  "of cut: the least part of an element of the start that it leaves, as a share of its area or "
                  "volume; from 0.0625 on, the sine of its least angle too is four times that share of what it "
                  "was. More makes longer steps and a coarser crack")
                  .at_least(0.01)
                  .at_most(0.2)),
          field(&S::from, number("from", "s", "start time; nothing tears before it").at_least(0)),
          field(&S::until, number("until", "s", "end time; without it, to the end of the clip").at_least(0)),
          field(&S::max_per_step,
                integer("max-per-step", "at most N changes per step, worst first; 0 = unlimited").at_least(0)),
          field(
              &S::min_piece,
              number("min-piece", "",
                     "nothing is torn off that has less than this share of the mass of the body; a change that "
                     "would is not made")
                  .at_least(0)
                  .at_most(0.5))} +
      fields_of_part(&S::strength) + fields_of_part(&S::grain);
  return fields;
}

namespace {

// A rule that does not apply where a change is made is tried at the other cells of that kind at the
// candidate's, in the order of their smallest darts: at every border of an element, those of the hull among
// them.
void add_others(const GMap& map, Orbit orbit, std::span<const Dart> cell, std::size_t first, Places& places) {
  thread_local IndexSet seen;
  thread_local std::vector<Dart> own, darts;
  seen.clear();
  const auto add = [&](Dart d) {
    darts.clear();
    collect(map, orbit, d, darts);
    for (Dart e : darts) seen.insert(e.value);
  };
  for (std::size_t place = first; place < places.count(); ++place) add(places.darts(place).front());
  own.assign(cell.begin(), cell.end());
  std::sort(own.begin(), own.end());
  for (Dart d : own) {
    if (seen.contains(d.value)) continue;
    add(d);
    places.add(darts);
  }
}

thread_local TouchedDarts touched;

// Why a change is not asked for at a candidate.
constexpr const char* nothing_there =
    "there is no such cell beside it, or a change of the same step has taken it";
constexpr const char* no_wall = "at walls it parts pieces alone, and no wall is left to part there";

} // namespace

TearLaw::TearLaw(const CriterionRequest& request, const LawSettings& settings)
    : settings_(settings), transfer_(&transfer(settings.cell, settings.change->cell, request.map.dimension())),
      criterion_(settings.criterion->make(request)) {
  if (settings_.min_piece > 0)
    least_piece_.emplace(settings_.min_piece * total_mass(request.map, request.mass));
  if (settings_.change->memory || std::isinf(settings_.threshold)) return;
  const ChangeType& change = *settings_.change; // as a rule, it is one of this law alone then
  settings_.by_rule = change.of_law ? change.of_law(request) : counted(change);
  settings_.change = settings_.by_rule.get();
}

// What it has reached, and what was refused, stays.
void TearLaw::make_anew(const CriterionRequest& request) {
  criterion_ = settings_.criterion->make(request);
  if (const auto& memory = settings_.change->memory) memory->make_anew(request);
}

const std::vector<Candidate>& TearLaw::find(const ForceView& view) {
  candidates_.clear();
  scan(view, settings_.threshold);
  sort_candidates();
  return candidates_;
}

const std::vector<Candidate>& TearLaw::find_and_note(const ForceView& view, double time, bool look) {
  candidates_.clear();
  if (!look && std::isinf(settings_.threshold)) return candidates_;
  if (look && reached_.value < settings_.threshold)
    find_largest(view);
  else
    scan(view, settings_.threshold);
  if (candidates_.empty()) return candidates_;
  note_reached(view, time);
  std::erase_if(candidates_, [&](const Candidate& one) { return !(one.relative() > settings_.threshold); });
  sort_candidates();
  return candidates_;
}

// Adds the candidates above this value.
void TearLaw::scan(const ForceView& view, double above) {
  const Strength* const strength = settings_.by_place.get();
  if (!strength) return criterion_->find(view, above, candidates_);
  criterion_->find(view, above * strength->least(), candidates_);
  strength->weigh(view.map, above, candidates_);
}

void TearLaw::sort_candidates() {
  std::sort(candidates_.begin(), candidates_.end(), &has_larger_value);
}

// Those above the largest value so far. Where nothing has been reached yet, from the threshold downwards: with
// 0 every cell would be a candidate.
void TearLaw::find_largest(const ForceView& view) {
  if (reached_.value > 0 || std::isinf(settings_.threshold)) return scan(view, reached_.value);
  constexpr int most_looks = 24; // down to 2e-22 of the threshold
  constexpr double factor = 1.0 / 8;
  double above = settings_.threshold;
  for (int n = 0; n < most_looks && candidates_.empty(); ++n, above *= factor) scan(view, above);
}

// A law without a threshold (infinity), which only looks, passes over vertices that cannot be split: no
// threshold would tear them.
void TearLaw::note_reached(const ForceView& view, double time) {
  const bool splits = std::isinf(settings_.threshold) && settings_.change->cell == Cell::Vertices;
  if (splits) sort_candidates();
  auto one = splits ? candidates_.begin()
                    : std::min_element(candidates_.begin(), candidates_.end(), &has_larger_value);
  for (; one != candidates_.end() && one->relative() > reached_.value; ++one) {
    left_.clear();
    collect(view.map.map(), orbit_of(settings_.cell, view.map.dimension()), one->dart, left_);
    if (splits && !can_be_split(view, {one->normal, one->value}, left_)) continue;
    reached_ = {one->relative(), time, middle_of(view.map, view.position, left_)};
    return;
  }
}

void Reached::store(Archive& archive) {
  archive(value, time, place);
}

void TearLaw::store(Archive& archive, double now) {
  reached_.store(archive);
  if (archive.reading())
    refuse_unless(reached_.value >= 0 && reached_.time >= 0 && reached_.time <= now,
                  "the largest value of a law is negative, or was reached in the future");
  if (const auto& memory = settings_.change->memory) memory->store(archive);
  if (least_piece_) archive(too_small_);
}

void TearLaw::rebind(const Changes& changes) {
  criterion_->rebind(changes);
  if (settings_.by_place) settings_.by_place->rebind();
  if (const auto& memory = settings_.change->memory) memory->rebind(changes);
}

void TearLaw::reserve_for_separations() {
  criterion_->reserve_for_separations();
  if (const auto& memory = settings_.change->memory) memory->reserve_for_separations();
}

std::size_t TearLaw::bytes() const {
  const auto& memory = settings_.change->memory;
  return criterion_->bytes() + (memory ? memory->bytes() : 0) + candidates_.capacity() * sizeof(Candidate) +
         places_.bytes();
}

Refusals TearLaw::refusals() const {
  Refusals all = settings_.change->memory ? settings_.change->memory->refusals() : Refusals{};
  if (too_small_ > 0) all["it would tear off a piece of less than min-piece of the mass"] = too_small_;
  return all;
}

int TearLaw::apply(EmbeddedMap& map, const ForceView& view, std::vector<TearEvent>& events,
                   FragmentCounter* fragment_counter, const std::function<void()>& before_closing) {
  note_cells(map.map());
  if (transfer_->find) note_places(view);
  int made = 0;
  ChangeMemory* const memory = settings_.change->memory.get();
  if (memory) memory->begin(view);
  touched.clear();
  const std::size_t events_before = events.size();
  const auto change = [&](Edit& edit) {
    if (fragment_counter) fragment_counter->begin(settings_.change->grows ? &map.map() : nullptr);
    for (std::size_t n = 0; n < candidates_.size(); ++n) {
      if (settings_.max_per_step > 0 && made == settings_.max_per_step) break;
      throw_if_stop_is_due();
      is_too_small_ = false;
      const bool done = change_at(edit, view, n);
      const bool is_too_small = !done && is_too_small_; // which is the reason, whatever else was tried
      if (is_too_small) ++too_small_;
      if (memory) memory->settle_candidate(done || is_too_small, otherwise_);
      if (!done) continue;
      events.push_back({.value = candidates_[n].relative(),
                        .dart = candidates_[n].dart,
                        .place = middle_of(map, view.position, cell(n))});
      if (fragment_counter) fragment_counter->note(*edit.journal());
      ++made;
    }
    if (made > 0 && before_closing) before_closing();
  };
  try {
    map.edit(change);
  } catch (...) { // the map is as before
    events.erase(events.begin() + static_cast<std::ptrdiff_t>(events_before), events.end());
    throw;
  }
  return made;
}

// False: it is not possible any more; its cell may have been removed by an earlier change.
bool TearLaw::change_at(Edit& edit, const ForceView& view, std::size_t n) {
  const ChangeType& change = *settings_.change;
  otherwise_ = nothing_there;
  if (!transfer_->find) {
    left_.clear();
    for (Dart d : cell(n))
      if (edit.map().alive(d)) left_.push_back(d);
    return make_change(edit, view, {candidates_[n].normal, candidates_[n].value}, candidates_[n].wall);
  }
  const Orbit orbit = orbit_of(change.cell, edit.map().dimension());
  for (std::size_t place = first_place_[n]; place < first_place_[n + 1]; ++place) {
    grown(edit.map(), orbit, places_.darts(place), left_);
    const FoundPlace found(places_.normal(place), candidates_[n].value);
    if (make_change(edit, view, found, candidates_[n].wall)) return true;
    // The best place of a rule was changed by another candidate: this one has got what it asks for.
    const bool others = change.memory && change.cell != Cell::Vertices && place == first_place_[n];
    if (others && (left_.empty() || touched.any_of(*edit.journal(), left_))) return false;
  }
  return false;
}

// At the darts that are left. What would leave less than the least piece is taken back.
bool TearLaw::make_change(Edit& edit, const ForceView& view, const FoundPlace& found, bool wall) {
  if (left_.empty()) return false;
  if (!least_piece_) return try_change(edit, view, found, wall);
  const Edit::Savepoint before = edit.savepoint();
  if (!try_change(edit, view, found, wall)) return false;
  if (least_piece_->is_kept(edit, before, view)) return true;
  edit.rollback(before);
  is_too_small_ = true;
  return false;
}

// Where the law was exceeded at a wall, it parts pieces alone.
bool TearLaw::try_change(Edit& edit, const ForceView& view, const FoundPlace& found, bool wall) {
  const ChangeType& change = *settings_.change;
  if (wall) otherwise_ = no_wall;
  if (wall && change.cell == Cell::Vertices) return part_pieces(edit, view, found, left_);
  if (wall && !parts_pieces(edit, view, left_)) return false;
  return change.apply(edit, view, found, left_);
}

std::span<const Dart> TearLaw::cell(std::size_t candidate) const {
  return std::span(darts_).subspan(begin_[candidate], begin_[candidate + 1] - begin_[candidate]);
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

void TearLaw::note_places(const ForceView& view) {
  places_.clear();
  first_place_.assign(1, 0);
  for (std::size_t n = 0; n < candidates_.size(); ++n) {
    transfer_->find(view, candidates_[n], cell(n), places_);
    if (settings_.change->memory && settings_.change->cell != Cell::Vertices)
      add_others(view.map.map(), orbit_of(settings_.change->cell, view.map.dimension()), cell(n),
                 first_place_.back(), places_);
    first_place_.push_back(places_.count());
  }
}

} // namespace rend
