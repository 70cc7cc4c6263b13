#include "sim/guard/resolved.h"

#include <limits>

namespace rend {
namespace {

// Calls f(a, b, squared rest length) for each pair with a rest length above 0. Returns the interaction that
// connects them.
template <class F> const Interaction* for_each_pair(const Body& body, F&& f) {
  const Record* rest = body.map->rest().values().data();
  for (const Binder& binder : body.program->rows()) {
    if (binder.interaction()->law->particles() < 2) continue;
    const PackedRows& rows = binder.rows();
    rows.for_each([&](std::size_t, std::size_t row) {
      const std::uint32_t a = rows.index(0)[row], b = rows.index(1)[row];
      const double square = (rest[b].vec() - rest[a].vec()).squaredNorm();
      if (square > 0) f(a, b, square);
    });
    return binder.interaction();
  }
  return nullptr;
}

} // namespace

std::optional<Neighbours> fastest_neighbours(const Body& body, const Record* velocity) {
  double most = -1; // [1/s²]
  Neighbours found;
  const Interaction* joined = for_each_pair(body, [&](Slot a, Slot b, double square) {
    const double rate = (velocity[b].vec() - velocity[a].vec()).squaredNorm() / square;
    if (!(rate > most)) return;
    most = rate;
    found.a = a;
    found.b = b;
  });
  if (most < 0) return {};
  found.joined = joined->name;
  found.rate = std::sqrt(most);
  return found;
}

double least_rest_length(const Body& body) {
  double least = std::numeric_limits<double>::infinity();
  for_each_pair(body, [&](Slot, Slot, double square) { least = std::min(least, square); });
  return std::sqrt(least);
}

} // namespace rend
