// Random heaps of bars, cubes and sheets, and how many of their edges go through faces: counted one by one, by
// signs of volumes.
#pragma once

#include "sim/contact/edge_face.h"
#include "sim/presets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <string>

namespace rend::heaps {

inline double volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a);
}

// By more than rounding.
inline bool goes_through(const Segment& edge, const TriangleCorners& face) {
  const auto& [x, y, z] = face;
  const auto& [p, q] = edge;
  const double low = volume(x, y, z, p), high = volume(x, y, z, q);
  const double least = 1e-9 * (y - x).cross(z - x).norm();
  if (low * high >= 0 || std::min(std::abs(low), std::abs(high)) < least) return false;
  const double u = volume(p, q, x, y), v = volume(p, q, y, z), w = volume(p, q, z, x);
  const bool inside = (u > 0) == (v > 0) && (v > 0) == (w > 0);
  return inside && std::min({std::abs(u), std::abs(v), std::abs(w)}) > 1e-9 * (q - p).norm();
}

// [m], between steps: those of an obstacle are where the last step has left them.
inline Vec3 now(const ContactBody& body, Slot v) {
  return body.body ? body.from(v) : body.position(v).vec();
}

// How many edges of one go through faces of the other, or of itself.
inline int crossings(const ContactBody& of, const ContactBody& in) {
  std::set<std::array<Slot, 2>> edges;
  for (const auto& triangle : of.faces->triangles())
    for (std::size_t k = 0; k < 3; ++k) {
      const Slot a = triangle.vertex[k], b = triangle.vertex[(k + 1) % 3];
      edges.insert({std::min(a, b), std::max(a, b)});
    }
  int count = 0;
  for (const auto& triangle : in.faces->triangles()) {
    const auto& corner = triangle.vertex;
    for (const auto& [a, b] : edges) {
      if (&of == &in && std::any_of(corner.begin(), corner.end(), [&](Slot v) { return v == a || v == b; }))
        continue;
      count +=
          goes_through({now(of, a), now(of, b)}, {now(in, corner[0]), now(in, corner[1]), now(in, corner[2])});
    }
  }
  return count;
}

inline int crossings(const Scene& scene) {
  const auto& bodies = scene.contacts()->bodies();
  int count = 0;
  for (const auto& a : bodies)
    for (const auto& b : bodies)
      if ((a != b && (a->body || b->body)) || a->settings().self) count += crossings(*a, *b);
  return count;
}

inline std::string body(const std::string& name, const std::string& mesh, const Vec3& at, const Vec3& turn,
                        const Vec3& velocity, double thickness, bool obstacles) {
  return fmt::format(R"(<body name="{}">{}<place rotate="{} {} {}" translate="{} {} {}" velocity="{} {} {}"/>)"
                     R"(<mass total="1"/><springs><stretch k="3000" damping="0.3"/></springs>)"
                     R"(<contact with="{}fragments" thickness="{}" friction="0.3"/></body>)",
                     name, mesh, turn.x(), turn.y(), turn.z(), at.x(), at.y(), at.z(), velocity.x(),
                     velocity.y(), velocity.z(), obstacles ? "obstacles " : "", thickness);
}

// Bars, cubes and sheets at random places, which fly into each other.
inline std::string heap(int seed, const std::string& world) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  std::uniform_real_distribution<double> unit(-1, 1), angle(0, 360);
  const std::array<std::string, 4> meshes{R"(<bar pattern="tetrahedra" cells="3 1 1" size="0.6 0.15 0.15"/>)",
                                          R"(<bar pattern="hexahedra" cells="1 1 1" size="0.3 0.3 0.3"/>)",
                                          R"(<sheet pattern="triangles" cells="3 3" size="0.6 0.6"/>)",
                                          R"(<bar pattern="tetrahedra" cells="1 1 1" size="0.02 0.5 0.02"/>)"};
  const auto vec = [&](double size) {
    const double x = unit(random), y = unit(random), z = unit(random);
    return Vec3(size * x, size * y, size * z);
  };
  std::string bodies;
  for (int n = 0; n < 6; ++n) {
    const Vec3 at = Vec3(n % 2, n / 2 % 2, 0.9 * n + 1.1), turn(angle(random), angle(random), angle(random));
    const Vec3 to = Vec3(0.3, 0.3, 1.5) + vec(0.2);
    bodies += body(fmt::format("b{}", n), meshes[random() % meshes.size()], at, turn,
                   4 * (to - at).normalized() + vec(0.5), random() % 2 ? 1e-3 : 1e-5,
                   world.find("box") != std::string::npos || world.find("obstacle") != std::string::npos);
  }
  return "<scene>" + bodies + world + R"(<time step="2e-4" duration="2"/></scene>)";
}

} // namespace rend::heaps
