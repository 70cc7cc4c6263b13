// What `rend study --lean` switches off and on: one entry a feature, in the order of the table.
//
// A feature is text that is put into the preset: into its first body, or by --set. Where its presence must
// change nothing (a law whose threshold is never reached, wind without drag, contact with what is far away),
// pixels are compared bit by bit, and the state as well but where sums are made in another order.
#pragma once

#include "sim/study/study.h"

#include <string>
#include <vector>

namespace rend {

struct LeanSide {
  std::string element = "";           // of the first body, as XML; empty: none
  std::vector<Setting> settings = {}; // as --set
  std::string surroundings = "";      // of the world, as XML
  bool walk = false, births = false;
  bool bare = false; // bare_loop.h, in place of the scene's own loop
};

enum class LeanSame {
  State,  // to the last bit, and so the pixels
  Pixels, // what is summed up in another order differs by round-off
  Free    // another scheme: another motion
};

struct LeanFeature {
  std::string name, what;
  LeanSide off, on;
  LeanSame same = LeanSame::State;
  bool acts_elsewhere = false; // on scenes that are not built in it may change the motion
  std::string needs = "";      // an element that the preset must have, such as "springs"
};

const std::vector<LeanFeature>& lean_features();

// A scene to measure on.
struct LeanScene {
  std::string name, text; // a preset's
  std::string file;       // that it was read from; empty: built in
};
const std::vector<LeanScene>& lean_scenes(); // of springs, and of finite elements

} // namespace rend
