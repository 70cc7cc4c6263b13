// Models that cannot be sewn, and what repair makes of them.
#include "sim/mesh/repair.h"

#include "sim/mesh/mesh_files.h"
#include "sim/topology/count.h"

#include <gtest/gtest.h>

namespace rend::repair_test {
namespace {

struct Repaired {
  Repairs repairs;
  MeshBody body;
};
Repaired repaired(const std::string& obj) {
  MeshFile file = read_mesh(MeshSource("a.obj", obj));
  Repaired out;
  out.repairs = repair(file);
  out.body = sew(std::move(file));
  return out;
}

std::size_t open_sides(const EmbeddedMap& map) {
  std::size_t count = 0;
  map.map().for_each_dart([&](Dart d) { count += map.map().is_free(2, d); });
  return count / 2;
}

// A square of two triangles whose diagonal is a third one of no width, since point 5 is where point 2 is.
const std::string seam = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nf 1 2 4\nf 5 3 4\nf 2 5 4\n";

TEST(Repair, merges_the_ends_of_a_side_without_length_so_that_nothing_comes_apart) {
  EXPECT_THROW(files::read("a.obj", seam), UserError);
  const Repaired made = repaired(seam);
  EXPECT_EQ(made.repairs.merged, 1u);
  EXPECT_EQ(made.repairs.flat, 1u);
  EXPECT_EQ(made.body.map->cells(Vertex).count(), 4u);
  EXPECT_EQ(count_cells(made.body.map->map(), Face), 2u);
  EXPECT_EQ(open_sides(*made.body.map), 4u) << "the square's own border";
}

TEST(Repair, drops_what_lies_on_a_line_meets_a_point_twice_or_is_there_twice) {
  const Repaired made = repaired("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 0 1 0\n"
                                 "f 1 2 3\nf 1 3 4\nf 3 4 1\nf 1 2 2\nf 1 3 4 5\n");
  EXPECT_EQ(made.repairs.polygons, 5u);
  EXPECT_EQ(made.repairs.flat, 2u);   // 1 2 3 and 1 2 2
  EXPECT_EQ(made.repairs.copies, 2u); // 3 4 1, and 1 3 4 5 once 5 is 4
  EXPECT_EQ(made.repairs.merged, 1u);
  EXPECT_EQ(count_cells(made.body.map->map(), Face), 1u);
}

TEST(Repair, changes_nothing_where_nothing_is_wrong) {
  const std::string good = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\ng left\nf 1 2 4\ng right\nf 5 3 4\n";
  const Repaired made = repaired(good); // points in one place that no side joins: two parts, as they were
  EXPECT_EQ(made.repairs.merged + made.repairs.flat + made.repairs.copies + made.repairs.corners, 0u);
  EXPECT_EQ(files::text_of(std::move(repaired(good).body.map)), files::text_of(files::read("a.obj", good).map));
  EXPECT_EQ(made.body.groups.size(), 2u);
  EXPECT_EQ(made.body.map->cells(Vertex).count(), 6u);
}

TEST(Repair, keeps_groups_by_the_points_that_are_left) {
  const Repaired made = repaired("g corner\n" + seam + "g last\nf 5 3 1\n");
  const auto& corner = made.body.groups.at("corner");
  EXPECT_EQ(corner.size(), 4u);
}

TEST(Repair, refuses_what_is_no_sheet_or_is_nothing_afterwards) {
  MeshFile solid = read_mesh(MeshSource("a.msh", files::text_of(files::mixed_bar())));
  EXPECT_THROW(repair(solid), UserError);
  MeshFile flat = read_mesh(MeshSource("a.obj", std::string("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")));
  EXPECT_THROW(repair(flat), UserError);
}

} // namespace
} // namespace rend::repair_test
