// Scenes for tests of the schemes that solve: implicit Euler and the static solve.
#pragma once

#include "sim/presets.h"
#include "sim/scene/scene.h"

#include <fmt/format.h>

namespace rend::solved {

// Two chains of n links side by side, tied to each other: along x, 1 m and a cell wide.
inline std::string chain(int n, double length, double mass, double k, const std::string& more) {
  return fmt::format(R"(<body><sheet cells="{} 1" size="{} 0.1"/><mass total="{}"/>)"
                     R"(<springs><stretch k="{}"/></springs>{}</body>)",
                     n, length, mass, k, more);
}

inline std::string scene(const std::string& body, const std::string& scheme, double step, double duration,
                         const std::string& gravity = "0 0 -9.81") {
  return fmt::format(R"(<scene>{}<world gravity="{}"/><time step="{}" integrator="{}" duration="{}"/></scene>)",
                     body, gravity, step, scheme, duration);
}

inline double lowest(const presets::Loaded& s, int axis) {
  double low = 1e300;
  for (const Record& r : s.body().map->position().values()) low = std::min(low, r.vec()[axis]);
  return low;
}

// Ten links of 0.1 m hang from x = 1 towards −x, where gravity points; loads make the last masses equal to the
// others.
inline std::string hanging(double k) {
  const double m = 0.2, g = 9.81; // [kg] of a mass of each chain; a cell has two
  return chain(10, 1, 10 * 2 * m, k,
               fmt::format(R"(<viscosity value="2" per="particle"/><fix side="+x"/>)"
                           R"(<load box="-0.01 -1 -1 0.01 1 1" force="{} 0 0"/>)",
                           -m * g));
}

} // namespace rend::solved
