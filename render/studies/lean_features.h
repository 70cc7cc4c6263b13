// The features that `rend study --lean` switches off and on: one entry each, in the order of the table.
//
// A feature is text that is added to the preset: to its first body, or by --set. If a feature must have no
// effect on a scene (a tearing law whose threshold is never reached, wind without drag, contact with distant
// objects), pixels are compared bit by bit; the state as well, unless sums are made in another order.
#pragma once

#include "sim/study/study.h"

#include <string>
#include <vector>

namespace rend {

struct LeanSide {
  std::string element = "";           // of the first body, as XML; empty: none
  std::vector<Setting> settings = {}; // as --set
  std::string world_element = "";     // of the world, as XML
  bool walk = false, count_fragments = false;
  bool bare = false; // minimal_loop.h instead of the scene's own loop
};

enum class LeanSame {
  State,  // bitwise equal states, and so equal pixels
  Pixels, // equal pixels; states differ by round-off, since sums are made in another order
  Free    // no claim: another scheme gives another motion
};

struct LeanFeature {
  std::string name, what;
  LeanSide off, on;
  LeanSame same = LeanSame::State;
  bool may_change_other_scenes = false; // may change the motion of scenes that are not built in
  std::string needs = "";               // an element that the preset must have, such as "springs"
};

const std::vector<LeanFeature>& lean_features();

// A scene to measure features on.
struct LeanScene {
  std::string name, text; // text of a preset
  std::string file;       // its path; empty: built in
};
const std::vector<LeanScene>& lean_scenes(); // one of springs, one of finite elements

} // namespace rend
