// What is worth its time: the Pareto front of runs, and when a scheme reaches an error.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace rend {

struct Work {
  double seconds = 0;
  double error = 0;
};

// Those that no other beats: none is both no slower and no less exact, and better in one. Indices, by
// increasing time.
std::vector<std::size_t> pareto_front(const std::vector<Work>& runs);

struct Reach {
  double seconds = 0;
  bool at_most = false; // already the coarsest run of the scheme is more exact
};

// The time in which a scheme reaches an error, from its runs in the order of decreasing steps: between the last
// run above it and the first one that meets it by a power law (a straight line in logarithms). None: not
// reached.
std::optional<Reach> time_to_reach(const std::vector<Work>& runs, double error);

} // namespace rend
