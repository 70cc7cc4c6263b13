#include "sim/rules/match.h"

#include "sim/base/check.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

namespace rend::match_test {
namespace {

Dart sewn(const EmbeddedMap& body) {
  for (Dart d : assets::all_darts(body.map()))
    if (!body.map().is_free(2, d)) return d;
  return {};
}

std::string reason(const char* name, EmbeddedMap& body, const Hooks& hooks) {
  return apply(rule(name), body, hooks).reason;
}

TEST(Match, has_an_instance_for_every_dart_of_the_hooks_orbit) {
  const auto body = assets::mixed_sheet();
  for (Dart d : assets::all_darts(body->map())) {
    Match match;
    EXPECT_FALSE(find_match(rule("star-face"), body->map(), d, match));
    EXPECT_EQ(match.instances, darts_of(body->map(), FaceOfVolume, d).size());
    EXPECT_EQ(match.dart(0, 0), d);
    for (std::size_t k = 0; k < match.instances; ++k)
      for (int p : {0, 1})
        EXPECT_EQ(match.dart(match.neighbour(k, p), 0), body->map().alpha(p, match.dart(k, 0)));
  }
}

TEST(Match, of_two_hooks_walks_both_orbits_alike) {
  const auto body = assets::row_of_cubes(2);
  Match match;
  const Dart free = [&] {
    for (Dart d : assets::all_darts(body->map()))
      if (body->map().is_free(3, d)) return d;
    return Dart{};
  }();
  const Dart other{body->map().capacity() - 1};
  ASSERT_FALSE(find_match(rule("sew-faces"), body->map(), {free, other}, match));
  EXPECT_EQ(match.instances, 8u);
  for (std::size_t k = 0; k < match.instances; ++k)
    for (int node : {0, 1})
      for (int p : {0, 1})
        EXPECT_EQ(match.dart(match.neighbour(k, p), node), body->map().alpha(p, match.dart(k, node)));
}

TEST(Match, says_which_link_is_not_free) {
  const auto body = assets::grid(2, 1);
  const Dart d = sewn(*body);
  EXPECT_EQ(reason("sew-edges", *body, {d, body->map().alpha(2, d)}),
            "\"sew-edges\" does not apply: node a: dart 2 should be α2-free, and is linked to 15");
}

TEST(Match, says_which_link_is_free) {
  const auto body = assets::single_quad();
  EXPECT_EQ(reason("unsew-edge", *body, Dart{0u}),
            "\"unsew-edge\" does not apply: node a: dart 0 is α2-free, and the rule needs a neighbour there");
  EXPECT_EQ(
      reason("remove-inner-face", *body, Dart{0u}),
      "\"remove-inner-face\" does not apply: node a: dart 0 is α2-free, and the rule needs a neighbour there");
}

TEST(Match, an_edge_sewn_to_itself_is_two_parts_of_one_dart) {
  const auto body = assets::single_quad();
  body->edit([](Edit& edit) { ASSERT_TRUE(sew(edit, 2, Dart{0u}, Dart{1u})); });
  // The same rule with and without may-fold.
  RuleSettings settings = unsew_edge();
  settings.may_fold = false;
  const Rule strict(settings);
  Match match;
  EXPECT_EQ(find_match(strict, body->map(), Dart{0u}, match).kind, Mismatch::Kind::Twice);
  EXPECT_EQ(find_match(rule("unsew-edge"), body->map(), Dart{0u}, match).kind, Mismatch::Kind::None);
  EXPECT_TRUE(apply(rule("insert-vertex"), *body, Dart{0u}).ok);
  EXPECT_FALSE(validate(*body));
}

TEST(Match, an_arc_leads_to_another_dart_at_every_instance) {
  // Of the two darts of the hook's edge, one has a neighbour by α1 and the other is free.
  EmbeddedMap body(2);
  body.edit([](Edit& edit) {
    const Dart a = edit.add_dart(), b = edit.add_dart(), c = edit.add_dart();
    edit.link(0, a, b);
    edit.link(1, b, c);
    for (Dart d : {a, b, c}) edit.give(d, Point{});
  });
  RuleSettings settings{
      .name = "open", .left = "a*(0) b(_) a-1-b a|3 b|3", .right = "a(0) b(_) a|1,3 b|1,3", .may_fold = true};
  const Rule open(settings);
  Match match;
  for (Dart d : {Dart{0u}, Dart{1u}})
    EXPECT_EQ(find_match(open, body.map(), d, match).kind, Mismatch::Kind::Free);
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
  for (const Hooks& hooks : {Hooks{cube[0], ring[0]}, Hooks{ring[0], cube[0]}}) {
    const Mismatch mismatch = find_match(rule("sew-faces"), map, hooks, match);
    EXPECT_EQ(mismatch.kind, Mismatch::Kind::NotIsomorphic);
    EXPECT_NE(mismatch.sentence(rule("sew-faces")).find("not isomorphic"), std::string::npos);
  }
  EXPECT_FALSE(find_match(rule("sew-faces"), map, {cube[0], cube[1]}, match));
  EXPECT_EQ(find_match(rule("sew-faces"), map, {cube[0], cube[0]}, match).kind, Mismatch::Kind::Twice);
}

TEST(Match, a_dart_that_was_removed_is_no_hook) {
  const auto body = assets::single_quad();
  apply(rule("remove-isolated-face"), *body, Dart{0u});
  EXPECT_EQ(reason("unsew-edge", *body, Dart{0u}), "\"unsew-edge\" does not apply: there is no dart 0");
  EXPECT_FALSE(apply(rule("unsew-edge"), *body, Dart{1000u}).ok);
  EXPECT_FALSE(apply(rule("unsew-edge"), *body, Dart{}).ok);
}

TEST(Match, a_sheet_refuses_what_links_by_alpha3) {
  const auto body = assets::grid(2, 1);
  EXPECT_EQ(reason("sew-faces", *body, {Dart{0u}, Dart{8u}}),
            "\"sew-faces\" does not apply: a sheet has no volumes to link");
}

TEST(Match, a_condition_is_asked_last_and_gives_its_reason) {
  RuleSettings settings = star_face();
  settings.whens = {{.test = "size(a, face) == 4", .otherwise = "the face does not have four sides"}};
  const Rule star_quad(settings);
  const auto quad = assets::single_quad(), triangle = assets::triangle();
  EXPECT_TRUE(apply(star_quad, *quad, Dart{0u}).ok);
  EXPECT_EQ(apply(star_quad, *triangle, Dart{0u}).reason,
            "\"star-face\" does not apply: the face does not have four sides");
  EXPECT_EQ(apply(star_quad, *triangle, Dart{6u}).reason, "\"star-face\" does not apply: there is no dart 6");
}

TEST(Match, a_condition_holds_at_the_hook_at_all_or_at_any_dart) {
  // The left half of two quads side by side: x of the hook's dart, over the darts of its face.
  const auto holds = [](RuleWhenSettings::At at, const char* test, Dart d) {
    RuleSettings settings = star_face();
    settings.whens = {{.test = test, .at = at}};
    const auto body = assets::grid(2, 1);
    return apply(Rule(settings), *body, d).ok;
  };
  using At = RuleWhenSettings::At;
  const char* left = "dot(a, point(1, 0, 0)) < 0.5"; // two corners of the first quad, none of the second
  for (std::uint32_t n = 0; n < 8; ++n) {
    const bool here = assets::grid(2, 1)->position_of(Dart{n}).x() < 0.5;
    EXPECT_EQ(holds(At::Hook, left, Dart{n}), here);
    EXPECT_TRUE(holds(At::Any, left, Dart{n}));
    EXPECT_FALSE(holds(At::All, left, Dart{n}));
    EXPECT_TRUE(holds(At::All, "dot(a, point(1, 0, 0)) < 1.5", Dart{n}));
    EXPECT_FALSE(holds(At::Any, left, Dart{8 + n}));
  }
}

TEST(Match, a_condition_without_a_value_is_no_match) {
  RuleSettings settings = star_face();
  settings.whens = {{.test = "1 / (size(a, face) - 4) > 0"}};
  const auto body = assets::single_quad();
  const auto before = assets::links(body->map());
  const Applied refused = apply(Rule(settings), *body, Dart{0u});
  EXPECT_FALSE(refused.ok);
  EXPECT_NE(refused.reason.find("1 / 0 is not a finite number"), std::string::npos) << refused.reason;
  EXPECT_EQ(assets::links(body->map()), before);
}

TEST(Match, the_wrong_number_of_hooks_or_arguments_is_our_slip) {
  const auto body = assets::single_quad();
  const auto before = assets::links(body->map());
  EXPECT_THROW(find_match(rule("unsew-edge"), body->map(), {Dart{0u}, Dart{1u}}, *std::make_unique<Match>()),
               InternalError);
  EXPECT_THROW(apply(rule("unsew-edge"), *body, {Dart{0u}, Dart{1u}}), InternalError);
  EXPECT_EQ(assets::links(body->map()), before);
  const auto other = assets::single_quad();
  EXPECT_THROW(apply(rule("unsew-edge"), *other), InternalError);
  EXPECT_THROW(context_of(rule("create-vertex"), {{"nonsense", scalar_value(1)}}), InternalError);
}

} // namespace
} // namespace rend::match_test
