// An edge and a face that must not go through each other: their nearest points, and whether one passes through
// the other. Free of bodies, so that it can be tested alone.
#pragma once

#include "sim/outside/obstacle.h"

#include <array>
#include <optional>

namespace rend {

using Segment = std::array<Vec3, 2>; // [m]

inline Vec3 point_at(const Segment& x, double share) {
  return x[0] + share * (x[1] - x[0]);
}
inline Vec3 point_at(const TriangleCorners& x, const Weights& w) {
  return w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
}

// The sine of the angle between two segments below which they are parallel.
constexpr double nearly_parallel = 1e-3;

// The nearest points of two segments, as shares of the way along each, if both lie between the ends (Ericson,
// Real-Time Collision Detection, 5.1.9). None of parallel ones.
std::optional<std::array<double, 2>> nearest_within(const Segment& p, const Segment& q);

// A lower bound [m] of the distance of two segments (the same source): the distance that was found, less
// nearly_parallel times the shorter length, by which it may be too large where they are nearly parallel.
double least_distance(const Segment& p, const Segment& q);

// Whether all of the segment is farther than `reach` [m] from the triangle: in front of its plane, behind it,
// or beyond one of its sides. False says nothing.
bool apart_by_planes(const Segment& edge, const TriangleCorners& face, double reach);

// The nearest points of a segment and a triangle that it does not pass through: at an end of the segment, or on
// a side of the triangle. Where they are of sides that are nearly parallel, the distance may be too large by
// that share of the shorter one.
struct EdgeFaceNearest {
  double share = 0; // of the way along the segment
  Weights weight{};
  double distance = 0; // [m]
};
EdgeFaceNearest nearest(const Segment& edge, const TriangleCorners& face);

// Whether the segment passes through the triangle: its ends lie more than `least` [m] off the plane on either
// side, and it meets the plane within the triangle, or no farther than that off its sides (so that nothing
// slips through between two triangles). False for a triangle without area.
bool passes_through(const Segment& edge, const TriangleCorners& face, double least);

} // namespace rend
