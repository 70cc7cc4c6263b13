// Whether two maps are isomorphic: the same up to the numbering of their darts.
#pragma once

#include "sim/topology/gmap.h"

#include <functional>
#include <optional>
#include <vector>

namespace rend {

// Whether dart a of the first map may correspond to dart b of the second (for instance, by the points they
// carry).
using DartMatch = std::function<bool(Dart a, Dart b)>;

// A bijection of darts that preserves all four links and satisfies `match`: image[d] for every dart d of `a`
// (one entry per dart of its capacity). nullopt: there is none. Each fragment costs at most darts × candidates.
std::optional<std::vector<Dart>> isomorphism(const GMap& a, const GMap& b, const DartMatch& match = {});

} // namespace rend
