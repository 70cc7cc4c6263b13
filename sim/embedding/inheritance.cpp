#include "sim/embedding/inheritance.h"

#include "sim/embedding/cell_size.h"
#include "sim/embedding/embedded_map.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <numeric>

namespace rend {

void OldLinks::note(const Journal& journal, const MapEdit::Savepoint& from) {
  thread_local IndexMap since;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::vector<Dart>& touched = journal.touched[i];
    if (touched.size() == from.touched[i]) continue;
    since.clear();
    const bool first = was_[i].size() == 0;
    IndexMap& then = first ? was_[i] : since; // the links at `from`
    const auto link_of = [&](Dart d) {
      const std::uint32_t known = then.find(d.value);
      return known != IndexMap::none ? Dart{known} : map_->alive(d) ? map_->alpha(static_cast<int>(i), d) : d;
    };
    // Backwards: each pair is found as its change left it (map_edit.h).
    for (std::size_t n = touched.size(); n > from.touched[i]; n -= 2) {
      const Dart a = touched[n - 2], b = touched[n - 1];
      const bool linked = link_of(a) == b;
      then.assign(a.value, linked ? a.value : b.value);
      then.assign(b.value, linked ? b.value : a.value);
    }
    for (std::size_t n = from.touched[i]; n < touched.size() && !first; ++n)
      was_[i].insert(touched[n].value, then.find(touched[n].value));
  }
}

Dart OldLinks::alpha(int i, Dart d) const {
  const std::uint32_t was = was_[static_cast<std::size_t>(i)].find(d.value);
  if (was != IndexMap::none) return Dart{was};
  return map_->alive(d) ? map_->alpha(i, d) : d; // removed, and free before
}

void OldLinks::collect(Orbit orbit, Dart d, std::vector<Dart>& out) const {
  thread_local IndexSet seen;
  seen.clear();
  seen.insert(d.value);
  out.assign(1, d);
  for (std::size_t at = 0; at < out.size(); ++at)
    for (int i = 0; i < 4; ++i) {
      if (!orbit.has(i)) continue;
      const Dart next = alpha(i, out[at]);
      if (seen.insert(next.value)) out.push_back(next);
    }
  std::sort(out.begin(), out.end());
}

namespace {

constexpr std::uint32_t no_pool = IndexMap::none;

// Kept between edits to avoid allocation.
struct Scratch {
  IndexMap pool_of; // of a dart (where elements share) or a slot
  IndexSet gone;    // removed darts; those that were used again belong to new cells
  IndexSet seen;    // darts
  std::vector<Dart> region, unit, old;
  std::vector<Dart> element; // of corners: the darts, before the edit, of that in which a new one lies
  void clear() {
    pool_of.clear();
    gone.clear();
    seen.clear();
  }
};
thread_local Scratch scratch;

Orbit united(Orbit a, Orbit b) {
  a.mask = static_cast<std::uint8_t>(a.mask | b.mask);
  return a;
}

// The orbits in which to look for the parents of an orbit: itself, then those that contain it and belong to a
// cell of the same dimension, smaller ones first.
std::vector<Orbit> entries_for(Orbit orbit) {
  std::vector<Orbit> all{orbit};
  Orbit cell; // the largest
  if (orbit.has(0) && orbit.has(1))
    cell = orbit.has(2) ? Volume : Face;
  else if (orbit.has(0))
    cell = Edge;
  else if (orbit.has(1))
    cell = Vertex;
  for (int mask = 0; mask < orbit_kinds; ++mask) {
    Orbit other;
    other.mask = static_cast<std::uint8_t>(mask);
    if (other != orbit && united(other, orbit) == other && united(other, cell) == cell) all.push_back(other);
  }
  return all;
}

} // namespace

class Heirs::Builder {
public:
  Builder(Heirs& heirs, const EditRecord& record)
      : my_(heirs), record_(record), map_(record.map.map()), cells_(record.map.cells(heirs.orbit_)),
        entries_(heirs.by_ == Inheritance::Share && !heirs.by_element() ? std::vector{heirs.orbit_}
                                                                        : entries_for(heirs.unit_)),
        corners_(heirs.by_ == Inheritance::Mean &&
                 united(heirs.orbit_, EdgeOfFace) == element_orbit(map_.dimension()) && !heirs.orbit_.has(0)) {}

  void run() {
    scratch.clear();
    for (const Dart d : record_.journal.removed) scratch.gone.insert(d.value);
    const Orbit region = united(my_.orbit_, my_.support_);
    for (int i = 0; i < 4; ++i)
      if (region.has(i))
        for (const Dart d : record_.journal.touched[static_cast<std::size_t>(i)]) visit(region, d);
    for (const Dart d : record_.journal.created) visit(region, d);
    if (my_.by_element() && !record_.journal.removed.empty()) pass_on_what_is_lost();
    for (Pool& pool : my_.pools_)
      pool.untouched = map_.alive(pool.dart) && !scratch.seen.contains(pool.dart.value);
    if (my_.support_ == SingleDart) keep_whole_cells();
  }

private:
  void visit(Orbit region, Dart d);
  void keep_whole_cells();
  void add_child();
  void add_own_parents(Child& child);
  void add_recorded_parents(Child& child);
  void find_element();
  Dart corner_at(Dart parent) const;
  void pass_on_what_is_lost();
  bool add_lost_parents(const Child& child, std::size_t claimed);
  void add_share(const Child& child, std::uint32_t pool, double weight);
  std::uint32_t pool_at(Dart d);
  std::uint32_t new_pool(Dart d);

