#include "sim/topology/validate.h"

#include "sim/topology/map_edit.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

namespace rend::validate_test {
namespace {

TEST(Validate, every_asset_is_valid) {
  for (const auto& asset : assets::all()) {
    const auto fault = validate(asset.make()->map());
    EXPECT_FALSE(fault) << asset.name << ": " << (fault ? fault->text() : "");
  }
}

TEST(Validate, names_the_cycle_that_a_half_sewn_edge_breaks) {
  GMap map(2);
  MapEdit edit(map);
  const Dart a = edit.add_dart(), b = edit.add_dart(), c = edit.add_dart(), d = edit.add_dart();
  edit.link(0, a, b);
  edit.link(0, c, d);
  EXPECT_FALSE(validate(map));
  edit.link(2, a, c); // and b, d unchanged
  const auto fault = validate(map);
  ASSERT_TRUE(fault);
  EXPECT_EQ(fault->dart, a);
  EXPECT_EQ(fault->text(), "dart 0: α0α2 is an involution: followed twice from 0 it leads to 2");
}

TEST(Validate, names_the_cycle_that_a_half_sewn_face_breaks) {
  GMap map(3);
  MapEdit edit(map);
  std::vector<Vec3> place;
  const auto first = assets::add_cube(edit, place, Vec3(0, 0, 0)),
             second = assets::add_cube(edit, place, Vec3(1, 0, 0));
  edit.link(3, first[1], second[0]);
  edit.link(3, map.alpha(0, first[1]), map.alpha(0, second[0])); // α0α3 closes, α1α3 does not
  const auto fault = validate(map);
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->text().find("α1α3 is an involution"), std::string::npos) << fault->text();
}

TEST(Validate, sees_nothing_wrong_in_an_empty_map) {
  EXPECT_FALSE(validate(GMap(2)));
  EXPECT_FALSE(validate(GMap(3)));
}

} // namespace
} // namespace rend::validate_test
