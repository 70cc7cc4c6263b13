// The faces of a body in a tree of bounding boxes, where they are now: the nearest point of them, whether a
// point lies inside a solid, and where a segment goes through them. For faces that stay as they are: at the
// start, and of mesh obstacles; contact_pairs.h holds the trees of contact.
//
// A point lies inside if a ray from it meets the faces an odd number of times. Its direction is along no axis
// and in no plane of symmetry, so that it meets no edge of meshes that lie along the axes.
#pragma once

#include "sim/contact/contact_faces.h"
#include "sim/outside/obstacle.h"

#include <unsupported/Eigen/BVH>

namespace rend {

class SurfaceTree {
public:
  // `position` [m], one per vertex slot of the faces. Both are read here only.
  SurfaceTree(const ContactFaces& faces, const std::vector<Record>& position, bool solid);

  struct Nearest {
    Vec3 point = Vec3::Zero(), normal = Vec3::UnitZ(); // [m]; unit, outward for a solid
    double distance = 0;                               // [m]
    std::uint32_t triangle = 0;
  };
  Nearest nearest(const Vec3& point) const; // CHECK: there are faces
  bool inside(const Vec3& point) const;     // of a solid; false for a sheet
  // The nearest points of all faces that are nearer than `reach` [m], the nearest first, then by triangle.
  std::vector<Nearest> within(const Vec3& point, double reach) const;

  struct Crossing {
    double share = 0; // of the way along the segment, 0 to 1
    std::uint32_t triangle = 0;
    Weights weight{};
  };
  // Through faces that are not parallel to it, ends and borders of faces included, in the order of shares.
  std::vector<Crossing> crossings(const Vec3& from, const Vec3& to) const;

  const TriangleCorners& corners(std::uint32_t triangle) const { return corners_[triangle]; } // [m]
  Vec3 normal(std::uint32_t triangle) const;                                                  // unit, or 0
  bool solid() const { return solid_; }
  std::size_t triangles() const { return corners_.size(); }
  std::size_t bytes() const;

private:
  using Tree = Eigen::KdBVH<double, 3, std::uint32_t>;
  std::vector<TriangleCorners> corners_; // [m], in the order of ContactFaces::triangles()
  Tree tree_;
  Eigen::AlignedBox3d bounds_; // [m]
  bool solid_;
};

} // namespace rend