  Heirs& my_;
  const EditRecord& record_;
  const GMap& map_;
  const CellIndex& cells_;           // as before the edit
  const std::vector<Orbit> entries_; // where parents are looked up
  const bool corners_;               // the orbits are corners of elements, which do not share
};

void Heirs::Builder::visit(Orbit region, Dart d) {
  if (!map_.alive(d) || scratch.seen.contains(d.value)) return;
  scratch.region.clear();
  collect(map_, region, d, scratch.region);
  for (const Dart e : scratch.region) {
    if (scratch.seen.contains(e.value)) continue;
    scratch.unit.clear();
    collect(map_, my_.unit_, e, scratch.unit);
    for (const Dart f : scratch.unit) scratch.seen.insert(f.value);
    add_child();
  }
}

void Heirs::Builder::add_child() {
  std::sort(scratch.unit.begin(), scratch.unit.end());
  const auto begin = static_cast<std::uint32_t>(my_.shares_.size());
  Child child{scratch.unit.front(), begin, begin, false};
  add_own_parents(child);
  child.own = my_.shares_.size() > begin;
  if (!child.own) add_recorded_parents(child);
  child.end = static_cast<std::uint32_t>(my_.shares_.size());
  if (child.end > begin) my_.children_.push_back(child);
}

void Heirs::Builder::add_own_parents(Child& child) {
  double darts = 0;
  for (const Dart d : scratch.unit) {
    if (scratch.gone.contains(d.value) || cells_.find(d) == no_slot) continue;
    add_share(child, pool_at(d), 1);
    darts += 1;
  }
  for (std::size_t n = child.begin; n < my_.shares_.size(); ++n) {
    my_.shares_[n].weight /= darts;
    ++my_.pools_[my_.shares_[n].pool].claims;
  }
}

void Heirs::Builder::add_recorded_parents(Child& child) {
  for (const Orbit orbit : entries_)
    for (const Dart d : scratch.unit) {
      const auto parents = record_.lineage.parents(d, orbit);
      if (!parents) continue;
      const bool in_element = corners_ && orbit != my_.orbit_;
      if (in_element) find_element();
      for (const Parent& parent : *parents)
        add_share(child, pool_at(in_element ? corner_at(parent.dart) : parent.dart), parent.weight);
      return;
    }
}

// The element in which the cell that is born lies; without darts if nothing was recorded.
void Heirs::Builder::find_element() {
  scratch.element.clear();
  const Orbit orbit = element_orbit(map_.dimension());
  for (const Dart d : scratch.unit)
    if (const auto parents = record_.lineage.parents(d, orbit); parents && !parents->empty())
      return record_.old_links.collect(orbit, parents->front().dart, scratch.element);
}

// A dart of its corner at the vertex of a parent; the parent itself, where it has none there.
Dart Heirs::Builder::corner_at(Dart parent) const {
  if (std::ranges::binary_search(scratch.element, parent)) return parent;
  const CellIndex& vertices = record_.map.cells(Vertex);
  const auto found =
      std::ranges::find(scratch.element, vertices.slot(parent), [&](Dart d) { return vertices.slot(d); });
  return found == scratch.element.end() ? parent : *found;
}

// Elements of which no dart is left, and that nobody has claimed, give to those heirs whose new darts descend
// from them, by the number of these darts: an edge that is flipped at each side of a triangle removes them all.
void Heirs::Builder::pass_on_what_is_lost() {
  const std::size_t claimed = my_.pools_.size();
  std::vector<Share> before;
  before.swap(my_.shares_);
  for (Child& child : my_.children_) {
    const std::uint32_t first = child.begin, last = child.end;
    child.begin = static_cast<std::uint32_t>(my_.shares_.size());
    my_.shares_.insert(my_.shares_.end(), before.begin() + first, before.begin() + last);
    if (child.own && add_lost_parents(child, claimed)) {
      double sum = 0;
      for (std::size_t n = child.begin; n < my_.shares_.size(); ++n) sum += my_.shares_[n].weight;
      for (std::size_t n = child.begin; n < my_.shares_.size(); ++n) my_.shares_[n].weight /= sum;
    }
    child.end = static_cast<std::uint32_t>(my_.shares_.size());
  }
}

