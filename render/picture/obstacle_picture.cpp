#include "render/picture/obstacle_picture.h"

#include "sim/base/math.h"

#include <algorithm>
#include <utility>

namespace rend {
namespace {

constexpr int sphere_segments = 16; // per eighth of a turn: deviates from a circle by 0.06 % of the radius
constexpr int box_segments = 3;
constexpr double crease = 0.766;  // the cosine of 40 degrees: a sharper edge of a mesh is one in a picture
constexpr double rounding = 0.02; // radius of a box's rounded edges, in parts of its smallest size

// Positions along one side of a cube: from −1 to 1, with 0 twice, once for each half.
struct Tick {
  double at, half; // half: −1 or 1
};
std::vector<Tick> ticks(int segments) {
  std::vector<Tick> all;
  for (int half = -1; half <= 1; half += 2)
    for (int n = 0; n <= segments; ++n) {
      const double share = static_cast<double>(half < 0 ? segments - n : n) / segments;
      const double tangent =
          sine_of_degrees(45 * share) / cosine_of_degrees(45 * share); // equal angles on the sphere
      all.push_back({half * tangent, static_cast<double>(half)});
    }
  return all;
}

struct Lattice {
  Vec3 centre, core;
  double radius;
  Corner at(int axis, double side, const Tick& a, const Tick& b, const Colour& colour) const {
    Vec3 direction, half;
    direction[axis] = half[axis] = side;
    direction[(axis + 1) % 3] = a.at;
    half[(axis + 1) % 3] = a.half;
    direction[(axis + 2) % 3] = b.at;
    half[(axis + 2) % 3] = b.half;
    direction.normalize();
    const Vec3 x = centre + half.cwiseProduct(core) + radius * direction;
    return {as_floats(x), as_floats(direction), {colour[0], colour[1], colour[2], 255}, {0, 0, 0, 0}};
  }
};

} // namespace

template <> const Fields<SphereLook>& fields_of() {
  static const Fields<SphereLook> fields{colour_field(&SphereLook::colour, text("colour", "#rrggbb"))};
  return fields;
}

template <> const Fields<BoxLook>& fields_of() {
  static const Fields<BoxLook> fields{colour_field(&BoxLook::colour, text("colour", "#rrggbb"))};
  return fields;
}

template <> const Fields<MeshLook>& fields_of() {
  static const Fields<MeshLook> fields{colour_field(&MeshLook::colour, text("colour", "#rrggbb"))};
  return fields;
}

FrameBody rounded_box(const Vec3& centre, const Vec3& core, double radius, int segments, const Colour& colour) {
  FrameBody out;
  out.edges = false;
  out.two_sided = false;
  const Lattice lattice{centre, core, radius};
  const std::vector<Tick> tick = ticks(segments);
  for (int axis = 0; axis < 3; ++axis)
    for (double side : {-1.0, 1.0})
      for (std::size_t i = 0; i + 1 < tick.size(); ++i)
        for (std::size_t j = 0; j + 1 < tick.size(); ++j) {
          const auto corner = [&](std::size_t a, std::size_t b) {
            return lattice.at(axis, side, tick[i + a], tick[j + b], colour);
          };
          Corner quad[4] = {corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)};
          if (side < 0) std::swap(quad[1], quad[3]);
          for (int k : {0, 1, 2, 0, 2, 3}) out.corners.push_back(quad[k]);
        }
  return out;
}

FrameBody picture_of(const Sphere& sphere, const SphereLook& look) {
  return rounded_box(sphere.centre, Vec3::Zero(), sphere.radius, sphere_segments, look.colour);
}

FrameBody picture_of(const Box& box, const BoxLook& look, double time) {
  const Vec3 size = box.high - box.low;
  const double radius = rounding * size.minCoeff();
  FrameBody picture =
      rounded_box(box.middle(), 0.5 * size - Vec3::Constant(radius), radius, box_segments, look.colour);
  return box.moves() ? moved(std::move(picture), box.pose(time)) : picture;
}

FrameBody moved(FrameBody picture, const Pose& pose) {
  const auto as_vector = [](const std::array<float, 3>& v) { return Vec3(v[0], v[1], v[2]); };
  for (Corner& corner : picture.corners) {
    corner.position = as_floats(pose.of(as_vector(corner.position)));
    corner.normal = as_floats(pose.turn * as_vector(corner.normal));
  }
  return picture;
}

FrameBody picture_of(const MeshObstacle& mesh, const MeshLook& look) {
  const ObstacleSurface& surface = mesh.surface;
  std::vector<Vec3> area; // [m²], twice, one per triangle: its normal
  std::vector<std::vector<std::uint32_t>> around(surface.points.size()); // the triangles at each point
  for (const auto& [a, b, c] : surface.triangles) {
    for (const std::uint32_t corner : {a, b, c})
      around[corner].push_back(static_cast<std::uint32_t>(area.size()));
    const Vec3& x = surface.points[a];
    area.push_back((surface.points[b] - x).cross(surface.points[c] - x));
  }
  FrameBody out;
  out.edges = false;
  out.two_sided = !surface.closed;
  for (std::size_t t = 0; t < area.size(); ++t)
    for (const std::uint32_t corner : surface.triangles[t]) {
      Vec3 normal = Vec3::Zero();
      for (const std::uint32_t other : around[corner])
        if (area[other].dot(area[t]) > crease * area[other].norm() * area[t].norm()) normal += area[other];
      out.corners.push_back({as_floats(surface.points[corner]),
                             as_floats(normal.normalized()),
                             {look.colour[0], look.colour[1], look.colour[2], 255},
                             {0, 0, 0, 0}});
    }
  return out;
}

} // namespace rend
