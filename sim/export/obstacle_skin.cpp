#include "sim/export/obstacle_skin.h"

#include "sim/base/math.h"

#include <fmt/format.h>

#include <map>

namespace rend {
namespace {

constexpr int sphere_segments = 12; // per quarter of a turn

// Of the cube [-1, 1]³ whose sides have `segments`² quads.
void add_cube(ObstacleSkin& out, int segments) {
  std::map<std::array<int, 3>, std::int32_t> known; // lattice coordinates 0 .. segments → point
  const auto point = [&](int axis, int side, int i, int j) {
    std::array<int, 3> at{};
    at[static_cast<std::size_t>(axis)] = side * segments;
    at[static_cast<std::size_t>((axis + 1) % 3)] = i;
    at[static_cast<std::size_t>((axis + 2) % 3)] = j;
    const auto [entry, is_new] = known.try_emplace(at, static_cast<std::int32_t>(out.start.size()));
    if (is_new) {
      const auto coordinate = [&](int n) { return 2.0 * n / segments - 1; };
      out.start.emplace_back(coordinate(at[0]), coordinate(at[1]), coordinate(at[2]));
    }
    return entry->second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (int side = 0; side < 2; ++side)
      for (int i = 0; i < segments; ++i)
        for (int j = 0; j < segments; ++j) {
          std::array<std::int32_t, 4> quad{point(axis, side, i, j), point(axis, side, i + 1, j),
                                           point(axis, side, i + 1, j + 1), point(axis, side, i, j + 1)};
          if (side == 0) std::swap(quad[1], quad[3]);
          out.quads.push_back(quad);
        }
}

// Takes the points from where they are at time 0 to where they are at `time` [s]; at(t): the pose at a time.
// Velocities are difference quotients over a time that is short beside any motion.
template <class At> void move(ObstacleSkin& out, double time, At&& at) {
  constexpr double later = 0x1p-20; // [s]
  const Pose now = at(time), then = at(time + later);
  for (const Vec3& X : out.start) {
    out.points.push_back(now.of(X));
    out.velocities.push_back((then.of(X) - now.of(X)) / later);
  }
}

ObstacleSkin skin_of(const Sphere& sphere, double time) {
  ObstacleSkin out;
  add_cube(out, sphere_segments);
  for (Vec3& x : out.start) {
    x = x.unaryExpr([](double c) { return sine_of_degrees(45 * c) / cosine_of_degrees(45 * c); });
    x = sphere.start + sphere.radius * x.normalized();
  }
  move(out, time, [&](double t) {
    Pose pose = pose_of(sphere, t);
    if (!sphere.follows_keys()) pose.place += (t - time) * sphere.velocity;
    return pose;
  });
  return out;
}

ObstacleSkin skin_of(const Box& box, double time) {
  ObstacleSkin out;
  add_cube(out, 1);
  const Vec3 half = 0.5 * (box.high - box.low);
  for (Vec3& x : out.start) x = box.middle() + half.cwiseProduct(x);
  move(out, time, [&](double t) { return box.pose(t); });
  return out;
}

ObstacleSkin skin_of(const MeshObstacle& mesh, double time) {
  ObstacleSkin out;
  out.start = mesh.surface.points;
  for (const auto& [a, b, c] : mesh.surface.triangles)
    out.triangles.push_back(
        {static_cast<std::int32_t>(a), static_cast<std::int32_t>(b), static_cast<std::int32_t>(c)});
  move(out, time, [&](double t) { return mesh.pose(t); });
  return out;
}

} // namespace

Pose pose_of(const Sphere& sphere, double time) {
  Pose pose = sphere.motion.at(sphere.start, time);
  pose.origin = sphere.start;
  if (!sphere.follows_keys()) pose.place = sphere.centre;
  return pose;
}

std::vector<ObstacleSkin> obstacle_skins(const World& world, double time) {
  std::vector<ObstacleSkin> all;
  for (std::size_t n = 0; n < world.spheres.size(); ++n) {
    all.push_back(skin_of(world.spheres[n], time));
    all.back().name = fmt::format("sphere {}", n + 1);
  }
  for (std::size_t n = 0; n < world.boxes.size(); ++n) {
    all.push_back(skin_of(world.boxes[n], time));
    all.back().name = fmt::format("box {}", n + 1);
  }
  for (std::size_t n = 0; n < world.meshes.size(); ++n) {
    all.push_back(skin_of(world.meshes[n], time));
    all.back().name = fmt::format("obstacle {}", n + 1);
  }
  return all;
}

void add_obstacles(Skin& skin, const World& world) {
  for (const ObstacleSkin& obstacle : obstacle_skins(world, skin.time)) {
    const auto number = static_cast<std::int32_t>(skin.bodies.size());
    const auto first = static_cast<std::int32_t>(skin.vertex.size());
    for (std::size_t p = 0; p < obstacle.points.size(); ++p) {
      append(skin.points, obstacle.points[p]);
      append(skin.velocity, obstacle.velocities[p]);
      skin.vertex.push_back(static_cast<std::int32_t>(p));
      skin.body_of_point.push_back(number);
    }
    obstacle.each_face([&](std::span<const std::int32_t> face) {
      for (const std::int32_t p : face) skin.corners.push_back(first + p);
      skin.ends.push_back(static_cast<std::int64_t>(skin.corners.size()));
      skin.body_of_face.push_back(number);
      skin.fragment.push_back(-1);
      skin.element.push_back(0);
    });
    if (!skin.largest_stress.empty()) skin.largest_stress.resize(skin.vertex.size(), 0);
    if (!skin.exposed.empty()) skin.exposed.resize(skin.ends.size(), 0);
    if (!skin.equivalent.empty()) skin.equivalent.resize(skin.ends.size(), 0);
    if (!skin.texture.empty()) skin.texture.resize(skin.corners.size());
    skin.bodies.push_back(
        {.name = obstacle.name, .points_end = skin.vertex.size(), .faces_end = skin.ends.size()});
  }
}

} // namespace rend