// Whether there are any. `claimed`: number of pools that have heirs without this.
bool Heirs::Builder::add_lost_parents(const Child& child, std::size_t claimed) {
  scratch.unit.clear();
  collect(map_, my_.unit_, child.dart, scratch.unit);
  const auto is_old = [&](Dart d) { return !scratch.gone.contains(d.value) && cells_.find(d) != no_slot; };
  const auto old = static_cast<double>(std::count_if(scratch.unit.begin(), scratch.unit.end(), is_old));
  bool any = false;
  for (const Dart d : scratch.unit) {
    if (is_old(d)) continue;
    const auto parents = record_.lineage.parents(d, my_.unit_);
    if (!parents) continue;
    for (const Parent& parent : *parents) {
      if (!scratch.gone.contains(parent.dart.value)) continue;
      const std::uint32_t pool = pool_at(parent.dart);
      if (pool < claimed) continue;
      add_share(child, pool, parent.weight / old);
      any = true;
    }
  }
  return any;
}

void Heirs::Builder::add_share(const Child& child, std::uint32_t pool, double weight) {
  for (std::size_t n = child.begin; n < my_.shares_.size(); ++n)
    if (my_.shares_[n].pool == pool) {
      my_.shares_[n].weight += weight;
      return;
    }
  my_.shares_.push_back({pool, weight});
}

std::uint32_t Heirs::Builder::pool_at(Dart d) {
  const std::uint32_t key = my_.by_element() ? d.value : cells_.slot(d);
  const std::uint32_t known = scratch.pool_of.find(key);
  return known != IndexMap::none ? known : new_pool(d);
}

std::uint32_t Heirs::Builder::new_pool(Dart d) {
  const auto pool = static_cast<std::uint32_t>(my_.pools_.size());
  my_.pools_.push_back({.dart = d, .begin = static_cast<std::uint32_t>(my_.old_slots_.size())});
  const auto add = [&](Slot slot) {
    my_.old_slots_.push_back(slot);
    my_.old_darts_.push_back(cells_.first_dart(slot));
  };
  if (!my_.by_element()) {
    scratch.pool_of.insert(cells_.slot(d), pool);
    add(cells_.slot(d));
    return pool;
  }
  record_.old_links.collect(my_.unit_, d, scratch.old);
  for (const Dart e : scratch.old) {
    scratch.pool_of.insert(e.value, pool);
    if (cells_.first_dart(cells_.slot(e)) == e) add(cells_.slot(e));
  }
  return pool;
}

// What has its support in itself keeps its value unless it was split: its policies for births and merges apply.
void Heirs::Builder::keep_whole_cells() {
  std::erase_if(my_.children_, [&](const Child& child) {
    const auto parents = my_.shares(child);
    return child.own && (parents.size() > 1 || my_.pools_[parents.front().pool].claims == 1);
  });
}

Heirs::Heirs(const EditRecord& record, Orbit orbit, Orbit support, Inheritance by)
    : orbit_(orbit), support_(support), unit_(orbit), by_(by) {
  if (by_element()) unit_ = support;
  Builder(*this, record).run();
}

void Heirs::find_slots(const EmbeddedMap& map) {
  const CellIndex& cells = map.cells(orbit_);
  std::vector<Dart> darts;
  for (std::uint32_t n = 0; n < children_.size(); ++n) {
    Child& child = children_[n];
    const std::size_t begin = heirs_.size();
    darts.assign(1, child.dart);
    if (by_element()) {
      darts.clear();
      collect(map.map(), unit_, child.dart, darts);
    }
    for (const Dart d : darts)
      if (const Slot slot = cells.slot(d); is_heir_.insert(slot)) heirs_.push_back({slot, n});
    child.cells = static_cast<std::uint32_t>(heirs_.size() - begin);
  }
}

double Heirs::measure(const EmbeddedMap& map, Dart d) const {
  if (!by_element() || support_ != element_orbit(map.dimension())) return 1;
  if (map.dimension() == 3) return rest_volume(map, d);
  return sides_of_face(map.map(), d) == 0 ? 0 : rest_area(map, d);
}

void Heirs::weigh(const EmbeddedMap& map) {
  if (by_ == Inheritance::Mean) return;
  for (Pool& pool : pools_) pool.divisor = pool.untouched ? measure(map, pool.dart) : 0;
  for (Child& child : children_) {
    child.size = measure(map, child.dart);
    for (const Share& share : shares(child))
      if (Pool& pool = pools_[share.pool]; !pool.untouched) pool.divisor += share.weight * child.size;
  }
}

void Heirs::list_sources(std::uint32_t child, std::vector<Source>& sources) const {
  sources.clear();
  for (const Share& share : shares(children_[child])) {
    const Pool& pool = pools_[share.pool];
    double weight = share.weight;
    if (by_ == Inheritance::Share) {
      if (!(pool.divisor > 0)) return sources.clear();
      weight *= children_[child].size / pool.divisor / children_[child].cells;
    }
    for (std::uint32_t cell = pool.begin; cell < end_of(share.pool); ++cell) sources.push_back({cell, weight});
  }
}

} // namespace rend
