#include "sim/contact/surface_tree.h"

#include "sim/base/check.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

namespace rend {
namespace {

using Bounds = Eigen::AlignedBox3d;

constexpr double at_border = 1e-12; // weights down to minus this: the segment still meets the face

// Möller & Trumbore, "Fast, Minimum Storage Ray/Triangle Intersection", 1997.
std::optional<SurfaceTree::Crossing> where_through(const Vec3& from, const Vec3& way,
                                                   const TriangleCorners& x) {
  const Vec3 ab = x[1] - x[0], ac = x[2] - x[0], across = way.cross(ac);
  const double scale = ab.dot(across);
  if (std::abs(scale) <= 1e-14 * way.norm() * ab.norm() * ac.norm()) return {}; // parallel to it
  const Vec3 to = from - x[0], turned = to.cross(ab);
  const double b = to.dot(across) / scale, c = way.dot(turned) / scale, share = ac.dot(turned) / scale;
  if (b < -at_border || c < -at_border || b + c > 1 + at_border || share < 0 || share > 1) return {};
  return SurfaceTree::Crossing{share, 0, {1 - b - c, b, c}};
}

// For Eigen's BVIntersect: the triangles whose boxes a segment meets.
struct AlongSegment {
  Vec3 from, way;
  const std::vector<TriangleCorners>* corners;
  std::vector<SurfaceTree::Crossing>* out;

  bool intersectVolume(const Bounds& box) const {
    double in = 0, beyond = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = box.min()[axis] - from[axis], high = box.max()[axis] - from[axis], d = way[axis];
      if (d == 0) {
        if (low > 0 || high < 0) return false;
        continue;
      }
      in = std::max(in, std::min(low / d, high / d));
      beyond = std::min(beyond, std::max(low / d, high / d));
    }
    return in <= beyond + 1e-9;
  }
  bool intersectObject(std::uint32_t triangle) const {
    if (auto found = where_through(from, way, (*corners)[triangle])) {
      found->triangle = triangle;
      out->push_back(*found);
    }
    return false; // go on
  }
};

// For Eigen's BVMinimize: the squared distance of a point.
struct NearPoint {
  using Scalar = double;
  Vec3 point;
  const std::vector<TriangleCorners>* corners;
  SurfaceTree::Nearest* best;

  double minimumOnVolume(const Bounds& box) const { return box.squaredExteriorDistance(point); }
  double minimumOnObject(std::uint32_t triangle) const {
    const TriangleCorners& x = (*corners)[triangle];
    const Weights w = nearest_in_triangle(x, point);
    const Vec3 there = w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
    const double distance = (point - there).norm();
    if (distance < best->distance) {
      best->point = there;
      best->distance = distance;
      best->triangle = triangle;
    }
    return distance * distance;
  }
};

// For Eigen's BVIntersect: the triangles nearer to a point than that.
struct WithinReach {
  Vec3 point;
  double reach; // [m]
  const std::vector<TriangleCorners>* corners;
  std::vector<SurfaceTree::Nearest>* out;

  bool intersectVolume(const Bounds& box) const { return box.squaredExteriorDistance(point) < reach * reach; }
  bool intersectObject(std::uint32_t triangle) const {
    const TriangleCorners& x = (*corners)[triangle];
    const Weights w = nearest_in_triangle(x, point);
    const Vec3 there = w[0] * x[0] + w[1] * x[1] + w[2] * x[2];
    const double distance = (point - there).norm();
    if (distance < reach) out->push_back({there, Vec3::UnitZ(), distance, triangle});
    return false; // go on
  }
};

} // namespace

SurfaceTree::SurfaceTree(const ContactFaces& faces, const std::vector<Record>& position, bool solid)
    : solid_(solid) {
  std::vector<Bounds> boxes;
  for (const ContactFaces::Triangle& t : faces.triangles()) {
    corners_.push_back({position[t.vertex[0]].vec(), position[t.vertex[1]].vec(), position[t.vertex[2]].vec()});
    Bounds box(corners_.back()[0]);
    box.extend(corners_.back()[1]).extend(corners_.back()[2]);
    boxes.push_back(box);
    bounds_.extend(box);
  }
  std::vector<std::uint32_t> all(corners_.size());
  std::iota(all.begin(), all.end(), 0U);
  if (!all.empty()) tree_ = Tree(all.begin(), all.end(), boxes.begin(), boxes.end());
}

Vec3 SurfaceTree::normal(std::uint32_t triangle) const {
  const TriangleCorners& x = corners_[triangle];
  const Vec3 area = (x[1] - x[0]).cross(x[2] - x[0]);
  const double size = area.norm();
  return size > 0 ? Vec3(area / size) : Vec3(Vec3::Zero());
}

SurfaceTree::Nearest SurfaceTree::nearest(const Vec3& point) const {
  CHECK(!corners_.empty());
  Nearest best;
  best.distance = std::numeric_limits<double>::infinity();
  NearPoint near{point, &corners_, &best};
  Eigen::BVMinimize(tree_, near);
  best.normal = normal(best.triangle);
  return best;
}

std::vector<SurfaceTree::Nearest> SurfaceTree::within(const Vec3& point, double reach) const {
  std::vector<Nearest> found;
  if (corners_.empty()) return found;
  WithinReach look{point, reach, &corners_, &found};
  Eigen::BVIntersect(tree_, look);
  for (Nearest& each : found) each.normal = normal(each.triangle);
  std::sort(found.begin(), found.end(), [](const Nearest& a, const Nearest& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
  });
  return found;
}

bool SurfaceTree::inside(const Vec3& point) const {
  if (!solid_ || corners_.empty() || !bounds_.contains(point)) return false;
  const Vec3 direction = Vec3(0.5352901, 0.3117317, 0.7850123);
  return crossings(point, point + 2 * bounds_.diagonal().norm() * direction).size() % 2 == 1;
}

std::vector<SurfaceTree::Crossing> SurfaceTree::crossings(const Vec3& from, const Vec3& to) const {
  std::vector<Crossing> found;
  if (corners_.empty()) return found;
  AlongSegment along{from, to - from, &corners_, &found};
  Eigen::BVIntersect(tree_, along);
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& b) {
    return a.share != b.share ? a.share < b.share : a.triangle < b.triangle;
  });
  return found;
}

// Eigen's tree tells nothing of itself: for n triangles it has their n indices and n − 1 nodes, each a box with
// the indices of its two children.
std::size_t SurfaceTree::bytes() const {
  const std::size_t triangles = corners_.size(), nodes = triangles > 0 ? triangles - 1 : 0;
  return bytes_of(corners_) + triangles * sizeof(std::uint32_t) + nodes * (sizeof(Bounds) + 2 * sizeof(int));
}

} // namespace rend
