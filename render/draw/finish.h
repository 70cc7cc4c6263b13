// How a surface takes the light: a few numbers of the body shader, under the names of what they look like. One
// entry each in finishes().
#pragma once

#include <string>
#include <vector>

namespace rend {

struct Finish {
  std::string name, what;
  float gloss = 0.07f;    // strength of the key light's mirror image
  int sharpness = 3;      // its cosine is squared so often
  float rim = 0.25f;      // how much lighter the surface is where it turns away
  float wrap = 0;         // how far the key light reaches around: 0 for what is hard, up to 1
  float transmission = 0; // of key light through a sheet
};

const std::vector<Finish>& finishes();                // the first is the one for whoever asks for none
const Finish& finish_called(const std::string& name); // CHECK: there is one
std::vector<std::string> finish_names();

} // namespace rend
