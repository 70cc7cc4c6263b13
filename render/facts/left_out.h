// What a scene leaves out, and why: each a sentence "what: why". What only the builders of a body know is
// recorded by them (Body::left_out); the rest is derived from what was built.
#pragma once

#include "sim/scene/scene.h"

#include <string>
#include <vector>

namespace rend {

std::vector<std::string> left_out_of(const Scene& scene, const Body& body);
std::vector<std::string> left_out_of(const Scene& scene); // of all bodies together

} // namespace rend
