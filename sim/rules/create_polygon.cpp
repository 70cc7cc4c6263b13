#include "sim/base/check.h"
#include "sim/rules/rules.h"

namespace rend {

//   p0 ─0─ ─1─ p1 ─0─ ─1─ p2 … ─1─ p0        no Rule, as the number of nodes varies; the links are those
//                                              of create_triangle
std::vector<Dart> create_polygon(Edit& edit, std::span<const Point> points) {
  CHECK(points.size() >= 3);
  std::vector<Dart> darts;
  for (std::size_t n = 0; n < 2 * points.size(); ++n) darts.push_back(edit.add_dart());
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Dart first = darts[2 * n], last = darts[2 * n + 1];
    const Dart before = darts[(2 * n + 2 * points.size() - 1) % (2 * points.size())];
    edit.link(0, first, last);
    edit.link(1, before, first);
    const std::uint32_t point = edit.add_point(points[n]);
    edit.give(before, point);
    edit.give(first, point);
  }
  return darts;
}

} // namespace rend
