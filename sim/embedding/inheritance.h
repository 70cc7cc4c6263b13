// How the values of new cells follow from those of the cells that they come from (column.h: inherit).
//
// An edit that divides or joins cells records the parents of its new darts (Edit::inherit). When it closes,
// every column whose embedding inherits asks here which of its cells are heirs, and of what. Heirs are, in an
// edit that recorded parents, the cells that birth() would initialise: those of new darts alone, and those
// whose support changed its links; and the parts of a cell that was split.
//
// The parents of a heir:
//   1. If it has darts from before the edit: the cells in which they were, by the number of darts. It is what
//      is left of them. Where elements share: with what was recorded for its other darts, as far as it comes
//      from elements of which neither a dart nor another heir is left.
//   2. Otherwise what was recorded for its smallest dart that has an entry for its own orbit.
//   3. Otherwise the same for an orbit that contains its own and belongs to a cell of the same dimension: a
//      side of a face (EdgeOfFace) takes an entry for Edge, a corner one for Vertex. It then descends from the
//      orbit of its own kind at the parent dart; a corner of an element, from that at the parent's vertex in
//      the element in which it lies, if it has one there. (Not where cells share; see below.)
//   4. Otherwise it has none, and is born.
//
// Inheritance::Share keeps sums: the old value of each parent is divided among its heirs. If the support is the
// element, elements give and take: parents are found for elements as above, and a heir's share of an old
// element is
//
//   f = w A / Σ w A      A: rest area [m²] or volume [m³] of the heirs, w: weight of that parent
//
// which is spread evenly over its cells (its corners, say); the old element has the sum over its own cells. So
// the density of a new element is that of its parents, and the sum over all cells keeps its value to rounding,
// also where faces are warped and areas do not add up. A corner needs no entry of its own. A parent that the
// edit did not change (it was copied) keeps what it has, and A of that parent stands in place of the sum.
// If the support is SingleDart, each cell gives and takes by itself, with A = 1: the fragments of a corner
// share what it had, and a new corner has nothing, unless there is an entry for its own orbit.
//
// Momentum. A vertex that comes to lie between others has the mean of their velocities, but the lumped masses
// around it need not fit: Σ m v is kept for a triangle or a parallelogram that is subdivided, not for other
// quads, and not if a vertex is inserted on one side. So, once masses are inherited, the difference Δp of each
// divided element and its heirs is given back by the same shift of velocity for all their vertices,
//
//   δ = Δp / Σ m_j       m_j: the whole mass of vertex j,
//
// of all shifts with Σ m_j δ_j = Δp that of least Σ m_j δ_j². Angular momentum and energy are not restored.
#pragma once

#include "sim/base/record.h"
#include "sim/embedding/cell_index.h"
#include "sim/embedding/lineage.h"
#include "sim/topology/index_set.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace rend {

class EmbeddedMap;

// Of an embedding: what the weights of the parents mean.
enum class Inheritance {
  Mean, // the weights of one heir sum up to 1
  Share // the weights of all heirs of one parent sum up to 1
};

// The links as they were before the changes of a journal.
class OldLinks {
public:
  explicit OldLinks(const GMap& map) : map_(&map) {} // of an edit that has changed nothing yet
  OldLinks(const GMap& map, const Journal& journal) : OldLinks(map) { note(journal, {}); }

  // Changes of the same edit since `from`, a point up to which all were noted. Those noted before that were
  // taken back since do no harm.
  void note(const Journal& journal, const MapEdit::Savepoint& from);

  Dart alpha(int i, Dart d) const;
  // Replaces `out` by the darts of orbit(d) before the edit, in increasing order.
  void collect(Orbit orbit, Dart d, std::vector<Dart>& out) const;

private:
  const GMap* map_;
  std::array<IndexMap, 4> was_; // dart → αi before, of darts whose αi was touched
};

// The open edit, before its slots are brought up to date.
struct EditRecord {
  const EmbeddedMap& map;
  const Journal& journal;
  const Lineage& lineage;
  const OldLinks& old_links;
};

