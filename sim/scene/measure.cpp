#include "sim/scene/measure.h"

#include "sim/mechanics/spring_law.h"

#include <cmath>

namespace rend {
namespace {

// The largest of value(k, rest length, length) over the springs at each vertex.
template <class F> std::vector<double> largest(const Body& body, F&& value) {
  std::vector<double> out(body.program->vertices(), 0);
  const auto& x = body.map->position().values();
  for (const Binder& binder : body.program->rows()) {
    if (binder.interaction()->law != spring_law()) continue;
    const PackedRows& rows = binder.rows();
    rows.for_each([&](std::size_t, std::size_t row) {
      const std::uint32_t i = rows.index(0)[row], j = rows.index(1)[row];
      const double here = value(rows.value(0, row), rows.value(2, row), (x[j].vec() - x[i].vec()).norm());
      out[i] = std::max(out[i], here);
      out[j] = std::max(out[j], here);
    });
  }
  return out;
}

} // namespace

std::vector<double> vertex_strain(const Body& body) {
  return largest(body,
                 [](double, double rest, double length) { return rest > 0 ? std::abs(length / rest - 1) : 0; });
}

std::vector<double> vertex_force(const Body& body) {
  return largest(body, [](double k, double rest, double length) { return k * std::abs(length - rest); });
}

} // namespace rend
