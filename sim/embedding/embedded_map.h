// A map with its embedded values. Its only writer is edit():
//
//   body.edit([&](Edit& edit) { unsew(edit, 2, dart); });
//
// While the scope is open the map changes and a journal records it; when it closes, the slots of every orbit in
// use are updated once, visiting touched darts alone, and every column applies its policies. Only orbits that
// were asked for (use()) have slots. Derived data (rows, surfaces) subscribes to Changes.
//
// An edit is atomic. Whatever throws, in the scope or in a policy while it closes, takes back all that was
// done: links, slots, values and both kinds of free lists are as before to the last byte, subscribers see no
// change, and the next edit may follow. A part of an edit can be taken back as well (Edit::savepoint). A change
// is undone by what the journal and the events of slots say of it (map_edit.h, cell_index.h), and by copies of
// the values that were overwritten. A separation overwrites none, and costs what it did without.
#pragma once

#include "sim/embedding/column.h"
#include "sim/embedding/lineage.h"
#include "sim/topology/gmap.h"
#include "sim/topology/index_set.h"
#include "sim/topology/map_edit.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace rend {

// The initial state of a vertex.
struct Point {
  Vec3 position = Vec3::Zero(); // [m]
  Vec3 rest = Vec3::Zero();     // [m]
  Vec3 velocity = Vec3::Zero(); // [m/s]
};

// Position, rest position and velocity belong to vertices and are copied to every fragment of a split vertex.
struct VertexRecord {
  using Value = Record;
  std::string name;
  Orbit orbit = Vertex;
  Orbit support = SingleDart;
  Value birth(const EmbeddedMap&, Dart) const { return {}; } // Edit::give fills it in
  Value split(const Value& whole) const { return whole; }
  Value merge(const Value& kept, const Value&) const { return kept; }
};
using VertexColumn = Column<VertexRecord>;

// What has changed since a subscriber last read it: enough to find every row that may differ.
struct Changes {
  std::array<std::vector<Dart>, 4> touched;         // [i]: darts whose αi changed
  std::array<std::vector<Dart>, orbit_kinds> moved; // [orbit]: darts with another slot
  // [orbit]: slots of touched orbits, freed slots, and slots whose value was initialised again
  std::array<std::vector<Slot>, orbit_kinds> slots;
  std::vector<Dart> reshaped; // darts of vertices with another rest position, one of each or more
  bool any = false;
  bool whole = false; // the map was replaced: everything may differ, and the lists are empty
  void clear();
};

class Edit;
class Archive;

class EmbeddedMap {
public:
  explicit EmbeddedMap(int dimension);

  // A map built in bulk, with the point of each vertex: `point_of` is called once per vertex, with its smallest
  // dart.
  EmbeddedMap(GMap map, const std::function<Point(Dart)>& point_of);

  EmbeddedMap(const EmbeddedMap&) = delete;
  EmbeddedMap& operator=(const EmbeddedMap&) = delete;

  const GMap& map() const { return map_; }
  int dimension() const { return map_.dimension(); }

  // Slots. use() creates them; cells() CHECKs that they exist.
  const CellIndex& use(Orbit orbit);
  const CellIndex& cells(Orbit orbit) const;
  bool uses(Orbit orbit) const { return cells_[orbit.mask] != nullptr; }
  Slot slot(Orbit orbit, Dart d) const { return cells(orbit).slot(d); }
  Slot vertex(Dart d) const { return cells_[Vertex.mask]->slot(d); }

  // Columns. A new column is initialised by birth() on every existing orbit.
  template <class E> Column<E>& add(E embedding) {
    auto column = std::make_unique<Column<E>>(std::move(embedding));
    Column<E>& added = *column;
    adopt(std::move(column));
    return added;
  }
  const std::vector<std::unique_ptr<ColumnBase>>& columns() const { return columns_; }

  VertexColumn& position() { return *position_; } // [m]
  VertexColumn& rest() { return *rest_; }         // [m]
  VertexColumn& velocity() { return *velocity_; } // [m/s]
  const VertexColumn& position() const { return *position_; }
  const VertexColumn& rest() const { return *rest_; }
  const VertexColumn& velocity() const { return *velocity_; }
  Vec3 rest_of(Dart d) const { return (*rest_)[vertex(d)]; }
  Vec3 position_of(Dart d) const { return (*position_)[vertex(d)]; }

  // Runs `change` and updates the columns. An exception thrown by `change` or by a policy of an embedding
  // passes through, and leaves everything as before. CHECK: no edit is open; (with REND_VALIDATE) the map and
  // slots are valid.
  void edit(const std::function<void(Edit&)>& change);

  void subscribe(Changes& changes) { readers_.push_back(&changes); }
  void unsubscribe(Changes& changes) { std::erase(readers_, &changes); }

  // Reserves as many slots as separating all elements can ever make, so that no edit reallocates a column;
  // where the map grows, for darts as well, until it has `growth` times as many. Reserved memory that is not
  // written costs addresses only.
  void reserve_for_separations();
  std::size_t slots_when_separated(Orbit orbit) const; // if every element were separated, and the map had grown
  static constexpr std::size_t growth = 2;

  // Renumbers the slots of all orbits as if the map had just been built, without free ones. Values move along,
  // and subscribers see the whole map changed. Only orbits out of order are touched. CHECK: no edit is open.
  void renumber();

  std::size_t bytes() const; // of slots and columns; without the map itself

