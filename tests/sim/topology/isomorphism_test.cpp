#include "sim/topology/isomorphism.h"

#include "tests/sim/assets.h"

#include <gtest/gtest.h>

namespace rend::isomorphism_test {
namespace {

TEST(Isomorphism, every_asset_is_isomorphic_to_itself_with_its_darts_renumbered) {
  for (const auto& asset : assets::all()) {
    const auto body = asset.make();
    const GMap& map = body->map();
    const std::vector<Dart> darts = assets::all_darts(map);
    GMap other(map.dimension());
    MapEdit edit(other);
    std::vector<Dart> image(map.capacity());
    for (std::size_t n = darts.size(); n-- > 0;) image[darts[n].value] = edit.add_dart(); // backwards
    for (Dart d : darts)
      for (int i = 0; i < 4; ++i)
        if (d < map.alpha(i, d)) edit.link(i, image[d.value], image[map.alpha(i, d).value]);
    const auto found = isomorphism(map, other);
    ASSERT_TRUE(found) << asset.name;
    for (Dart d : darts)
      for (int i = 0; i < 4; ++i)
        EXPECT_EQ((*found)[map.alpha(i, d).value], other.alpha(i, (*found)[d.value])) << asset.name;
  }
}

TEST(Isomorphism, a_loop_is_not_a_moebius_strip) {
  EXPECT_FALSE(isomorphism(assets::loop_of_quads(4, false)->map(), assets::loop_of_quads(4, true)->map()));
}

TEST(Isomorphism, sheets_with_as_many_darts_differ_by_how_they_are_sewn) {
  const auto whole = assets::grid(3, 1), torn = assets::grid(3, 1);
  for (Dart d : assets::all_darts(torn->map()))
    if (!torn->map().is_free(2, d)) {
      apply(rule("unsew-edge"), *torn, d);
      break;
    }
  EXPECT_FALSE(isomorphism(whole->map(), torn->map()));
  EXPECT_FALSE(isomorphism(assets::grid(3, 2)->map(), assets::grid(6, 1)->map()));
}

TEST(Isomorphism, what_darts_carry_can_forbid_a_bijection) {
  const auto a = assets::single_quad(), b = assets::single_quad();
  const auto same_place = [&](Dart d, Dart e) { return a->position_of(d) == b->position_of(e); };
  EXPECT_TRUE(isomorphism(a->map(), b->map(), same_place));
  b->position()[0] = Record{9, 9, 9};
  EXPECT_TRUE(isomorphism(a->map(), b->map()));
  EXPECT_FALSE(isomorphism(a->map(), b->map(), same_place));
}

TEST(Isomorphism, extrusion_and_creation_make_the_same_quad) {
  EXPECT_TRUE(isomorphism(assets::checkerboard(0)->map(), assets::single_quad()->map()));
  const auto grid = assets::grid(4, 4), board = assets::checkerboard(2);
  EXPECT_TRUE(isomorphism(grid->map(), board->map(),
                          [&](Dart d, Dart e) { return grid->position_of(d) == 4 * board->position_of(e); }));
}

} // namespace
} // namespace rend::isomorphism_test