// The heirs of one kind of orbit with one support. To be made before the slots are brought up to date.
class Heirs {
public:
  Heirs(const EditRecord& record, Orbit orbit, Orbit support, Inheritance by);
  bool serves(Orbit orbit, Orbit support, Inheritance by) const {
    return orbit == orbit_ && support == support_ && by == by_;
  }

  // The cells of the orbit from which somebody inherits: their slots and smallest darts before the edit.
  std::span<const Slot> old_slots() const { return old_slots_; }
  std::span<const Dart> old_darts() const { return old_darts_; }

  // After the slots are up to date.
  void find_slots(const EmbeddedMap& map);
  bool has(Slot slot) const { return is_heir_.contains(slot); }
  template <class F> void each_slot(F&& f) const {
    for (const Heir& heir : heirs_) f(heir.slot);
  }

  // After rest positions are.
  void weigh(const EmbeddedMap& map);

  struct Source {
    std::uint32_t cell; // index in old_slots()
    double weight;
  };
  // Calls f(slot, sources) for every heir; without sources, if there is nothing to divide by.
  template <class F> void each(F&& f) const {
    std::vector<Source> sources;
    std::size_t heir = 0;
    for (std::uint32_t child = 0; child < children_.size(); ++child) {
      if (heir < heirs_.size() && heirs_[heir].child == child) list_sources(child, sources);
      for (; heir < heirs_.size() && heirs_[heir].child == child; ++heir)
        f(heirs_[heir].slot, std::span(sources));
    }
  }

  // Momentum, if the column has masses [kg], one per slot (otherwise empty): before the slots are up to date,
  // and after the masses are; `shift(vertex slot, δ [m/s])` is called at most once for a vertex.
  void note_momentum(const EmbeddedMap& map, std::span<const double> masses);
  template <class F>
  void restore_momentum(const EmbeddedMap& map, std::span<const double> masses, F&& shift) const {
    for (const auto& [vertex, by] : shifts(map, masses)) shift(vertex, by);
  }

private:
  // An old cell (or element, see by_element()), of which there are heirs.
  struct Pool {
    Dart dart;                // one of its darts
    std::uint32_t begin;      // of its cells in old_slots_
    std::uint32_t claims = 0; // children that have darts of it
    bool untouched = false;
    double divisor = 0;
    Vec3 momentum = Vec3::Zero(); // [kg m/s]
  };
  struct Share {
    std::uint32_t pool;
    double weight;
  };
  struct Child {
    Dart dart;                // the smallest
    std::uint32_t begin, end; // of its parents in shares_
    bool own;                 // it has darts from before the edit
    std::uint32_t cells = 1;
    double size = 1;
  };
  struct Heir {
    Slot slot;
    std::uint32_t child;
  };
  class Builder;

  bool by_element() const { return by_ == Inheritance::Share && support_ != SingleDart; }
  std::span<const Share> shares(const Child& child) const {
    return std::span(shares_).subspan(child.begin, child.end - child.begin);
  }
  std::uint32_t end_of(std::size_t pool) const { // of its cells in old_slots_
    return pool + 1 < pools_.size() ? pools_[pool + 1].begin : static_cast<std::uint32_t>(old_slots_.size());
  }
  double measure(const EmbeddedMap& map, Dart d) const;
  void list_sources(std::uint32_t child, std::vector<Source>& sources) const;
  std::vector<std::uint32_t> groups() const;
  std::vector<std::pair<Slot, Vec3>> shifts(const EmbeddedMap& map, std::span<const double> masses) const;

  Orbit orbit_, support_;
  Orbit unit_; // what gives and takes: the orbit, or the element
  Inheritance by_;
  std::vector<Pool> pools_;
  std::vector<Slot> old_slots_;
  std::vector<Dart> old_darts_;
  std::vector<Child> children_;
  std::vector<Share> shares_;
  std::vector<Heir> heirs_; // by child
  IndexSet is_heir_;        // slots
};

} // namespace rend
