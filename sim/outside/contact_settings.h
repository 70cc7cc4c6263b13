// What a body collides with, and how.
#pragma once

#include "sim/base/settings.h"

namespace rend {

// How it collides with single things: what is given here counts for them in place of what counts for all.
struct ContactPairSettings {
  std::vector<std::string> with = {}; // names of bodies, obstacles or of the floor
  std::optional<double> friction = {}, restitution = {};
  SettingsSource source = {};
};
template <> const Fields<ContactPairSettings>& fields_of();

struct ContactSettings {
  bool floor = false;
  bool obstacles = true;    // spheres, boxes and meshes; and the floor
  bool fragments = false;   // other fragments, and other bodies that ask for it
  bool self = false;        // faces of the same fragment as well; and `fragments`
  double thickness = 0.002; // [m], kept from all of them
  double friction = 0.5;    // coefficient, where the obstacle has none of its own
  double restitution = 0;   // likewise, of impacts: 0 to 1
  enum class Overlap { Refuse, Push } overlap = Overlap::Refuse; // what starts inside something
  std::vector<std::string> excluded = {};                        // names of what it passes through
  std::vector<ContactPairSettings> pairs = {};
  SettingsSource source = {};

  bool push() const { return overlap == Overlap::Push; }
  bool faces() const { return obstacles || fragments || self; } // more than the floor
};
template <> const Fields<ContactSettings>& fields_of();

// The depth [m] that a point may still have at the end of a step that was `before` deep at its start, where a
// scheme solves: it is moved out over 0.05 s, and no faster than 0.1 m/s. At once, the elastic forces of so
// large a deformation would throw it out. 0: it was outside.
double way_out(double before, double step);

// With the floor, of a body that meets it.
struct FloorContact {
  double height = 0; // [m], the floor's plus the body's thickness
};

} // namespace rend
