// The kernels against the laws that they implement, row by row.
#include "sim/rows/kernels.h"

#include "sim/mechanics/hinge_law.h"
#include "sim/mechanics/spring_law.h"
#include "sim/random_meshes.h"

#include <gtest/gtest.h>

namespace rend::kernels_test {
namespace {

using namespace meshes;

struct Springs {
  PackedRows rows{4, 2, 3};
  std::vector<Record> x, v;
  std::vector<std::array<std::uint32_t, 4>> index;
  std::vector<UnitParameters> parameters;
};

Springs random_springs(std::size_t count, std::uint32_t vertices, unsigned seed, bool damped) {
  Noise noise(seed);
  Springs s;
  if (!damped) s.rows = PackedRows(4, 2, 3, spring_law()->damping_value());
  for (std::uint32_t n = 0; n < vertices; ++n) {
    s.x.push_back(Record(noise.vector()));
    s.v.push_back(Record(noise.vector()));
  }
  s.x[3] = s.x[4]; // a spring of length 0
  s.rows.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    const auto i = static_cast<std::uint32_t>(noise.below(vertices - 1));
    const auto j = static_cast<std::uint32_t>(n == 0 ? 4 : i + 1 + noise.below(vertices - 1 - i));
    s.index.push_back(
        {n == 0 ? 3 : i, j, static_cast<std::uint32_t>(2 * n), static_cast<std::uint32_t>(2 * n + 1)});
    s.parameters.push_back({5 + noise(), 0.5 + 0.3 * noise(), 1 + 0.5 * noise()});
    const double values[] = {s.parameters[n].k, s.parameters[n].damping, s.parameters[n].rest};
    s.rows.set(n, s.index[n].data(), values);
  }
  s.rows.seal();
  return s;
}

KernelArguments arguments(const Springs& s, std::vector<Record>& force, std::uint32_t low, std::uint32_t high,
                          bool damped) {
  return {*spring_law(), s.rows, s.x.data(), s.v.data(),      s.x.data(), force.data(),
          low,           high,   0,          s.rows.blocks(), damped};
}

TEST(SpringKernel, adds_what_the_law_says) {
  for (const bool damped : {false, true}) {
    for (const std::size_t count : {1u, 3u, 64u, 65u, 301u}) {
      const Springs s = random_springs(count, 40, 5, damped);
      std::vector<Record> force(40), corner(2 * count), expected(40), expected_corner(2 * count);
      for (std::size_t n = 0; n < count; ++n) {
        UnitParameters p = s.parameters[n];
        if (!damped) p.damping = 0;
        const auto [i, j, ci, cj] = s.index[n];
        const Vec3 f = spring_force(p, s.x[i], s.x[j], s.v[i], s.v[j]);
        expected[i] = Record(expected[i].vec() + f);
        expected[j] = Record(expected[j].vec() - f);
        expected_corner[ci] = Record(f);
        expected_corner[cj] = Record(-f);
      }
      spring_kernel().forces(arguments(s, force, 0, 40, damped));
      spring_kernel().corner_forces(arguments(s, corner, 0, 0, damped));
      EXPECT_LT(difference(force, expected), 1e-14);
      EXPECT_LT(difference(corner, expected_corner), 1e-14);
      for (const Record& f : force) EXPECT_EQ(f.w, 0); // four lanes, three of them used
      EXPECT_EQ(corner[0].vec(), Vec3(0, 0, 0));
    }
  }
}

TEST(SpringKernel, gives_each_part_of_the_vertices_the_bytes_of_the_whole) {
  const Springs s = random_springs(500, 100, 6, true);
  std::vector<Record> whole(100), parts(100);
  spring_kernel().forces(arguments(s, whole, 0, 100, true));
  for (const auto& [low, high] : {std::pair{0u, 13u}, {13u, 14u}, {14u, 77u}, {77u, 100u}})
    spring_kernel().forces(arguments(s, parts, low, high, true));
  for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_EQ(whole[n].vec(), parts[n].vec());
}

// Hinges between random vertices, some of them of triangles, some degenerate.
struct Hinges {
  PackedRows rows{16, 8, 4};
  std::vector<Record> x, v;
  std::vector<std::array<std::uint32_t, 16>> index;
  std::vector<HingeParameters> parameters;

  Hinges(std::size_t count, std::size_t vertices, unsigned seed, bool damped) {
    if (!damped) rows = PackedRows(16, 8, 4, hinge_law()->damping_value());
    Noise noise(seed);
    for (std::size_t n = 0; n < vertices; ++n) {
      x.push_back(Record(noise.vector()));
      v.push_back(Record(noise.vector()));
    }
    x[4] = x[3];
    for (std::size_t n = 5; n < 8; ++n) x[n] = Record(0.5 * static_cast<double>(n), 0, 0); // exactly collinear
    rows.resize(count);
    for (std::size_t n = 0; n < count; ++n) {
      std::array<std::uint32_t, 16> at{};
      const std::size_t start = n < 3 ? 3 * n : noise.below(vertices);
      for (std::uint32_t p = 0; p < 8; ++p) {
        at[p] = static_cast<std::uint32_t>((start + 3 * p) % vertices);
        at[8 + p] = static_cast<std::uint32_t>(8 * n + p);
      }
      at[1] = static_cast<std::uint32_t>((start + 1) % vertices); // for 3, a hinge of length 0
      if (n % 3 == 1) at[3] = at[2], at[7] = at[6];
      if (n == 2) at = {5, 6, 7, 7, 5, 6, 8, 9, 16, 17, 18, 19, 20, 21, 22, 23}; // a side without area
      at[4] = at[0];
      at[5] = at[1];
      index.push_back(at);
      const double least = n % 2 == 0 ? 0 : 0.1 * (1 + noise()); // many are crushed
      parameters.push_back({5 + noise(), 0.5 + 0.3 * noise(), 3 * noise(), least});
      const double values[] = {parameters[n].k, parameters[n].damping, parameters[n].rest, least};
      rows.set(n, at.data(), values);
    }
    rows.seal();
  }

