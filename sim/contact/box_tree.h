// A static tree of bounding boxes, for queries by box: made anew at each search of contact, so that making it
// must be as quick as asking it.
//
// Boxes are sorted by their centres along a space-filling curve (Morton 1966), as in Lauterbach et al., "Fast
// BVH Construction on GPUs", 2009; the tree above halves the sorted list down to leaves of four boxes. Nodes
// lie in the order of a walk that goes down first, each with the node that follows where its box is missed, so
// a query reads one array forwards and needs no stack. (Eigen's KdBVH, which SurfaceTree uses, sorts boxes anew
// at each of its levels.)
#pragma once

#include "sim/base/record.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <vector>

namespace rend {

class BoxTree {
public:
  using Box = Eigen::AlignedBox3d; // [m]

  BoxTree() = default; // of no box
  explicit BoxTree(const std::vector<Box>& boxes);

  const Box& bounds() const { return nodes_.front().box; } // of all; only where there are boxes

  // Calls f(index) for each of the boxes that intersects this one, in the order of the curve.
  template <class F> void each_in(const Box& box, const F& f) const {
    for (std::uint32_t n = 0; n < nodes_.size();) {
      const Node& node = nodes_[n];
      if (!node.box.intersects(box)) {
        n = node.next;
        continue;
      }
      for (std::uint32_t k = node.begin; k < node.end; ++k)
        if (boxes_[k].intersects(box)) f(index_[k]);
      ++n;
    }
  }

private:
  struct Node {
    Box box;
    std::uint32_t begin = 0, end = 0; // of its own boxes, empty above the leaves
    std::uint32_t next = 0;           // the node after all that are below this one
  };
  void add(std::uint32_t begin, std::uint32_t end);

  std::vector<std::uint32_t> index_; // one per box, in the order of the curve
  std::vector<Box> boxes_;           // in that order
  std::vector<Node> nodes_;
};

} // namespace rend
