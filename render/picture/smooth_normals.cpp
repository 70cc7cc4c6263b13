#include "render/picture/smooth_normals.h"

#include "render/picture/sheet_rim.h"

namespace rend {
namespace {

void take_means(const Surface& sheet, const std::vector<Record>& x, std::vector<Vec3>& normals,
                std::vector<Vec3>& sums) {
  sums.assign(normals.size(), Vec3::Zero());
  sheet.for_each_triangle([&](const BoundaryTriangle& triangle) {
    const auto [a, b, c] = triangle.vertex;
    const Vec3 flat = (x[b].vec() - x[a].vec()).cross(x[c].vec() - x[a].vec()); // twice the area long
    Vec3 sum = Vec3::Zero();
    for (const Slot v : triangle.vertex) sum += normal_on_side(normals[v], flat);
    sum *= flat.norm();
    for (const Slot v : triangle.vertex) sums[v] += normals[v].dot(flat) < 0 ? Vec3(-sum) : sum;
  });
  for (std::size_t v = 0; v < normals.size(); ++v) {
    const double length = sums[v].norm();
    if (length > 0) normals[v] = sums[v] / length;
  }
}

} // namespace

void smooth_normals(const Surface& sheet, const std::vector<Record>& x, std::vector<Vec3>& normals,
                    std::vector<Vec3>& sums) {
  for (int pass = 0; pass < 2; ++pass) take_means(sheet, x, normals, sums);
}

} // namespace rend
