#include "sim/body/measure.h"

#include "sim/mechanics/spring_law.h"
#include "sim/rows/continuum.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// The largest value(k, rest length, length) of the springs at each vertex.
template <class F> std::vector<double> largest_of_springs(const Body& body, F&& value) {
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

const Record* positions(const Body& body) {
  return body.map->position().values().data();
}

} // namespace

std::vector<double> vertex_strain(const Body& body) {
  std::vector<double> out = largest_of_springs(
      body, [](double, double rest, double length) { return rest > 0 ? std::abs(length / rest - 1) : 0; });
  const Continuum continuum(*body.map, body.interactions);
  continuum.each(positions(body), nullptr, [&](const Continuum::Part& part, const CurrentUnit& e) {
    const double here = largest_principal(strain_of(part, e), Compression::Counts).value;
    for (std::size_t n = 0; n < static_cast<std::size_t>(e.particles); ++n)
      out[e.vertex[n]] = std::max(out[e.vertex[n]], here);
  });
  return out;
}

std::vector<double> vertex_force(const Body& body) {
  std::vector<double> out = largest_of_springs(
      body, [](double k, double rest, double length) { return k * std::abs(length - rest); });
  const Continuum continuum(*body.map, body.interactions);
  continuum.each(positions(body), nullptr, [&](const Continuum::Part&, const CurrentUnit& e) {
    const auto force = e.forces();
    for (std::size_t n = 0; n < static_cast<std::size_t>(e.particles); ++n)
      out[e.vertex[n]] = std::max(out[e.vertex[n]], force[n].norm());
  });
  return out;
}

std::vector<double> vertex_stress(const Body& body) {
  const Continuum continuum(*body.map, body.interactions);
  std::vector<double> out(body.program->vertices(), 0);
  if (continuum.empty()) return out;
  VertexStress stress(*body.map, continuum, *body.mass);
  const CellIndex& vertices = body.map->cells(Vertex);
  for (Slot v = 0; v < out.size(); ++v)
    if (vertices.alive(v))
      out[v] = std::max(0.0, largest_principal(stress.at(v, positions(body)), Compression::Ignored).value);
  return out;
}

} // namespace rend
