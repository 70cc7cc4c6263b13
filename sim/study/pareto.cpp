#include "sim/study/pareto.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace rend {

std::vector<std::size_t> pareto_front(const std::vector<WorkPrecision>& runs) {
  std::vector<std::size_t> order(runs.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return runs[a].seconds != runs[b].seconds ? runs[a].seconds < runs[b].seconds
                                              : runs[a].error < runs[b].error;
  });
  std::vector<std::size_t> front;
  for (std::size_t n : order) {
    const bool better = front.empty() || runs[n].error < runs[front.back()].error;
    const bool equal = !front.empty() && runs[n].error == runs[front.back()].error &&
                       runs[n].seconds == runs[front.back()].seconds;
    if (better || equal) front.push_back(n);
  }
  return front;
}

std::optional<Reach> time_to_reach(const std::vector<WorkPrecision>& runs, double error) {
  for (std::size_t n = 0; n < runs.size(); ++n) {
    if (runs[n].error > error) continue;
    if (n == 0) return Reach{runs[n].seconds, true};
    const WorkPrecision &above = runs[n - 1], &below = runs[n];
    if (below.error == error || below.error <= 0 || above.seconds <= 0) return Reach{below.seconds, false};
    const double share = std::log(above.error / error) / std::log(above.error / below.error);
    return Reach{above.seconds * std::pow(below.seconds / above.seconds, share), false};
  }
  return {};
}

} // namespace rend
