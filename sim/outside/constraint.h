// Prescribed motions (Dirichlet conditions) of vertices: fixed and driven ones.
//
// A motion moves its vertices, along the given axes, from their rest position X:
//   fix           x = X
//   velocity V    x = X + V s             s = clamp(t, from, until) − from
//   displacement  x = X + D s/(until − from)
//   gradient G    x = X + G X s/(until − from)
//   rotation      x = c + R(rate s) (X − c)    about the axis through c, by Rodrigues' formula
// With until infinite, or equal to from, displacement and gradient are reached at `from`. Before `from` a
// driven vertex is fixed at X; after `until` it is fixed where it is, or released with its velocity (then =
// free). The motions of a vertex are embedded on it, and apply to every fragment of a split vertex too.
#pragma once

#include "sim/base/bytes.h"
#include "sim/embedding/selector.h"

#include <limits>
#include <variant>
#include <vector>

namespace rend {

enum class Axes { X, Y, Z, XY, XZ, YZ, XYZ }; // coordinates
bool holds(Axes axes, int axis);              // 0, 1, 2: x, y, z

// Vertices that stay where they are at rest.
struct FixSettings {
  Selector where = {};
  Axes axes = Axes::XYZ;
  SettingsSource source = {};
};
template <> const Fields<FixSettings>& fields_of();

// Vertices that move as prescribed: by exactly one of velocity, displacement, gradient, rotate.
struct DriveSettings {
  Selector where = {};
  std::optional<Vec3> velocity = {};                  // [m/s]
  std::optional<Vec3> displacement = {};              // [m]
  std::optional<std::array<double, 9>> gradient = {}; // G, row after row
  std::optional<std::array<double, 4>> rotate = {};   // the axis x y z, and the rate [degrees/s]
  Vec3 centre = Vec3::Zero();                         // [m], a point of the axis
  double from = 0;                                    // [s]
  double until = std::numeric_limits<double>::infinity();
  enum class Then { Hold, Free } then = Then::Hold; // after `until`
  Axes axes = Axes::XYZ;
  SettingsSource source = {};
};
template <> const Fields<DriveSettings>& fields_of();

using MotionSettings = std::variant<FixSettings, DriveSettings>;

struct Motion {
  std::array<bool, 3> axes{true, true, true};
  Vec3 velocity = Vec3::Zero();     // [m/s]
  Vec3 displacement = Vec3::Zero(); // [m]
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();
  Vec3 axis = Vec3::Zero();                                         // of unit length; 0: no rotation
  Vec3 centre = Vec3::Zero();                                       // [m]
  double rate = 0;                                                  // [degrees/s]
  double from = 0, until = std::numeric_limits<double>::infinity(); // [s]
  bool then_free = false;

  // What is the same for all vertices at one time.
  struct Moment {
    bool acts = false, moves = false; // moves: between from and until
    double elapsed = 0, share = 0;    // s [s]; of displacement and gradient
    double cosine = 1, sine = 0;      // of the angle
  };
  Moment at(double time) const;

  bool acts(double time) const { return !then_free || time <= until; }
  Vec3 offset(const Vec3& rest, const Moment& now) const; // x − X
  Vec3 velocity_at(const Vec3& rest, const Moment& now) const;
  Vec3 acceleration_at(const Vec3& rest,
                       const Moment& now) const; // [m/s²], without the jumps at from and until

private:
  Vec3 turned(const Vec3& rest, const Moment& now) const; // R (X − c)
};

Motion motion_of(const FixSettings& settings);
// UserError: settings that do not fit together.
Motion motion_of(const DriveSettings& settings);

// The motions of a vertex: bit k is motion k. A vertex that comes to lie between others has the motions that
// all of them have.
struct MotionMask {
  using Value = std::uint64_t;
  std::string name = "prescribed motions";
  Orbit orbit = Vertex;
  Orbit support = SingleDart;
  Value birth(const EmbeddedMap&, Dart) const { return 0; }
  Value split(const Value& whole) const { return whole; }
  Value merge(const Value& kept, const Value& absorbed) const { return kept | absorbed; }
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const {
    Value all = ~Value{0};
    for (const Inherited<Value>& parent : parents) all &= parent.value;
    return all;
  }
};

class Constraints {
public:
  // Applies one more motion to the vertices. The column exists from the first motion on.
  void add(EmbeddedMap& map, const Motion& motion, const std::vector<Slot>& vertices);

  void rebind(const EmbeddedMap& map, const Changes& changes);
  void apply(const EmbeddedMap& map, double time, Record* position, Record* velocity) const;

  // Sets the bits (0, 1, 2: x, y, z) of the coordinates that are prescribed at `time`; one byte per vertex
  // slot.
  void mark(double time, std::uint8_t* axes) const;

  const std::vector<Slot>& vertices() const { return vertices_; } // increasing
  const std::vector<Motion>& motions() const { return motions_; }
  // Calls f(motion) for each motion of the vertex, in the order in which they are applied.
  template <class F> void for_each_motion(Slot vertex, F&& f) const {
    if (!motion_mask_) return;
    std::uint64_t mask = (*motion_mask_)[vertex];
    for (std::size_t k = 0; mask; ++k, mask >>= 1)
      if (mask & 1) f(motions_[k]);
  }
  bool drives() const;                                                           // some motion moves
  std::size_t bytes() const { return bytes_of(motions_) + bytes_of(vertices_); } // without the embedding

private:
  void list(const EmbeddedMap& map);
  std::vector<Motion> motions_;
  Column<MotionMask>* motion_mask_ = nullptr; // null: nothing is prescribed
  std::vector<Slot> vertices_;                // with some motion
};

} // namespace rend
