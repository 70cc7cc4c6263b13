// Slivers of a solid, against dihedral angles from the normals of the faces.
#include "render/facts/mesh_facts.h"

#include "sim/mesh/cells.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

namespace rend::mesh_facts_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

using Tetrahedron = std::array<Vec3, 4>;

// Four points around a circle, alternately above and below its plane: all sides are of nearly the same length.
Tetrahedron around_a_circle(double height) {
  return {Vec3(1, 0, height), Vec3(0, 1, -height), Vec3(-1, 0, height), Vec3(0, -1, -height)};
}

// The smallest and the largest [degrees], to three digits.
std::pair<std::string, std::string> dihedral_angles(const Tetrahedron& x) {
  double least = 180, greatest = 0;
  for (int i = 0; i < 4; ++i)
    for (int j = i + 1; j < 4; ++j) {
      std::array<Vec3, 2> across;
      int n = 0;
      const Vec3 along = (x[j] - x[i]).normalized();
      for (int k = 0; k < 4; ++k)
        if (k != i && k != j) {
          const Vec3 to = x[k] - x[i];
          across[n++] = (to - to.dot(along) * along).normalized();
        }
      const double angle = std::acos(across[0].dot(across[1])) * 180 / std::numbers::pi;
      least = std::min(least, angle);
      greatest = std::max(greatest, angle);
    }
  return {fmt::format("{:.3g}", least), fmt::format("{:.3g}", greatest)};
}

// Apart from each other.
std::unique_ptr<EmbeddedMap> solid_of(const std::vector<Tetrahedron>& all) {
  CellMesh mesh;
  for (std::size_t n = 0; n < all.size(); ++n) {
    std::vector<std::uint32_t> corners;
    for (const Vec3& x : all[n]) {
      corners.push_back(static_cast<std::uint32_t>(mesh.points.size()));
      mesh.points.push_back(x + Vec3(10 * double(n), 0, 0));
    }
    mesh.add(CellKind::Tetrahedron, corners);
  }
  return solid_from(mesh);
}

TEST(Slivers, are_counted_and_the_worst_is_named) {
  const Tetrahedron good = around_a_circle(0.7), thin = around_a_circle(0.05), thinner = around_a_circle(0.01);
  const auto [least, greatest] = dihedral_angles(good);
  EXPECT_EQ(slivers_in_words(*solid_of({good, good})),
            fmt::format("no slivers: dihedral angles from {} to {} degrees", least, greatest));
  const auto [low, high] = dihedral_angles(thinner);
  EXPECT_THAT(slivers_in_words(*solid_of({good, thin, thinner, good})),
              AllOf(HasSubstr("2 of 4 elements are slivers"), HasSubstr("near (20, 0, 0) m"),
                    HasSubstr(fmt::format("from {} to {} degrees", low, high))));
  EXPECT_THAT(slivers_in_words(*solid_of({good, thin})), HasSubstr("1 of 2 elements is a sliver"));
}

} // namespace
} // namespace rend::mesh_facts_test
