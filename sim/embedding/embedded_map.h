// A map and all that it carries. One writer: edit().
//
//   body.edit([&](Edit& edit) { unsew(edit, 2, dart); });
//
// While the scope is open the map changes and the journal grows; when it closes, the slots of every orbit in
// use are brought up to date once, from the touched darts alone, and every column applies its policies. Only
// orbits that somebody asked for have slots. What is built upon the map (rows, surfaces) subscribes to Changes.
#pragma once

#include "sim/embedding/column.h"
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

// What a vertex is born with.
struct Point {
  Vec3 position = Vec3::Zero(); // [m]
  Vec3 rest = Vec3::Zero();     // [m]
  Vec3 velocity = Vec3::Zero(); // [m/s]
};

// Position, rest position and velocity live on vertices and are copied to every fragment of a split one.
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

// What was changed since a reader last looked: enough to find again every row that may differ.
struct Changes {
  std::array<std::vector<Dart>, 4> touched;         // [i]: darts whose αi changed
  std::array<std::vector<Dart>, orbit_kinds> moved; // [orbit]: darts with another slot
  std::array<std::vector<Slot>, orbit_kinds>
      slots; // [orbit]: slots of touched orbits, dead ones, and values born again
  bool any = false;
  bool whole = false; // the map was replaced: all of it may differ, and the lists say nothing
  void clear();
};

class Edit;
class Archive;

class EmbeddedMap {
public:
  explicit EmbeddedMap(int dimension);

  // A map that was built in bulk, with the place of each vertex: `point_of` is asked once per vertex, with its
  // smallest dart.
  EmbeddedMap(GMap map, const std::function<Point(Dart)>& point_of);

  EmbeddedMap(const EmbeddedMap&) = delete;
  EmbeddedMap& operator=(const EmbeddedMap&) = delete;

  const GMap& map() const { return map_; }
  int dimension() const { return map_.dimension(); }

  // Slots. use() makes them exist; cells() CHECKs that they do.
  const CellIndex& use(Orbit orbit);
  const CellIndex& cells(Orbit orbit) const;
  bool uses(Orbit orbit) const { return cells_[orbit.mask] != nullptr; }
  Slot slot(Orbit orbit, Dart d) const { return cells(orbit).slot(d); }
  Slot vertex(Dart d) const { return cells_[Vertex.mask]->slot(d); }

  // Columns. A column that is added is born on every orbit there is.
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

  // Runs `change` and brings the columns up to date. An exception out of `change` or of a birth leaves a map
  // that takes no further edit (CHECK). CHECK (with REND_VALIDATE): the map and slots are valid.
  void edit(const std::function<void(Edit&)>& change);

  void subscribe(Changes& changes) { readers_.push_back(&changes); }
  void unsubscribe(Changes& changes) { std::erase(readers_, &changes); }

  // Room for as many slots as separations of elements can ever make, so that none of them moves an array.
  // Memory that is not written to costs nothing but addresses.
  void reserve_for_separations();
  std::size_t slots_when_separated(Orbit orbit) const; // with every element by itself

  // Gives all orbits the slots that they would get if the map were built now; free ones are gone. Values
  // follow, and readers find all of the map changed. Only what is out of order is touched. CHECK: no edit is
  // open.
  void number_anew();

  std::size_t bytes() const; // of slots and columns; the map has its own

  // All of it (base/archive.h): links, slots with their order and free ones, and every column. Readers then
  // find all of it changed. What is read must have come from this map by changes of laws and by steps
  // (GMap::store), so that all but positions and velocities is what it was at the same darts. ArchiveError: it
  // did not, and this map is spoilt.
  void store(Archive& archive);

private:
  void adopt(std::unique_ptr<ColumnBase> column);
  void close(const Edit& edit);
  void give_points(const Edit& edit);
  void bear_reshaped(ColumnBase& column);
  void publish();
  void publish_whole();
  void store(Archive& archive, ColumnBase& column, const CellIndex* was);
  bool moves(const ColumnBase& column) const { return &column == position_ || &column == velocity_; }

  GMap map_;
  std::array<std::unique_ptr<CellIndex>, orbit_kinds> cells_;
  std::array<SlotEvents, orbit_kinds> events_;      // of the edit that closes
  std::array<std::vector<Slot>, orbit_kinds> born_; // again, of the edit that closes
  std::vector<std::unique_ptr<ColumnBase>> columns_;
  VertexColumn *position_ = nullptr, *rest_ = nullptr, *velocity_ = nullptr;
  std::vector<Changes*> readers_;
  Journal journal_;
  bool whole_ = true; // no edit is open, and none was left by an exception
};

// The open scope.
class Edit : public MapEdit {
public:
  Edit(GMap& map, Journal& journal, EmbeddedMap& embedded) : MapEdit(map, &journal), embedded_(embedded) {}

  // The point of the vertex of d, if it turns out to be a new vertex: one without a dart from before the edit.
  // Where several darts of a new vertex are given points, that of the smallest dart counts; of two gifts to a
  // dart, the last.
  void give(Dart d, const Point& point) { give(d, add_point(point)); }

  // The same in two steps, for many darts of one point.
  std::uint32_t add_point(const Point& point);
  void give(Dart d, std::uint32_t point) { given_.assign(d.value, point); }

  // For expressions: what d was given, else the state before the edit. CHECK: one of them exists.
  Point point(Dart d) const;

private:
  friend class EmbeddedMap;
  EmbeddedMap& embedded_;
  std::vector<Point> points_;
  IndexMap given_; // dart → index in points_
};

// Every axiom of the map, and that every dart of an orbit has its slot and no other orbit has it. Names the
// first fault.
std::optional<std::string> validate(const EmbeddedMap& embedded);

} // namespace rend
