#include "sim/rules/match.h"

#include "sim/base/check.h"
#include "sim/topology/rule_check.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

namespace rend {
namespace {

using namespace grammar;

Dart sewn(const EmbeddedMap& body) {
  for (Dart d : assets::all_darts(body.map()))
    if (!body.map().is_free(2, d)) return d;
  return {};
}

TEST(Match, an_instance_for_every_dart_of_the_hooks_orbit) {
  const auto body = assets::mixed_sheet();
  for (Dart d : assets::all_darts(body->map())) {
    Match match;
    EXPECT_EQ(find_match(triangulate_face, body->map(), d, match), "");
    EXPECT_EQ(match.instances, darts_of(body->map(), FaceOfVolume, d).size());
    EXPECT_EQ(match.dart(0, 0), d);
    for (std::size_t k = 0; k < match.instances; ++k)
      for (int p : {0, 1})
        EXPECT_EQ(match.dart(match.neighbour(k, p), 0), body->map().alpha(p, match.dart(k, 0)));
  }
}

TEST(Match, says_which_link_is_not_free) {
  const auto body = assets::grid(2, 1);
  const Dart d = sewn(*body);
  const Applied refused = apply(sew_edges, *body, {d, body->map().alpha(2, d)});
  EXPECT_FALSE(refused.ok);
  EXPECT_EQ(refused.reason, "\"sew edges\" does not apply: dart 2 should be α2-free, and is linked to 15");
}

TEST(Match, a_border_edge_is_not_between_two_faces) {
  const auto body = assets::single_quad();
  EXPECT_EQ(apply(unsew_edge, *body, Dart{0u}).reason,
            "\"unsew edge\" does not apply: dart 0 would have to play two parts");
}

TEST(Match, an_edge_sewn_to_itself_is_not_between_two_faces) {
  const auto body = assets::single_quad();
  body->edit([](Edit& edit) { ASSERT_TRUE(sew(edit, 2, Dart{0u}, Dart{1u})); });
  EXPECT_FALSE(apply(unsew_edge, *body, Dart{0u}).ok);
  EXPECT_TRUE(apply(insert_vertex, *body, Dart{0u}).ok);
  EXPECT_FALSE(validate(*body));
}

TEST(Match, the_orbits_of_two_hooks_must_be_isomorphic) {
  GMap map(3);
  MapEdit edit(map);
  std::vector<Vec3> place;
  const auto cube = assets::add_cube(edit, place, Vec3::Zero());
  std::vector<Dart> ring;
  for (int n = 0; n < 6; ++n) ring.push_back(edit.add_dart());
  for (std::size_t n = 0; n < 6; ++n) edit.link(n % 2 == 0 ? 0 : 1, ring[n], ring[(n + 1) % 6]);
  Match match;
  for (const Hooks& hooks : {Hooks{cube[0], ring[0]}, Hooks{ring[0], cube[0]}})
    EXPECT_NE(find_match(sew_faces, map, hooks, match).find("not isomorphic"), std::string::npos);
  EXPECT_EQ(find_match(sew_faces, map, {cube[0], cube[1]}, match), "");
  EXPECT_NE(find_match(sew_faces, map, {cube[0], cube[0]}, match), "");
}

TEST(Match, a_dart_that_was_removed_is_no_hook) {
  const auto body = assets::single_quad();
  apply(remove_isolated_face, *body, Dart{0u});
  EXPECT_EQ(apply(unsew_edge, *body, Dart{0u}).reason, "\"unsew edge\" does not apply: there is no dart 0");
  EXPECT_FALSE(apply(unsew_edge, *body, Dart{1000u}).ok);
  EXPECT_FALSE(apply(unsew_edge, *body, Dart{}).ok);
}

TEST(Match, a_sheet_refuses_what_links_by_alpha3) {
  const auto body = assets::grid(2, 1);
  EXPECT_EQ(apply(sew_faces, *body, {Dart{0u}, Dart{8u}}).reason,
            "\"sew faces\" does not apply: a sheet has no volumes to link");
}

const char* has_four_sides(const GMap& map, std::span<const Dart> hooks) {
  return darts_of(map, FaceOfVolume, hooks[0]).size() == 8 ? nullptr : "the face does not have four sides";
}
constexpr Rule triangulate_quad{
    "triangulate quad",
    left{hook('a', {0, 1}), loop('a', 3)},
    right{node('a', {0, _}), node('b', {_, 2}), node('c', {1, 2}), arc('a', 1, 'b'), arc('b', 0, 'c'),
          loop('a', 3), loop('b', 3), loop('c', 3), point('c', mean('a', FaceOfVolume))},
    has_four_sides,
};
static_assert(well_formed(triangulate_quad));

TEST(Match, a_precondition_is_asked_last_and_gives_its_reason) {
  const auto quad = assets::single_quad(), triangle = assets::triangle();
  EXPECT_TRUE(apply(triangulate_quad, *quad, Dart{0u}).ok);
  EXPECT_EQ(apply(triangulate_quad, *triangle, Dart{0u}).reason,
            "\"triangulate quad\" does not apply: the face does not have four sides");
}

TEST(Match, the_wrong_number_of_hooks_or_arguments_is_our_slip) {
  const auto body = assets::single_quad();
  const auto before = assets::links(body->map());
  EXPECT_THROW(apply(unsew_edge, *body, {Dart{0u}, Dart{1u}}), InternalError);
  EXPECT_THROW(apply(unsew_edge, *body), InternalError);
  EXPECT_THROW(apply(create_vertex, *body), InternalError);
  EXPECT_EQ(assets::links(body->map()), before);
}

} // namespace
} // namespace rend
