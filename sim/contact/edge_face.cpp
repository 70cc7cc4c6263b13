#include "sim/contact/edge_face.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr double parallel_edges = 1e-6; // the square of nearly_parallel

} // namespace

std::optional<std::array<double, 2>> nearest_within(const Segment& p, const Segment& q) {
  const Vec3 u = p[1] - p[0], v = q[1] - q[0], r = p[0] - q[0];
  const double a = u.squaredNorm(), b = u.dot(v), c = v.squaredNorm(), d = u.dot(r), e = v.dot(r);
  const double across = a * c - b * b;
  if (!(across > parallel_edges * a * c)) return {};
  const double s = (b * e - c * d) / across, t = (a * e - b * d) / across;
  if (!(s > 0 && s < 1 && t > 0 && t < 1)) return {};
  return std::array{s, t};
}

double least_distance(const Segment& p, const Segment& q) {
  const Vec3 u = p[1] - p[0], v = q[1] - q[0], r = p[0] - q[0];
  constexpr double none = std::numeric_limits<double>::min();
  const double a = std::max(u.squaredNorm(), none), b = u.dot(v), c = std::max(v.squaredNorm(), none),
               d = u.dot(r), e = v.dot(r);
  const double across = std::max(a * c - b * b, none);
  double s = std::clamp((b * e - c * d) / across, 0.0, 1.0);
  const double t = std::clamp((b * s + e) / c, 0.0, 1.0);
  s = std::clamp((b * t - d) / a, 0.0, 1.0);
  return (r + s * u - t * v).norm() - nearly_parallel * std::sqrt(std::min(a, c));
}

bool apart_by_planes(const Segment& x, const TriangleCorners& y, double reach) {
  const Vec3 across = (y[1] - y[0]).cross(y[2] - y[0]);
  const auto beyond = [&](const Vec3& corner, const Vec3& normal) { // on the positive side
    const double nearer = std::min(normal.dot(x[0] - corner), normal.dot(x[1] - corner));
    return nearer > 0 && nearer * nearer > reach * reach * normal.squaredNorm();
  };
  if (beyond(y[0], across) || beyond(y[0], -across)) return true;
  for (std::size_t k = 0; k < 3; ++k)
    if (beyond(y[k], (y[(k + 1) % 3] - y[k]).cross(across))) return true;
  return false;
}

// A corner of the triangle may be nearest to the middle of the segment: then its two sides are, at their ends.
EdgeFaceNearest nearest(const Segment& edge, const TriangleCorners& face) {
  EdgeFaceNearest best{.distance = std::numeric_limits<double>::infinity()};
  const auto take = [&](double share, const Weights& weight) {
    const double distance = (point_at(edge, share) - point_at(face, weight)).norm();
    if (distance < best.distance) best = {share, weight, distance};
  };
  for (const double share : {0.0, 1.0}) take(share, nearest_in_triangle(face, point_at(edge, share)));
  const Vec3 way = edge[1] - edge[0];
  const double length = way.squaredNorm();
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    Weights weight{};
    weight[k] = 1;
    if (length > 0) take(std::clamp(way.dot(face[k] - edge[0]) / length, 0.0, 1.0), weight);
    if (const auto shares = nearest_within(edge, {face[k], face[l]})) {
      weight[k] = 1 - (*shares)[1];
      weight[l] = (*shares)[1];
      take((*shares)[0], weight);
    }
  }
  return best;
}

bool passes_through(const Segment& edge, const TriangleCorners& face, double least) {
  const Vec3 across = (face[1] - face[0]).cross(face[2] - face[0]);
  const double area = across.norm();
  if (!(area > 0)) return false;
  const double low = across.dot(edge[0] - face[0]), high = across.dot(edge[1] - face[0]), off = least * area;
  if (!((low > off && high < -off) || (low < -off && high > off))) return false;
  const Vec3 at = point_at(edge, low / (low - high));
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 side = face[(k + 1) % 3] - face[k];
    if (across.dot(side.cross(at - face[k])) < -off * side.norm()) return false;
  }
  return true;
}

} // namespace rend
