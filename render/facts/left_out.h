// What a scene does without, and why: each a sentence "what: why". What the builders of a body know only while
// they build it, they note themselves (Body::left_out); the rest is seen in what was built.
#pragma once

#include "sim/scene/scene.h"

#include <string>
#include <vector>

namespace rend {

std::vector<std::string> left_out_of(const Scene& scene, const Body& body);
std::vector<std::string> left_out_of(const Scene& scene); // of all bodies together

} // namespace rend
