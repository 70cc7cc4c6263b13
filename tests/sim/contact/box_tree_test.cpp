// Queries by box: against every box asked one by one.
#include "sim/contact/box_tree.h"

#include <gtest/gtest.h>

#include <random>

namespace rend::box_tree_test {
namespace {

using Box = BoxTree::Box;

Box box_at(std::mt19937& random, double size) {
  const auto in = [&](double most) { return std::uniform_real_distribution<double>(0, most)(random); };
  const Vec3 corner(in(1), in(1), in(0.1));
  return {corner, corner + Vec3(in(size), in(size), in(size))};
}

std::vector<std::uint32_t> found_in(const BoxTree& tree, const Box& box) {
  std::vector<std::uint32_t> found;
  tree.each_in(box, [&](std::uint32_t n) { found.push_back(n); });
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<std::uint32_t> asked_one_by_one(const std::vector<Box>& boxes, const Box& box) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t n = 0; n < boxes.size(); ++n)
    if (boxes[n].intersects(box)) found.push_back(n);
  return found;
}

TEST(BoxTree, finds_the_boxes_that_intersect_one) {
  std::mt19937 random(7);
  std::size_t found = 0;
  for (const std::size_t count : {1U, 4U, 5U, 9U, 100U, 1000U}) {
    std::vector<Box> boxes;
    for (std::size_t n = 0; n < count; ++n) boxes.push_back(box_at(random, 0.1));
    const BoxTree tree(boxes);
    for (int n = 0; n < 200; ++n) {
      const Box asked = box_at(random, n % 2 == 0 ? 0.3 : 0);
      const std::vector<std::uint32_t> expected = asked_one_by_one(boxes, asked);
      EXPECT_EQ(found_in(tree, asked), expected) << count << " boxes, query " << n;
      found += expected.size();
    }
  }
  EXPECT_GT(found, 1000U);
}

TEST(BoxTree, has_boxes_at_one_place_in_a_plane_or_none) {
  std::mt19937 random(8);
  std::vector<Box> same(20, Box(Vec3(1, 2, 3), Vec3(1, 2, 3)));
  EXPECT_EQ(found_in(BoxTree(same), same.front()).size(), same.size());
  EXPECT_TRUE(found_in(BoxTree(same), Box(Vec3(1.1, 2, 3), Vec3(4, 4, 4))).empty());
  std::vector<Box> flat;
  for (int n = 0; n < 50; ++n) {
    Box box = box_at(random, 0.1);
    box.min().z() = box.max().z() = 0;
    flat.push_back(box);
  }
  const Box half(Vec3(0, 0, -1), Vec3(0.5, 2, 1));
  EXPECT_EQ(found_in(BoxTree(flat), half), asked_one_by_one(flat, half));
  EXPECT_TRUE(found_in(BoxTree(std::vector<Box>{}), half).empty());
}

} // namespace
} // namespace rend::box_tree_test
