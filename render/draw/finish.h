// Surface finishes: parameters of the body shader, under names of materials. One entry each in finishes().
//
// The highlight is that of Blinn and Phong, the cosine to the power n = 2^sharpness, as of a surface whose
// facets have the roughness a: n = 2/a² - 2. Where a picture says how rough a surface is, from 0 (its finish's)
// to 1 (a = 0.8), a is between the two, and the highlight as much fainter as it is wider: a_finish²/a².
//
// Source: Walter, Marschner, Li and Torrance, Microfacet models for refraction through rough surfaces, 2007 (n
// and a).
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
