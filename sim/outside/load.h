// Loads: external forces on a patch of the body's boundary (patch.h).
//
//   force F      f_n = a_n F              a_n: the vertex's share of area or length at rest; Σ a_n = 1
//   moment M     f_n = a_n θ × (x_n − c)  c = Σ a_n x_n / Σ a_n; θ such that Σ (x_n − c) × f_n = M; Σ f_n = 0
//   pressure p   f_n = −p A_n             A_n: the vertex's vector area in the current state, outward
//
// A moment acts like a bending stress, linear over the section, in the current position: its value stays exact
// however the patch rotates. On a straight edge it has no component along the edge. With follows = body
// (follower loads), F and M rotate with the patch: by the rotation R of the least-squares rigid motion from its
// rest to its current position (Kabsch 1976), R = U diag(1, 1, det UVᵀ) Vᵀ of Σ (x_n − c)(X_n − C)ᵀ; for edges
// and single vertices together with the elements that contain them. Shares are those of the undamaged body:
// parts that are torn off keep theirs, those of deleted elements are lost.
#pragma once

#include "sim/embedding/selector.h"
#include "sim/outside/wind.h"

#include <limits>
#include <optional>

namespace rend {

// A linear ramp: what share of the whole acts at `time` [s], if it grows from 0 over so many seconds; 1 from
// the start, if over no time.
inline double ramp(double time, double over) {
  return time >= over ? 1 : time > 0 ? time / over : 0;
}

// Exactly one of force, moment, pressure.
struct LoadSettings {
  enum class Kind { Force, Moment, Pressure };
  Selector where = {};
  std::optional<Vec3> force = {};      // [N]
  std::optional<Vec3> moment = {};     // [N·m]
  std::optional<double> pressure = {}; // [Pa]
  enum class Follows { World, Body } follows = Follows::World;
  double from = 0;                                         // [s]
  double until = -std::numeric_limits<double>::infinity(); // [s]; grows from `from` to `until`, if later
  std::optional<double> over = {};                         // [s]; the same by its length: until = from + over
  SettingsSource source = {};

  Kind kind() const { return pressure ? Kind::Pressure : moment ? Kind::Moment : Kind::Force; }
  bool with_body() const { return follows == Follows::Body; }
  double share(double time) const; // 0 to 1
};
template <> const Fields<LoadSettings>& fields_of();
// UserError: settings that do not fit together.
void check_load(const LoadSettings& settings);

class Load {
public:
  // CHECK: the patch has cells; see Patch.
  Load(const EmbeddedMap& map, const LoadSettings& settings, Patch patch);
  void rebind(const EmbeddedMap& map);

  const LoadSettings& settings() const { return settings_; }
  bool constant() const { return settings_.kind() == LoadSettings::Kind::Force && !settings_.with_body(); }
  const std::vector<Slot>& vertices() const { return patch_.cells().vertices(); } // with repetitions

  std::size_t cells() const { return patch_.cells().size(); }
  std::size_t bytes() const { return patch_.bytes() + bytes_of(part_) + bytes_of(frame_); }

  // Whether the patch can carry a moment: not if all its vertices are on a straight line.
  bool possible(const EmbeddedMap& map) const;

  // Adds the force [N] on each vertex; [m] and [N], one per vertex slot.
  void add(const EmbeddedMap& map, double time, const Record* position, Record* force) const;

private:
  struct Section; // of a moment
  Section section(const Record* position) const;
  void share_out(const EmbeddedMap& map);
  void add_moment(const Vec3& moment, const Record* position, Record* force) const;
  void add_pressure(double pressure, const Record* position, Record* force) const;
  Eigen::Matrix3d rotation(const EmbeddedMap& map, const Record* position) const;

  LoadSettings settings_;
  Patch patch_;
  double whole_ = 0;         // size of the whole patch of the undamaged body [m²], [m] or 1
  std::vector<double> part_; // shares of it, one for each of vertices(); not for a pressure
  std::vector<Slot> frame_;  // vertices that determine R, with repetitions; empty unless it follows the body
  bool line_ = false;        // at rest, all vertices are on a straight line
};

// All loads of a body.
class Loads {
public:
  void add(Load load);
  void set(WindLoad wind);
  bool empty() const { return loads_.empty() && !wind_; }
  const std::vector<Load>& loads() const { return loads_; }
  const std::optional<WindLoad>& wind() const { return wind_; }
  std::size_t bytes() const; // of lists and of the sum, without the embeddings

  void rebind(const EmbeddedMap& map); // after edits
  void reserve_for_separations(const EmbeddedMap& map);

  bool constant() const; // independent of time, once fully applied, and of the state

  // The sum [N], one per vertex slot; null if there are none. Valid until the next call.
  const Record* evaluate(const EmbeddedMap& map, double time, const Record* position, const Record* velocity);

  // An upper bound of the damping rate of wind on the body at rest [1/s].
  double damping_rate(const EmbeddedMap& map, const double* inverse_mass) const {
    return wind_ ? wind_->damping_rate(map, inverse_mass) : 0;
  }

private:
  bool up_to_date(double time) const;
  std::vector<Load> loads_;
  std::optional<WindLoad> wind_;
  std::vector<Record> sum_;   // [N], one per vertex slot
  std::vector<double> share_; // share() of each load in sum_
  bool known_ = false;        // sum_ belongs to the current map
};

} // namespace rend