  // Writes or reads everything (base/archive.h): links, slots with their order and free list, and every column.
  // Afterwards subscribers see the whole map changed. What is read must result from this map by fracture and
  // time steps (GMap::store), so that all values but positions and velocities are the same at the same darts.
  // ArchiveError otherwise; this map is then unusable. Where rules may create darts (grows()), what is read
  // must satisfy the axioms, and values may differ.
  void store(Archive& archive);

  // Changes after this may create darts, and not only separate and remove elements.
  void let_grow() { grows_ = true; }
  bool grows() const { return grows_; }

private:
  struct Closing; // an edit that is being closed
  void adopt(std::unique_ptr<ColumnBase> column);
  void close(const Edit& edit, Closing& closing);
  void find_heirs(const Edit& edit, Closing& closing);
  void bring_columns_up_to_date(const Edit& edit, Closing& closing);
  void take_back(const Closing& closing) noexcept;
  void give_points(const Edit& edit);
  void move_vertices(const Edit& edit);
  void initialise_reshaped(ColumnBase& column, const Edit& edit, const Heirs* heirs);
  void find_reshaped(const Edit& edit);
  void initialise_around_reshaped(ColumnBase& column, const Heirs* done_by_them);
  void publish(Closing& closing);
  template <class F> void each_publication(F&& f);
  void publish_whole();
  void store(Archive& archive, ColumnBase& column, const CellIndex* was);
  bool moves(const ColumnBase& column) const { return &column == position_ || &column == velocity_; }

  GMap map_;
  std::array<std::unique_ptr<CellIndex>, orbit_kinds> cells_;
  std::array<SlotEvents, orbit_kinds> events_; // of the edit that is being closed
  // slots whose values were initialised again, of the edit that is being closed
  std::array<std::vector<Slot>, orbit_kinds> initialised_;
  // darts of vertices with another rest position, of the edit that is being closed
  std::vector<Dart> reshaped_;
  std::vector<std::unique_ptr<ColumnBase>> columns_;
  VertexColumn *position_ = nullptr, *rest_ = nullptr, *velocity_ = nullptr;
  std::vector<Changes*> readers_;
  Journal journal_;
  bool open_ = false; // an edit is
  bool grows_ = false;
};

// An open edit.
class Edit : public MapEdit {
public:
  Edit(GMap& map, Journal& journal, EmbeddedMap& embedded);

  // The point of the vertex of d, if it turns out to be a new vertex: one without darts from before the edit.
  // If several darts of a new vertex are given points, that of the smallest dart counts; of two points given to
  // one dart, the last.
  void give(Dart d, const Point& point) { give(d, add_point(point)); }

  // The same in two steps, for many darts with one point.
  std::uint32_t add_point(const Point& point);
  void give(Dart d, std::uint32_t point);

  // A vertex from before the edit, that of d, takes that place; of two for one vertex, the last counts. What
  // depends on the rest positions of its elements is initialised again.
  void move(Dart d, const Point& point) { moves_.push_back({d, point}); }

  bool is_new(Dart d) const; // it was created by this edit

  // For point expressions: what d was given, else its point before the edit. CHECK: one of them exists.
  Point point(Dart d) const;

  // What the new dart `child` comes from, for one kind of orbit; the embeddings on such orbits, and on others
  // that depend on them, follow from it (inheritance.h):
  //   Vertex               the vertices whose mean it is; of a new dart in a vertex that is kept: this one
  //   EdgeOfFace, Edge     of a part of a side or edge: the whole one
  //   element              the element in which it lies. It gives its mass away: nothing for elements beside it
  //   FaceOfVolume         in a solid, of a part of a face: the whole one
  // Darts that this edit created may be parents, too: they stand for their own parents, and if one has none,
  // nor has the child. If several darts of a new orbit have parents, those of the smallest dart count; of two
  // calls for one dart, the last. Nobody asks what was recorded for orbits that have darts from before the
  // edit. CHECK: the weights sum up to 1.
  void inherit(Dart child, Orbit orbit, std::span<const Parent> parents);

  // Whether some embedding inherits, so that recording parents is of use.
  bool inherits() const { return inherits_; }

  // The same in two steps, for many children with the same parents.
  std::uint32_t add_family(Orbit orbit, std::span<const Parent> parents);
  void inherit(Dart child, Orbit orbit, std::uint32_t family) { lineage().assign(child, orbit, family); }

  // What was recorded for a dart, all from before the edit; empty: nothing was. Valid until more is recorded.
  std::span<const Parent> parents(Dart child, Orbit orbit) const;

  // As of MapEdit, with points and parents.
  struct Savepoint {
    MapEdit::Savepoint map;
    Lineage::Savepoint lineage;
    std::size_t points = 0, given = 0, moves = 0;
  };
  Savepoint savepoint() const;
  void rollback(const Savepoint& to) noexcept;

private:
  friend class EmbeddedMap;
  EmbeddedMap& embedded_;
  std::vector<Point> points_;
  IndexMap given_;                                             // dart → index in points_
  std::vector<std::pair<std::uint32_t, std::uint32_t>> gifts_; // darts, and what each had been given before
  std::vector<std::pair<Dart, Point>> moves_;
  bool inherits_ = false;
  Lineage& lineage();
  std::unique_ptr<Lineage> lineage_; // null: no parents were recorded
};

// Checks every axiom of the map, and that the darts of an orbit share a slot which no other orbit has.
// Describes the first fault.
std::optional<std::string> validate(const EmbeddedMap& embedded);

// The embedding of this policy; null: the map has none.
template <class Policy> const Column<Policy>* find_column(const EmbeddedMap& map) {
  for (const auto& column : map.columns())
    if (const auto* found = dynamic_cast<const Column<Policy>*>(column.get())) return found;
  return nullptr;
}

} // namespace rend
