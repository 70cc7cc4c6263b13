// Vertices whose motion is prescribed: fixed ones, and driven ones.
//
// A motion moves its vertices, along the axes it names, from their rest position X:
//   fix           x = X
//   velocity V    x = X + V s             s = clamp(t, from, until) − from
//   displacement  x = X + D s/(until − from)
//   gradient G    x = X + G X s/(until − from)
// With until infinite, or equal to from, displacement and gradient are reached at `from`. Before `from` a
// driven vertex is held at X; after `until` it is held where it is, or let go with the speed it has (then =
// free). Which motions a vertex obeys is embedded on it, and every fragment of a split vertex obeys them too.
#pragma once

#include "sim/embedding/embedded_map.h"

#include <limits>
#include <vector>

namespace rend {

struct Motion {
  std::array<bool, 3> axes{true, true, true};
  Vec3 velocity = Vec3::Zero();     // [m/s]
  Vec3 displacement = Vec3::Zero(); // [m]
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  double from = 0, until = std::numeric_limits<double>::infinity(); // [s]
  bool then_free = false;

  bool acts(double time) const { return !then_free || time <= until; }
  Vec3 offset(const Vec3& rest, double time) const; // x − X
  Vec3 velocity_at(const Vec3& rest, double time) const;
};

// The motions a vertex obeys: bit k is motion k.
struct Obedience {
  using Value = std::uint64_t;
  std::string name = "prescribed motions";
  Orbit orbit = Vertex;
  Orbit support = SingleDart;
  Value birth(const EmbeddedMap&, Dart) const { return 0; }
  Value split(const Value& whole) const { return whole; }
  Value merge(const Value& kept, const Value& absorbed) const { return kept | absorbed; }
};

class Constraints {
public:
  // Makes the vertices obey one more motion. The column is there from the first motion on.
  void add(EmbeddedMap& map, const Motion& motion, const std::vector<Slot>& vertices);

  void rebind(const EmbeddedMap& map, const Changes& changes);
  void apply(const EmbeddedMap& map, double time, Record* position, Record* velocity) const;

  const std::vector<Slot>& vertices() const { return vertices_; } // increasing
  const std::vector<Motion>& motions() const { return motions_; }
  bool drives() const; // some motion moves

private:
  void list(const EmbeddedMap& map);
  std::vector<Motion> motions_;
  Column<Obedience>* obedience_ = nullptr; // null: nothing is prescribed
  std::vector<Slot> vertices_;             // that obey some motion
};

} // namespace rend
