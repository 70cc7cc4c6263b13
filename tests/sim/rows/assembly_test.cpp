// The assembled matrix against finite differences of forces, after separations and for several threads.
#include "sim/rows/assembly.h"

#include "sim/random_meshes.h"

#include <gtest/gtest.h>

namespace rend::assembly_test {
namespace {

using namespace meshes;

std::unique_ptr<Body> shaken(const Recipe& recipe, int nx = 5, int ny = 4) {
  auto made = body(sheet(SheetPattern::Mixed, nx, ny), recipe);
  shake(*made, 0.03, 5);
  return made;
}

// Column 3j + axis of −∂f/∂x, or of −∂f/∂v, by central differences.
std::vector<Record> difference_of_forces(const Body& body, Slot j, int axis, bool by_velocity) {
  constexpr double h = 1e-6;
  std::vector<Record> x(positions(body), positions(body) + body.vertices());
  std::vector<Record> v(velocities(body), velocities(body) + body.vertices()), ahead(x.size()),
      behind(x.size());
  double& moved = (&(by_velocity ? v : x)[j].x)[axis];
  moved += h;
  body.program->forces(x.data(), v.data(), ahead.data());
  moved -= 2 * h;
  body.program->forces(x.data(), v.data(), behind.data());
  for (std::size_t i = 0; i < x.size(); ++i) behind[i] = Record((behind[i].vec() - ahead[i].vec()) / (2 * h));
  return behind;
}

TEST(Assembly, is_the_derivative_of_the_forces) {
  for (const bool by_velocity : {false, true}) {
    Recipe recipe;
    recipe.springs = all_springs(by_velocity ? 0.1 : 0);
    recipe.scheme = "implicit";
    const auto made = shaken(recipe);
    BlockMatrix matrix;
    matrix.reset(made->pattern());
    made->add_stiffness(positions(*made), velocities(*made), Tangent::Exact, !by_velocity, by_velocity, matrix);
    const BlockPattern& p = *made->pattern();
    double worst = 0, largest_entry = 0;
    std::vector<std::vector<Record>> columns; // −∂f/∂(3j + axis), to be symmetrized as the matrix is
    for (Slot j = 0; j < p.rows(); ++j)
      for (int axis = 0; axis < 3; ++axis) columns.push_back(difference_of_forces(*made, j, axis, by_velocity));
    const auto derivative = [&](std::size_t i, std::size_t j) { return (&columns[j][i / 3].x)[i % 3]; };
    for (std::size_t i = 0; i < columns.size(); ++i)
      for (std::size_t j = 0; j < columns.size(); ++j) {
        const auto begin = p.column.begin() + p.start[i / 3], end = p.column.begin() + p.start[i / 3 + 1];
        const bool there = std::binary_search(begin, end, static_cast<std::uint32_t>(j / 3));
        const double entry =
            there ? matrix.at(p.place(static_cast<std::uint32_t>(i / 3), static_cast<std::uint32_t>(j / 3)))(
                        static_cast<int>(i % 3), static_cast<int>(j % 3))
                  : 0;
        worst = std::max(worst, std::abs(entry - 0.5 * (derivative(i, j) + derivative(j, i))));
        largest_entry = std::max(largest_entry, std::abs(entry));
      }
    EXPECT_LT(worst, 1e-5 * largest_entry) << (by_velocity ? "by velocity" : "by position");
  }
}

TEST(Assembly, follows_separations_as_if_made_anew) {
  Recipe recipe;
  recipe.scheme = "implicit";
  const auto made = shaken(recipe, 7, 6);
  Noise noise(3);
  const auto kept = made->pattern();
  made->rebind();
  EXPECT_EQ(kept, made->pattern()) << "the pattern is kept where nothing was torn";
  std::vector<Dart> inner;
  made->map->map().for_each_dart([&](Dart d) {
    if (!made->map->map().is_free(2, d)) inner.push_back(d);
  });
  for (std::size_t n = 0; n < inner.size(); n += 1 + n % 3) {
    if (made->map->map().is_free(2, inner[n])) continue;
    made->map->edit([&](Edit& edit) { unsew(edit, 2, inner[n]); });
    made->rebind();
    const Assembly fresh(*made->map, *made->program);
    ASSERT_TRUE(fresh.pattern()->same_as(*made->pattern()));
    BlockMatrix a, b;
    a.reset(made->pattern());
    b.reset(fresh.pattern());
    made->add_stiffness(positions(*made), velocities(*made), Tangent::SemiDefinite, 1, 0, a);
    fresh.add(positions(*made), velocities(*made), Tangent::SemiDefinite, 1, 0, b);
    ASSERT_EQ(std::memcmp(&a.at(0), &b.at(0), a.bytes()), 0);
  }
}

TEST(Assembly, gives_the_same_bytes_on_any_number_of_threads) {
  std::vector<BlockMatrix> all(3);
  for (std::size_t n = 0; n < 3; ++n) {
    Recipe recipe;
    recipe.springs = all_springs(0.1);
    recipe.scheme = "implicit";
    recipe.threads = 1 << n;
    const auto made = shaken(recipe, 65, 65);
    ASSERT_EQ(made->program->parts(), 1 << n);
    all[n].reset(made->pattern());
    made->add_stiffness(positions(*made), velocities(*made), Tangent::SemiDefinite, 1e-4, 1e-2, all[n]);
    EXPECT_EQ(std::memcmp(&all[n].at(0), &all[0].at(0), all[0].bytes()), 0) << recipe.threads;
  }
}

} // namespace
} // namespace rend::assembly_test
