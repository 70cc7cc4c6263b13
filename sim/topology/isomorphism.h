// Are two maps the same but for the numbers of their darts?
#pragma once

#include "sim/topology/gmap.h"

#include <functional>
#include <optional>
#include <vector>

namespace rend {

// Whether dart a of the first map may correspond to dart b of the second (for instance, by the points they
// carry).
using DartMatch = std::function<bool(Dart a, Dart b)>;

// A bijection of darts that keeps all four links and that `match` agrees with: image[d] for every dart d of `a`
// (one per dart of its capacity). Empty: there is none. Each fragment costs at most darts × candidates.
std::optional<std::vector<Dart>> isomorphism(const GMap& a, const GMap& b, const DartMatch& match = {});

} // namespace rend
