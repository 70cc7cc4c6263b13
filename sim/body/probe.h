// Probes: measurements on a body, at vertices that are selected at rest.
//
// Each selected vertex has the same weight, which the fragments of a split vertex share by their element
// corners (share.h); deleted corners no longer count. With w_n the weights, Σ w_n = 1:
//
//   position       Σ w_n x_n
//   displacement   Σ w_n (x_n − X_n)
//   reaction       Σ R_n over the fixed and driven vertices among them, along the prescribed axes:
//                  R = m a − f − load − m g + γ v, the force [N] that the support exerts on the body there; a
//                  is the prescribed acceleration (0 but for rotations), f the internal force. At rest: the
//                  supporting force. A static solve has neither a nor v.
//   stress         the mean σ [Pa] of the elements that contain one of its vertices, with equal weights
//
// A floor is no support in this sense: it acts by impulses (sim/contact/contact_answer.h).
#pragma once

#include "sim/embedding/selector.h"
#include "sim/outside/share.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

struct Body;

struct ProbeSettings {
  std::string name = {}; // of letters, digits, - and _
  Selector where = {};
  SettingsSource source = {};
};
template <> const Fields<ProbeSettings>& fields_of();
void check_name(const ProbeSettings& probe); // UserError

struct ProbeReading {
  Vec3 position = Vec3::Zero(), displacement = Vec3::Zero(); // [m]
  std::optional<Vec3> reaction;                              // [N]; nullopt if nothing is prescribed
  std::optional<Eigen::Matrix3d> stress; // [Pa], in world axes; nullopt without finite elements
};

class Probe {
public:
  Probe(EmbeddedMap& map, std::string name, const std::vector<Slot>& vertices);
  const std::string& name() const { return name_; }

  // Measures the current state without changing it: forces are evaluated again. nullopt if all its elements
  // were deleted.
  std::optional<ProbeReading> read(Body& body) const;

  bool on_support(const Body& body) const; // some of its vertices are prescribed

private:
  std::vector<Slot> vertices(const EmbeddedMap& map) const; // increasing
  Vec3 reaction(Body& body) const;
  std::optional<Eigen::Matrix3d> stress(const Body& body) const;
  std::string name_;
  ShareColumn* shares_;
};

// The quantities of a reading: x, y, z, dx, dy, dz, d, reaction-x, reaction-y, reaction-z, reaction, stress-xx
// ... NaN if it has none.
const std::vector<std::string>& probe_quantities();
bool has_stress(const Body& body); // whether it has finite elements with stress
double quantity_of(const ProbeReading& reading, const std::string& quantity);

} // namespace rend
