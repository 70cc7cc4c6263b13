#include "sim/fracture/fragment_counter.h"

#include "sim/base/archive.h"
#include "sim/base/check.h"
#include "sim/topology/count.h"

#include <algorithm>
#include <numeric>

namespace rend {

void TearEvent::store(Archive& archive) {
  archive(time, step, law);
  archive.unbounded(value);
  archive(dart, place, fragments, born);
  if (!archive.reading()) return;
  refuse_unless(step >= 0 && law >= 0 && fragments >= -1, "a tear has no step, no law, or no fragments");
}

namespace {

std::uint32_t count_labels(const std::vector<std::uint32_t>& labels) {
  std::uint32_t count = 0;
  for (std::uint32_t label : labels)
    if (label != Dart::none_value) count = std::max(count, label + 1);
  return count;
}

} // namespace

void FragmentCounter::begin(const GMap* growing) {
  if (growing && !before_) before_ = count_labels(label_fragments(*growing));
  touched_.fill(0);
  removed_read_ = 0;
}

void FragmentCounter::note(const Journal& journal) {
  CHECK_NOTE(before_ || journal.created.empty(), "this law was not expected to create darts");
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<Dart>& touched = journal.touched[i];
    for (std::size_t n = touched_[i]; n < touched.size(); n += 2)
      pairs_.push_back({touched[n], touched[n + 1]});
    touched_[i] = touched.size();
  }
  removed_.insert(removed_.end(), journal.removed.begin() + static_cast<std::ptrdiff_t>(removed_read_),
                  journal.removed.end());
  removed_read_ = journal.removed.size();
  changes_.push_back({pairs_.size(), removed_.size()});
}

std::uint32_t FragmentCounter::piece_of(std::uint32_t piece) {
  while (parent_[piece] != piece) piece = parent_[piece] = parent_[parent_[piece]];
  return piece;
}

// Returns the number of components before the change minus that after it.
long FragmentCounter::undo(std::size_t change) {
  const Undoing begin = change > 0 ? changes_[change - 1] : Undoing{0, 0}, end = changes_[change];
  long more = 0;
  for (std::size_t n = begin.removed; n < end.removed; ++n, ++more) {
    piece_of_dart_[removed_[n].value] = static_cast<std::uint32_t>(parent_.size());
    parent_.push_back(static_cast<std::uint32_t>(parent_.size()));
  }
  for (std::size_t n = begin.pairs; n < end.pairs; ++n) {
    const std::uint32_t a = piece_of(piece_of_dart_[pairs_[n].first.value]),
                        b = piece_of(piece_of_dart_[pairs_[n].second.value]);
    if (a == b) continue;
    parent_[std::max(a, b)] = std::min(a, b);
    --more;
  }
  return more;
}

void FragmentCounter::settle(const GMap& map, std::span<TearEvent> events) {
  CHECK(events.size() == changes_.size());
  if (events.empty()) return;
  piece_of_dart_ = label_fragments(map);
  const std::uint32_t pieces = count_labels(piece_of_dart_);
  if (before_) return settle_grown(pieces, events);
  parent_.resize(pieces);
  std::iota(parent_.begin(), parent_.end(), 0u);
  long fragments = pieces;
  for (std::size_t n = events.size(); n-- > 0;) {
    const long more = undo(n);
    events[n].fragments = fragments;
    events[n].born = -more;
    fragments += more;
  }
  forget();
}

void FragmentCounter::settle_grown(std::size_t pieces, std::span<TearEvent> events) {
  for (TearEvent& event : events) event.fragments = static_cast<long>(pieces);
  events.back().born = static_cast<long>(pieces) - *before_;
  forget();
}

void FragmentCounter::forget() {
  before_.reset();
  changes_.clear();
  pairs_.clear();
  removed_.clear();
}

} // namespace rend
