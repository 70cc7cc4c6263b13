// Mesh files of simple surfaces for tests, as .obj, in the folder of temporary files.
#pragma once

#include "sim/base/record.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace rend::mesh_files {

using Corners = std::vector<std::vector<std::uint32_t>>; // of polygons, from 0

// The path of a new file; tests that run at once have their own.
inline std::string written(const std::string& name, const std::string& text) {
  const std::string path = fmt::format("{}rend-{}-{}", testing::TempDir(), ::getpid(), name);
  std::ofstream(path) << text;
  return path;
}

inline std::string obj(const std::vector<Vec3>& points, const Corners& polygons) {
  std::string text;
  for (const Vec3& x : points) text += fmt::format("v {} {} {}\n", x.x(), x.y(), x.z());
  for (const auto& polygon : polygons) {
    text += "f";
    for (const std::uint32_t corner : polygon) text += fmt::format(" {}", corner + 1);
    text += "\n";
  }
  return text;
}

inline std::vector<Vec3> corners_of_box(const Vec3& low, const Vec3& high) {
  std::vector<Vec3> points;
  for (int n = 0; n < 8; ++n)
    points.emplace_back(n & 1 ? high.x() : low.x(), n & 2 ? high.y() : low.y(), n & 4 ? high.z() : low.z());
  return points;
}

// Counter-clockwise as seen from outside.
inline const Corners quads_of_box{{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                  {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};

inline std::string box(const std::string& name, const Vec3& low, const Vec3& high) {
  return written(name, obj(corners_of_box(low, high), quads_of_box));
}

// An icosahedron, of which each triangle is divided into four so many times; on a sphere about the origin.
inline std::string ball(const std::string& name, double radius, int divisions) {
  const double g = 0.5 * (1 + std::sqrt(5.0));
  std::vector<Vec3> points{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                           {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
  Corners faces{{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int n = 0; n < divisions; ++n) {
    std::map<std::array<std::uint32_t, 2>, std::uint32_t> middle;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, added] =
          middle.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<std::uint32_t>(points.size()));
      if (added) points.push_back(points[a] + points[b]);
      return at->second;
    };
    Corners finer;
    for (const auto& f : faces) {
      const std::uint32_t ab = between(f[0], f[1]), bc = between(f[1], f[2]), ca = between(f[2], f[0]);
      for (const auto& part : Corners{{f[0], ab, ca}, {f[1], bc, ab}, {f[2], ca, bc}, {ab, bc, ca}})
        finer.push_back(part);
    }
    for (Vec3& x : points) x.normalize();
    faces = finer;
  }
  for (Vec3& x : points) x = radius * x.normalized();
  return written(name, obj(points, faces));
}

} // namespace rend::mesh_files
