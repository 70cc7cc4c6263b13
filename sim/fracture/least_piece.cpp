#include "sim/fracture/least_piece.h"

#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

bool LeastPiece::is_kept(const Edit& edit, const Edit::Savepoint& since, const ForceView& view) {
  const Journal& journal = *edit.journal();
  seen_.clear();
  search_ = 0;
  for (std::size_t i = 0; i < journal.touched.size(); ++i)
    for (std::size_t n = since.map.touched[i]; n < journal.touched[i].size(); ++n) {
      const Dart d = journal.touched[i][n];
      if (!edit.map().alive(d) || seen_.find(d.value) != IndexMap::none) continue;
      if (!is_reached_from(d, edit, view)) return false;
      ++search_;
    }
  return true;
}

// Whether that mass is connected to a dart; so it is where the search comes to a part that has it.
bool LeastPiece::is_reached_from(Dart start, const Edit& edit, const ForceView& view) {
  const GMap& map = edit.map();
  const int across = map.dimension();
  queue_.clear();
  double mass = enter(start, edit, view);
  for (std::size_t next = 0; next < queue_.size() && mass < mass_; ++next) {
    const Dart beyond = map.alpha(across, queue_[next]);
    const std::uint32_t search = seen_.find(beyond.value);
    if (search == IndexMap::none)
      mass += enter(beyond, edit, view);
    else if (search != search_)
      return true;
  }
  return mass >= mass_;
}

// The mass of an element, whose darts are seen from now on [kg].
double LeastPiece::enter(Dart d, const Edit& edit, const ForceView& view) {
  element_.clear();
  collect(edit.map(), element_orbit(edit.map().dimension()), d, element_);
  for (Dart e : element_) seen_.insert(e.value, search_);
  queue_.insert(queue_.end(), element_.begin(), element_.end());
  if (std::ranges::any_of(element_, [&](Dart e) { return edit.is_new(e); })) return 0;
  const CellIndex& corners = view.map.cells(view.mass.orbit());
  double mass = 0;
  for (Dart e : element_) {
    const Slot corner = corners.slot(e);
    if (corners.first_dart(corner) == e) mass += view.mass[corner];
  }
  return mass;
}

} // namespace rend
