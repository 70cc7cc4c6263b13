#include "sim/mesh/locality.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <span>

namespace rend {
namespace {

using Cell = std::array<std::uint32_t, 3>; // of a grid of 2^20 cells along each side
constexpr int bits = 20;

// The index along the Hilbert curve, by Skilling's transpose: Gray codes undone from the highest bit, then bits
// interleaved.
std::uint64_t place_on_curve(Cell x) {
  for (std::uint32_t q = 1U << (bits - 1); q > 1; q >>= 1U) {
    for (std::uint32_t& each : x) {
      if ((each & q) != 0) {
        x[0] ^= q - 1;
      } else {
        const std::uint32_t swap = (x[0] ^ each) & (q - 1);
        x[0] ^= swap;
        each ^= swap;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t turn = 0;
  for (std::uint32_t q = 1U << (bits - 1); q > 1; q >>= 1U)
    if ((x[2] & q) != 0) turn ^= q - 1;
  std::uint64_t place = 0;
  for (int bit = bits - 1; bit >= 0; --bit)
    for (const std::uint32_t each : x) place = place << 1U | ((each ^ turn) >> bit & 1U);
  return place;
}

struct Elements {
  const std::vector<Vec3>& points;
  const std::vector<std::uint32_t>&corners, &first;
  std::size_t count() const { return first.empty() ? 0 : first.size() - 1; }
  std::span<const std::uint32_t> corners_of(std::size_t n) const {
    return std::span(corners).subspan(first[n], first[n + 1] - first[n]);
  }
};

bool fit_to_sew(const Elements& elements) {
  return std::all_of(elements.corners.begin(), elements.corners.end(),
                     [&](std::uint32_t c) { return c < elements.points.size(); }) &&
         std::all_of(elements.points.begin(), elements.points.end(),
                     [](const Vec3& x) { return x.allFinite(); });
}

std::vector<std::uint32_t> along_curve(const Elements& elements) {
  Vec3 low = elements.points.front(), high = low;
  for (const Vec3& x : elements.points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double size = std::max((high - low).maxCoeff(), 1e-300), scale = ((1U << bits) - 1) / size;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places;
  for (std::size_t n = 0; n < elements.count(); ++n) {
    Vec3 centre = Vec3::Zero();
    for (const std::uint32_t c : elements.corners_of(n)) centre += elements.points[c] - low;
    centre *= scale / static_cast<double>(elements.corners_of(n).size());
    places.emplace_back(
        place_on_curve({static_cast<std::uint32_t>(centre.x()), static_cast<std::uint32_t>(centre.y()),
                        static_cast<std::uint32_t>(centre.z())}),
        static_cast<std::uint32_t>(n));
  }
  std::sort(places.begin(), places.end());
  std::vector<std::uint32_t> order;
  for (const auto& [place, n] : places) order.push_back(n);
  return order;
}

// The sum over all elements, in this order, of the distance between the numbers of their corners, with points
// numbered as elements first use them.
std::uint64_t spread(const Elements& elements, const std::vector<std::uint32_t>& order) {
  std::vector<std::uint32_t> number(elements.points.size(), Dart::none_value);
  std::uint32_t met = 0;
  std::uint64_t sum = 0;
  for (const std::uint32_t n : order) {
    std::uint32_t low = Dart::none_value, high = 0;
    for (const std::uint32_t c : elements.corners_of(n)) {
      if (number[c] == Dart::none_value) number[c] = met++;
      low = std::min(low, number[c]);
      high = std::max(high, number[c]);
    }
    if (low <= high) sum += high - low;
  }
  return sum;
}

std::vector<std::uint32_t> order_of(const Elements& elements) {
  if (elements.points.size() < small_mesh_points || elements.count() == 0 || !fit_to_sew(elements)) return {};
  std::vector<std::uint32_t> present(elements.count());
  std::iota(present.begin(), present.end(), 0U);
  std::vector<std::uint32_t> better = along_curve(elements);
  if (2 * spread(elements, better) > spread(elements, present)) return {};
  return better;
}

template <class Mesh> void take_corners(const Mesh& from, std::uint32_t element, Mesh& to) {
  to.corners.insert(to.corners.end(), from.corners.begin() + from.first[element],
                    from.corners.begin() + from.first[element + 1]);
  to.first.push_back(static_cast<std::uint32_t>(to.corners.size()));
}

} // namespace

std::vector<std::uint32_t> order_for_locality(const PolygonMesh& mesh) {
  return order_of({mesh.points, mesh.corners, mesh.first});
}

std::vector<std::uint32_t> order_for_locality(const CellMesh& mesh) {
  return order_of({mesh.points, mesh.corners, mesh.first});
}

PolygonMesh reordered(const PolygonMesh& mesh, const std::vector<std::uint32_t>& order) {
  PolygonMesh to{mesh.points, {}, {0}, mesh.names, {}};
  for (const std::uint32_t n : order) {
    take_corners(mesh, n, to);
    if (!mesh.texture.empty())
      to.texture.insert(to.texture.end(), mesh.texture.begin() + mesh.first[n],
                        mesh.texture.begin() + mesh.first[n + 1]);
  }
  return to;
}

CellMesh reordered(const CellMesh& mesh, const std::vector<std::uint32_t>& order) {
  CellMesh to{mesh.points, {}, {}, {0}, mesh.names, {}};
  for (const std::uint32_t n : order) {
    take_corners(mesh, n, to);
    to.kinds.push_back(mesh.kinds[n]);
    to.cell_names.push_back(mesh.cell_name(n));
  }
  return to;
}

} // namespace rend
