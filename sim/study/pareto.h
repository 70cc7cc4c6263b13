// The Pareto front of runs by time and error, and the time in which a scheme reaches an error.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace rend {

struct WorkPrecision {
  double seconds = 0;
  double error = 0;
};

// The runs that no other dominates: none is at least as fast and as accurate, and better in one. Indices, by
// increasing time.
std::vector<std::size_t> pareto_front(const std::vector<WorkPrecision>& runs);

struct Reach {
  double seconds = 0;
  bool at_most = false; // the coarsest run of the scheme is already more accurate
};

// The time in which a scheme reaches an error, from its runs in the order of decreasing steps: interpolated by
// a power law (linear in logarithms) between the last run above it and the first one that reaches it. nullopt:
// not reached.
std::optional<Reach> time_to_reach(const std::vector<WorkPrecision>& runs, double error);

} // namespace rend
