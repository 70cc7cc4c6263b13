#include "sim/solve/vertex_order.h"

#include <algorithm>

namespace rend {
namespace {

class Walk {
public:
  explicit Walk(const BlockPattern& pattern) : pattern_(pattern), seen_(pattern.rows(), 0) {}

  // Appends the component of `root`, level by level, rows of low degree first. Returns the number of levels.
  std::size_t from(std::uint32_t root, std::vector<std::uint32_t>& rows) {
    ++pass_;
    std::size_t levels = 0, at = rows.size();
    rows.push_back(root);
    seen_[root] = pass_;
    for (std::size_t end = rows.size(); at < end; end = rows.size(), ++levels)
      for (; at < end; ++at) {
        const std::uint32_t i = rows[at];
        const std::size_t first = rows.size();
        for (std::size_t n = pattern_.start[i]; n < pattern_.start[i + std::size_t{1}]; ++n) {
          const std::uint32_t j = pattern_.column[n];
          if (seen_[j] == pass_) continue;
          seen_[j] = pass_;
          rows.push_back(j);
        }
        std::sort(rows.begin() + static_cast<std::ptrdiff_t>(first), rows.end(),
                  [this](std::uint32_t a, std::uint32_t b) {
                    return std::pair(degree(a), a) < std::pair(degree(b), b);
                  });
      }
    return levels;
  }

  std::uint32_t degree(std::uint32_t i) const { return pattern_.start[i + std::size_t{1}] - pattern_.start[i]; }

private:
  const BlockPattern& pattern_;
  std::vector<std::uint32_t> seen_; // the pass that last saw a row
  std::uint32_t pass_ = 0;
};

} // namespace

std::vector<std::uint32_t> vertex_order(const BlockPattern& pattern) {
  Walk walk(pattern);
  std::vector<std::uint32_t> order;
  std::vector<bool> placed(pattern.rows(), false);
  for (std::uint32_t first = 0; first < pattern.rows(); ++first) {
    if (placed[first]) continue;
    const std::size_t begin = order.size();
    std::size_t levels = walk.from(first, order);
    while (true) { // the last row reached is closer to the periphery
      const std::uint32_t end = order.back();
      order.resize(begin);
      const std::size_t more = walk.from(end, order);
      if (more <= levels) break;
      levels = more;
    }
    for (std::size_t n = begin; n < order.size(); ++n) placed[order[n]] = true;
  }
  std::reverse(order.begin(), order.end());
  return order;
}

} // namespace rend
