// Surface finishes: parameters of the body shader, under names of materials. One entry each in finishes().
#pragma once

#include <string>
#include <vector>

namespace rend {

struct Finish {
  std::string name, what;
  float gloss = 0.07f;    // strength of the key light's specular highlight
  int sharpness = 3;      // number of times that its cosine is squared
  float rim = 0.25f;      // rim light: how much lighter the surface is at grazing angles
  float wrap = 0;         // wrap lighting of the key light: 0 for hard surfaces, up to 1
  float transmission = 0; // share of key light that passes through a sheet
};

const std::vector<Finish>& finishes();                // the first is the default
const Finish& finish_called(const std::string& name); // CHECK that there is one of that name
std::vector<std::string> finish_names();

} // namespace rend
