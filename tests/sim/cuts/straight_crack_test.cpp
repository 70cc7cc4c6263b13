// A strip with a slit that is pulled apart slowly: however its mesh is made and turned, the crack goes on
// straight across the pull.
#include "sim/mesh/mesh_files.h"
#include "sim/presets.h"
#include "sim/random_meshes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <span>

namespace rend::straight_crack_test {
namespace {

namespace fs = std::filesystem;

constexpr double edge = 0.02, half_length = 0.4, half_width = 0.36; // [m]
constexpr double way = 30 * edge;                                   // of the crack, after the slit [m]

struct Mesh {
  std::string name;
  std::optional<SheetPattern> pattern; // none: made by Gmsh
};

// Cut out of a lattice that is turned [degrees], along the edges that lie within the strip.
PolygonMesh strip(SheetPattern pattern, double turned) {
  const int cells = 60;
  PolygonMesh mesh = meshes::sheet(pattern, cells, cells);
  const double angle = turned * M_PI / 180, c = std::cos(angle), s = std::sin(angle);
  for (Vec3& x : mesh.points) {
    const Vec3 from = edge * (x - Vec3(cells / 2.0, cells / 2.0, 0));
    x = Vec3(c * from.x() - s * from.y(), s * from.x() + c * from.y(), 0);
  }
  const auto outside = [&](std::uint32_t p) {
    return std::abs(mesh.points[p].x()) > half_length + 1e-9 ||
           std::abs(mesh.points[p].y()) > half_width + 1e-9;
  };
  PolygonMesh strip;
  strip.first = {0};
  std::vector<std::uint32_t> number(mesh.points.size(), ~0u);
  for (std::size_t n = 0; n < mesh.polygons(); ++n) {
    const std::span corners(mesh.corners.data() + mesh.first[n], mesh.corners.data() + mesh.first[n + 1]);
    if (std::ranges::any_of(corners, outside)) continue;
    for (std::uint32_t p : corners) {
      if (number[p] == ~0u) {
        number[p] = static_cast<std::uint32_t>(strip.points.size());
        strip.points.push_back(mesh.points[p]);
      }
      strip.corners.push_back(number[p]);
    }
    strip.first.push_back(static_cast<std::uint32_t>(strip.corners.size()));
  }
  return strip;
}

// Its algorithms for triangles take the place of the angles.
fs::path strip_by_gmsh(const files::Folder& folder, const std::string& algorithm) {
  folder.write("strip.geo", fmt::format(R"(SetFactory("OpenCASCADE"); Rectangle(1) = {{{}, {}, 0, {}, {}}};)",
                                        -half_length, -half_width, 2 * half_length, 2 * half_width));
  folder.gmsh(fmt::format("-2 strip.geo -o strip.msh -clmin {} -clmax {} -algo {}", edge, edge, algorithm));
  return folder.path() / "strip.msh";
}

// With a slit "x y z x y z", until `done`.
template <class Done> presets::Loaded pulled(const fs::path& file, const std::string& slit, const Done& done) {
  const double held = half_length - 2 * edge;
  auto scene = presets::load(fmt::format(
      R"(<scene><body><mesh file="{}"/><slit along="{}"/>
        <mass density="1000" thickness="1e-3"/>
        <elasticity model="corotational" young="2e5" poisson="0.3" thickness="1e-3" damping-mass="500"
          damping-stiffness="5e-5"/>
        <drive box="-1 -1 -1  -{} 1 1" velocity="-0.03 0 0" axes="xz"/>
        <drive box="{} -1 -1  1 1 1" velocity="0.03 0 0" axes="xz"/>
        <tear criterion="vertex-stress" threshold="2.5e4" change="cut"/></body>
        <world gravity="0 0 0"/><time step="auto" duration="2"/></scene>)",
      file.string(), slit, held, held));
  while (!done(*scene.scene) && scene->time() < 3) scene->step();
  return scene;
}

// The places at rest [m] of each edge that is torn, twice: it has two sides.
template <class F> void for_each_torn_side(const Body& body, F&& f) {
  body.map->map().for_each_dart([&](Dart d) {
    const Dart e = body.map->map().alpha(0, d);
    if (body.map->map().is_free(2, d) && d < e && (*body.border)[body.map->slot(EdgeOfFace, d)] == 0)
      f(body.map->rest_of(d), body.map->rest_of(e));
  });
}

struct Crack {
  std::size_t fragments = 0;
  double length = 0, furthest = 0, mean = 0; // [m]: of one side; from the line x = 0
};

Crack crack_through(const fs::path& file) {
  const auto scene = pulled(file, fmt::format("0 {} 0  0 {} 0", -half_width - edge, half_width - way),
                            [](const Scene& now) { return now.fragments() >= 2; });
  Crack crack{.fragments = scene->fragments()};
  double sides = 0;
  for_each_torn_side(scene.body(), [&](const Vec3& a, const Vec3& b) {
    sides += (b - a).norm();
    crack.mean += (b - a).norm() * std::abs(a.x() + b.x()) / 2;
    crack.furthest = std::max({crack.furthest, std::abs(a.x()), std::abs(b.x())});
  });
  crack.length = sides / 2;
  crack.mean /= sides;
  return crack;
}

// By how much a crack turns at the ends of a slit of a fifth of the width that is inclined by 45°, over three
// edges from there [degrees]: the mean of both ends.
double turn_at_slit(const fs::path& file) {
  const double half = 0.2 * half_width / std::sqrt(2.0);
  const Vec3 tip(half, half, 0);
  const auto reached = [&](const Body& body) { // the direction from each end [degrees]; NaN: not reached
    std::array<double, 2> sum{}, edges{};
    for_each_torn_side(body, [&](const Vec3& a, const Vec3& b) {
      for (const std::size_t end : {0u, 1u}) {
        const Vec3 origin = end == 0 ? tip : Vec3(-tip), one = a - origin, other = b - origin;
        const double near = std::min(one.norm(), other.norm()), far = std::max(one.norm(), other.norm());
        if (!(near < 3 * edge && far >= 3 * edge)) continue;
        const Vec3 at = one + (3 * edge - one.norm()) / (other.norm() - one.norm()) * (other - one);
        const double angle = std::atan2(at.y(), at.x()) * 180 / M_PI - 45 + (end == 0 ? 0 : 180);
        sum[end] += angle > 180 ? angle - 360 : angle;
        ++edges[end];
      }
    });
    return std::array{sum[0] / edges[0], sum[1] / edges[1]};
  };
  const auto scene =
      pulled(file, fmt::format("{} {} 0  {} {} 0", -half, -half, half, half), [&](const Scene& now) {
        const auto [one, other] = reached(*now.bodies()[0]);
        return std::isfinite(one) && std::isfinite(other);
      });
  const auto [one, other] = reached(scene.body());
  return (one + other) / 2;
}

class StraightCrack : public testing::TestWithParam<Mesh> {
protected:
  static constexpr std::array angles{0.0, 15.0, 30.0, 45.0};
  static constexpr std::array algorithms{"meshadapt", "del2d", "front2d"};
  std::size_t meshes() const { return GetParam().pattern ? angles.size() : algorithms.size(); }
  std::string name(std::size_t n) const {
    return GetParam().name + (GetParam().pattern ? fmt::format(" turned by {}", angles[n])
                                                 : fmt::format(" by {}", algorithms[n]));
  }
  fs::path mesh(std::size_t n) const {
    return GetParam().pattern
               ? folder_.write("strip.obj", files::obj_text(strip(*GetParam().pattern, angles[n])))
               : strip_by_gmsh(folder_, algorithms[n]);
  }
  files::Folder folder_;
};

TEST_P(StraightCrack, goes_on_across_the_pull) {
  for (std::size_t n = 0; n < meshes(); ++n) {
    const Crack crack = crack_through(mesh(n));
    const std::string figures =
        fmt::format("{}: {} fragments, length {:.3f}, furthest {:.2f} edges, mean {:.2f} edges", name(n),
                    crack.fragments, crack.length / way, crack.furthest / edge, crack.mean / edge);
    std::puts(figures.c_str());
    SCOPED_TRACE(figures);
    EXPECT_EQ(crack.fragments, 2u);
    EXPECT_LE(crack.length, 1.03 * way);
    EXPECT_GE(crack.length, 0.93 * way);
    EXPECT_LE(crack.furthest, 1.6 * edge);
    EXPECT_LE(crack.mean, 0.7 * edge);
  }
}

// At the tip the largest hoop stress turns it by 53° (cut_test.cpp), and then the pull by 45°: between the
// two, since the way is nearly as long as half of the slit.
TEST_P(StraightCrack, turns_alike_at_an_inclined_slit) {
  for (std::size_t n = 0; n < meshes(); ++n) {
    const double turn = turn_at_slit(mesh(n));
    std::puts(fmt::format("{}: turns by {:.1f} degrees", name(n), turn).c_str());
    EXPECT_GT(turn, 45) << name(n);
    EXPECT_LT(turn, 53) << name(n);
  }
}

INSTANTIATE_TEST_SUITE_P(In, StraightCrack,
                         testing::Values(Mesh{"triangles", SheetPattern::Triangles},
                                         Mesh{"crossed", SheetPattern::Crossed}, Mesh{"unstructured", {}}),
                         [](const auto& of) { return of.param.name; });

} // namespace
} // namespace rend::straight_crack_test