  KernelArguments arguments(std::vector<Record>& force, std::uint32_t low, std::uint32_t high,
                            bool damped) const {
    return {*hinge_law(), rows, x.data(), v.data(),      x.data(), force.data(),
            low,          high, 0,        rows.blocks(), damped};
  }
};

TEST(HingeKernel, adds_what_the_law_says) {
  for (const bool damped : {false, true}) {
    for (const std::size_t count : {1u, 3u, 64u, 65u, 301u}) {
      const Hinges h(count, 60, 5, damped);
      std::vector<Record> force(60), corner(8 * count), expected(60), expected_corner(8 * count);
      for (std::size_t n = 0; n < count; ++n) {
        HingeParameters p = h.parameters[n];
        if (!damped) p.damping = 0;
        HingePoints x, v;
        for (std::size_t m = 0; m < 8; ++m) {
          x[m] = h.x[h.index[n][m]];
          v[m] = h.v[h.index[n][m]];
        }
        const HingePoints f = hinge_forces(p, x, v);
        for (std::size_t m = 0; m < 8; ++m) {
          expected[h.index[n][m]] = Record(expected[h.index[n][m]].vec() + f[m]);
          expected_corner[h.index[n][8 + m]] = Record(f[m]);
        }
      }
      hinge_kernel().forces(h.arguments(force, 0, 60, damped));
      hinge_kernel().corner_forces(h.arguments(corner, 0, 0, damped));
      EXPECT_GT(largest(expected), 0.1);
      EXPECT_LT(difference(force, expected), 1e-13);
      EXPECT_LT(difference(corner, expected_corner), 1e-13);
      for (const Record& f : force) EXPECT_EQ(f.w, 0); // four lanes, three of them used
      if (count < 3) continue;
      for (std::size_t n : {1u, 2u})
        for (std::size_t m = 0; m < 8; ++m) EXPECT_EQ(corner[8 * n + m].vec(), Vec3(0, 0, 0)) << n;
    }
  }
}

TEST(HingeKernel, gives_each_part_of_the_vertices_the_bytes_of_the_whole) {
  const Hinges h(500, 100, 6, true);
  std::vector<Record> whole(100), parts(100);
  hinge_kernel().forces(h.arguments(whole, 0, 100, true));
  for (const auto& [low, high] : {std::pair{0u, 13u}, {13u, 14u}, {14u, 77u}, {77u, 100u}})
    hinge_kernel().forces(h.arguments(parts, low, high, true));
  for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_EQ(whole[n].vec(), parts[n].vec());
}

TEST(HingeKernel, gives_a_warped_sheet_at_rest_no_force_to_the_bit) {
  Recipe recipe;
  recipe.springs = {{"bend", "angular", 2, 0.3}};
  for (const Named& each : irregular()) {
    const auto sheet = body(each.mesh, recipe);
    if (sheet->interactions.empty()) continue;
    EXPECT_EQ(kernel_of(*sheet->interactions[0]->law).forces, hinge_kernel().forces);
    std::vector<Record> force(sheet->program->vertices());
    sheet->program->forces(positions(*sheet), velocities(*sheet), force.data());
    EXPECT_EQ(largest(force), 0) << each.name;
    shake(*sheet, 0.1, 3);
    sheet->program->forces(positions(*sheet), velocities(*sheet), force.data());
    EXPECT_GT(largest(force), 0.01) << each.name;
  }
}

TEST(PlainKernel, gives_each_part_of_the_vertices_the_bytes_of_the_whole) {
  Recipe recipe;
  recipe.springs = {{"bend", "angular", 2, 0.3}};
  const auto sheet = body(warped(meshes::sheet(SheetPattern::Mixed, 6, 6), 0.2, 7), recipe);
  shake(*sheet, 0.2, 8);
  const PackedRows& rows = sheet->program->folded()[0].rows();
  const auto count = static_cast<std::uint32_t>(sheet->program->vertices());
  std::vector<Record> whole(count), parts(count);
  const auto run = [&](std::vector<Record>& force, std::uint32_t low, std::uint32_t high) {
    plain_kernel().forces({*hinge_law(), rows, positions(*sheet), velocities(*sheet), positions(*sheet),
                           force.data(), low, high, 0, rows.blocks(), true});
  };
  run(whole, 0, count);
  for (const auto& [low, high] : {std::pair{0u, 13u}, {13u, 14u}, {14u, 40u}, {40u, count}})
    run(parts, low, high);
  EXPECT_GT(largest(whole), 0.01);
  for (std::size_t n = 0; n < count; ++n) EXPECT_EQ(whole[n].vec(), parts[n].vec());
}

} // namespace
} // namespace rend::kernels_test
