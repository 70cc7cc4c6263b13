#include "sim/house_rules/house_rules.h"

#include "sim/topology/count.h"
#include "sim/topology/isomorphism.h"
#include "sim/topology/validate.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace rend::rules_test {
namespace {

using assets::at;

Hooks hooks_of(const Rule& rule, Dart first, Dart second) {
  const std::size_t count = rule.plan.hooks.size();
  return count == 0 ? Hooks{} : count == 1 ? Hooks{first} : Hooks{first, second};
}

std::vector<Slot> vertex_slots(const EmbeddedMap& body) {
  std::vector<Slot> slots;
  body.map().for_each_dart([&](Dart d) { slots.push_back(body.vertex(d)); });
  return slots;
}

CellCounts after(const Rule& rule, EmbeddedMap& body, const Hooks& hooks, const RuleArguments& arguments = {}) {
  const Applied done = apply(rule, body, hooks, arguments);
  EXPECT_TRUE(done.ok) << done.reason;
  const auto fault = validate(body);
  EXPECT_FALSE(fault) << fault.value_or("");
  return count_cells(body.map());
}

TEST(Rules, every_rule_over_every_asset_leaves_a_valid_map_or_says_why_not_and_changes_nothing) {
  for (const Rule& rule : house_rules()) {
    for (const auto& asset : assets::all()) {
      SCOPED_TRACE(rule.name() + " over " + asset.name);
      std::mt19937 random(5);
      auto body = asset.make();
      const std::vector<Dart> darts = assets::all_darts(body->map());
      if (darts.empty() && !rule.only_creates()) continue;
      for (std::size_t n = 0; n < std::max<std::size_t>(1, std::min<std::size_t>(darts.size(), 24)); ++n) {
        const Dart first = darts.empty() ? Dart{} : darts[darts.size() <= 24 ? n : random() % darts.size()];
        const Dart second = darts.empty() ? Dart{} : darts[random() % darts.size()];
        const auto links = assets::links(body->map());
        const auto slots = vertex_slots(*body);
        const Applied done = apply(rule, *body, hooks_of(rule, first, second), assets::some_arguments(rule));
        const auto fault = validate(*body);
        ASSERT_FALSE(fault) << fault.value_or("");
        EXPECT_EQ(done.ok, done.reason.empty());
        if (!done.ok) {
          EXPECT_EQ(assets::links(body->map()), links);
          EXPECT_EQ(vertex_slots(*body), slots);
        } else {
          // Rules with one graph change points alone.
          const bool links_change = !rule.plan.links.empty() || !rule.plan.unlinks.empty() || rule.removes();
          if (links_change || rule.creates()) {
            EXPECT_NE(assets::links(body->map()), links);
          }
          body = asset.make();
        }
      }
    }
  }
}

// A grid whose coordinates are not exact sums: another order of addition shows.
assets::Body uneven_grid() {
  auto body = assets::grid(3, 3);
  for (std::size_t v = 0; v < body->position().values().size(); ++v) {
    const double n = static_cast<double>(v);
    body->position()[static_cast<Slot>(v)] = Record(std::sin(n), std::sin(3 * n), std::sin(7 * n));
  }
  return body;
}

TEST(Rules, any_dart_of_the_hooks_orbit_gives_the_same_map_and_the_same_points) {
  for (const Rule* each :
       {&rule("star-face"), &rule("insert-vertex"), &rule("quarter-faces"), &rule("unsew-edge"),
        &rule("remove-inner-face"), &rule("halve-quad"), &rule("move"), &rule("duplicate")}) {
    // All darts of the hook's orbit, and those that an automorphism of the graph exchanges with them.
    const bool edge = each->name() == "unsew-edge", quad = each->name() == "halve-quad";
    const Orbit orbit = edge ? EdgeOfFace : quad ? SingleDart : each->hook_orbit();
    const Dart hook = edge ? Dart{2u} : Dart{4u * 8u};
    const auto first = uneven_grid();
    ASSERT_TRUE(apply(*each, *first, hook).ok) << each->name();
    for (Dart d : darts_of(uneven_grid()->map(), orbit, hook)) {
      const auto other = uneven_grid();
      ASSERT_TRUE(apply(*each, *other, d).ok);
      EXPECT_TRUE(isomorphism(first->map(), other->map(), [&](Dart a, Dart b) {
        return first->position_of(a) == other->position_of(b);
      })) << each->name();
    }
  }
}

TEST(Rules, fifteen_thousand_random_applications_keep_a_sheet_and_a_solid_valid) {
  for (int dimension : {2, 3}) {
    std::mt19937 random(static_cast<unsigned>(dimension));
    auto body = dimension == 2 ? assets::random_sewing(3, 10, 50) : assets::row_of_cubes(3);
    for (Orbit orbit : {Edge, Face, Volume, FaceOfVolume, VertexOfFace, EdgeEndOfVolume}) body->use(orbit);
    int applied = 0;
    for (int n = 0; n < 15000; ++n) {
      const Rule& rule = house_rules()[random() % house_rules().size()];
      const auto pick = [&] { return Dart{random() % body->map().capacity()}; };
      const Applied done = apply(rule, *body, hooks_of(rule, pick(), pick()), assets::some_arguments(rule));
      applied += done.ok;
      // Too large: removes the last components.
      while (body->map().dart_count() > 1500)
        body->edit([&](Edit& edit) {
          Dart d = pick();
          while (!edit.map().alive(d)) d = pick();
          assets::remove_element(edit, d);
        });
      if (n % 50 != 0) continue;
      const auto fault = validate(*body);
      ASSERT_FALSE(fault) << rule.name() << ", number " << n << ": " << fault.value_or("");
    }
    const auto fault = validate(*body);
    EXPECT_FALSE(fault) << fault.value_or("");
    EXPECT_GT(applied, 2000);
  }
}

TEST(CreateVertex, has_one_dart_free_in_all_links) {
  EmbeddedMap body(2);
  const Dart d = apply(rule("create-vertex"), body, {}, {{"p", vector_value(1, 2, 3)}}).dart("a");
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(body.map().is_free(i, d));
  EXPECT_EQ(body.position_of(d), Vec3(1, 2, 3));
  EXPECT_EQ(body.rest_of(d), Vec3(1, 2, 3));
}

TEST(ExtrudeEdge, moves_position_and_rest_and_keeps_the_velocity) {
  EmbeddedMap body(2);
  const Dart d = apply(rule("create-vertex"), body, {}, {{"p", vector_value(0, 0, 0)}}).dart("a");
  body.rest()[body.vertex(d)] = Record(5, 0, 0);
  body.velocity()[body.vertex(d)] = Record(1, 2, 3);
  apply(rule("extrude-vertex"), body, d, {{"v", vector_value(1, 0, 0)}});
  const RuleArguments up{{"v", vector_value(0, 0, 2)}};
  const Dart far = apply(rule("extrude-edge"), body, d, up).dart("d");
  EXPECT_EQ(body.position_of(far), Vec3(0, 0, 2));
  EXPECT_EQ(body.rest_of(far), Vec3(5, 0, 2));
  EXPECT_EQ(Vec3(body.velocity()[body.vertex(far)]), Vec3(1, 2, 3));
  EXPECT_FALSE(apply(rule("extrude-edge"), body, d, up).ok); // it already has a face
}

TEST(CreateQuad, is_the_polygon_of_four_points) {
  EmbeddedMap body(2);
  const std::vector<Point> points{at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
  std::vector<Dart> darts;
  body.edit([&](Edit& edit) { darts = assets::create_polygon(edit, points); });
  EXPECT_FALSE(validate(body));
  for (std::size_t n = 0; n < 4; ++n) EXPECT_EQ(body.position_of(darts[2 * n]), points[n].position);
  const auto quad = assets::single_quad();
  EXPECT_TRUE(isomorphism(body.map(), quad->map(),
                          [&](Dart a, Dart b) { return body.position_of(a) == quad->position_of(b); }));
}

TEST(QuarterFaces, cuts_each_face_into_one_quad_per_corner) {
  const auto body = assets::mixed_sheet(); // 3 + 4 + 5 corners
  const CellCounts before = count_cells(body->map());
  const CellCounts now = after(rule("quarter-faces"), *body, Dart{0u});
  EXPECT_EQ(now.vertices, before.vertices + before.edges + before.faces);
  EXPECT_EQ(now.faces, 12u);
  EXPECT_EQ(now.euler, before.euler);
}

TEST(QuarterFaces, works_on_loops_strips_and_torn_sheets_alike) {
  for (auto make : {+[] { return assets::loop_of_quads(4, false); },
                    +[] { return assets::loop_of_quads(4, true); }, +[] { return assets::torn_sheet(); }}) {
    const auto body = make();
    const CellCounts before = count_cells(body->map());
    const CellCounts now = after(rule("quarter-faces"), *body, Dart{0u});
    EXPECT_EQ(now.vertices, before.vertices + before.edges + before.faces);
    EXPECT_EQ(now.edges, 2 * before.edges + 4 * before.faces);
    EXPECT_EQ(now.faces, 4 * before.faces);
    EXPECT_EQ(now.fragments, before.fragments);
  }
}

TEST(QuarterFaces, puts_vertices_in_the_middle_of_edges_and_faces) {
  const auto body = assets::checkerboard(3);
  body->map().for_each_dart([&](Dart d) {
    const Vec3 edge = body->position_of(body->map().alpha(0, d)) - body->position_of(d);
    EXPECT_DOUBLE_EQ(edge.norm(), 1.0 / 8);
  });
}

TEST(QuarterFaces, takes_one_component_and_leaves_the_others) {
  EmbeddedMap body(2);
  assets::add_quad(body, 0, 0);
  const Dart other = assets::add_quad(body, 5, 0);
  EXPECT_EQ(after(rule("quarter-faces"), body, Dart{0u}).faces, 5u);
  EXPECT_EQ(darts_of(body.map(), FaceOfVolume, other).size(), 8u);
}

TEST(StarFace, puts_the_new_vertex_in_the_middle) {
  const auto body = assets::single_quad();
  const Applied done = apply(rule("star-face"), *body, Dart{0u});
  EXPECT_EQ(body->position_of(done.dart("c")), Vec3(0.5, 0.5, 0));
  EXPECT_EQ(count_cells(body->map()).faces, 4u);
}

TEST(StarFace, between_two_volumes_both_sides_change) {
  const auto body = assets::row_of_cubes(2);
  const Dart between = [&] {
    for (Dart d : assets::all_darts(body->map()))
      if (!body->map().is_free(3, d)) return d;
    return Dart{};
  }();
  EXPECT_FALSE(apply(rule("star-face"), *body, between).ok);
  const CellCounts now = after(rule("star-face-both-sides"), *body, between);
  EXPECT_EQ(now.faces, 11u + 3u);
  EXPECT_EQ(now.vertices, 13u);
  EXPECT_EQ(now.euler, 1);
}

TEST(InsertVertex, cuts_an_edge_for_all_faces_around_it) {
  const auto sheet = assets::grid(2, 1);
  Dart inner;
  for (Dart d : assets::all_darts(sheet->map()))
    if (!sheet->map().is_free(2, d)) inner = d;
  EXPECT_FALSE(apply(rule("insert-vertex-border"), *sheet, inner).ok);
  const CellCounts now = after(rule("insert-vertex"), *sheet, inner);
  EXPECT_EQ(now.vertices, 7u);
  EXPECT_EQ(now.edges, 8u);
  EXPECT_EQ(darts_of(sheet->map(), FaceOfVolume, inner).size(), 10u);
  const auto cubes = assets::row_of_cubes(2);
  const CellCounts solid = after(rule("insert-vertex"), *cubes, Dart{8u});
  EXPECT_EQ(solid.vertices, 13u);
  EXPECT_EQ(solid.edges, 21u);
}

TEST(InsertVertex, on_the_border_both_rules_agree) {
  const auto one = assets::single_quad(), other = assets::single_quad();
  after(rule("insert-vertex-border"), *one, Dart{0u});
  after(rule("insert-vertex"), *other, Dart{0u});
  EXPECT_TRUE(isomorphism(one->map(), other->map(),
                          [&](Dart a, Dart b) { return one->position_of(a) == other->position_of(b); }));
}

TEST(SewAndUnsew, undo_each_other) {
  const auto body = assets::grid(2, 2);
  const auto before = assets::links(body->map());
  for (Dart d : assets::all_darts(body->map())) {
    if (body->map().is_free(2, d)) continue;
    const Dart other = body->map().alpha(2, d);
    after(rule("unsew-edge"), *body, d);
    after(rule("sew-edges"), *body, {d, other});
    EXPECT_EQ(assets::links(body->map()), before);
  }
  const auto cubes = assets::row_of_cubes(2);
  const auto links = assets::links(cubes->map());
  for (Dart d : assets::all_darts(cubes->map())) {
    if (cubes->map().is_free(3, d)) continue;
    const Dart other = cubes->map().alpha(3, d);
    EXPECT_EQ(after(rule("unsew-face"), *cubes, d).fragments, 2u);
    EXPECT_EQ(after(rule("sew-faces"), *cubes, {d, other}).vertices, 12u);
    EXPECT_EQ(assets::links(cubes->map()), links);
  }
}

TEST(SewAndUnsew, the_rules_do_what_the_operators_do) {
  int folded = 0;
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto one = assets::random_sewing(seed, 8, 200), other = assets::random_sewing(seed, 8, 200);
    for (Dart d : assets::all_darts(one->map())) {
      folded += !one->map().is_free(2, d) && one->map().alpha(2, d) == one->map().alpha(0, d);
      const bool open = apply(rule("unsew-edge"), *one, d).ok;
      other->edit([&](Edit& edit) { EXPECT_EQ(unsew(edit, 2, d), open); });
      EXPECT_EQ(assets::links(one->map()), assets::links(other->map()));
      EXPECT_EQ(vertex_slots(*one), vertex_slots(*other));
    }
  }
  EXPECT_GT(folded, 0); // edges sewn to themselves
}

// A cube two of whose faces are sewn to each other, and one with a face sewn to itself along a diagonal: a face
// folded on itself has α3 = a reflection of its darts.
TEST(SewAndUnsew, a_face_that_is_sewn_to_itself_is_unsewn_as_by_the_operator) {
  for (const auto& [i, j] : {std::pair{0, 1}, {0, 2}, {2, 5}}) {
    const auto sewn = [&] {
      GMap map(3);
      MapEdit edit(map);
      std::vector<Vec3> place;
      const auto faces = assets::add_cube(edit, place, Vec3::Zero());
      const Dart a = faces[static_cast<std::size_t>(i)];
      // Of the same face: the dart on the far side of its corner or of its edge.
      const Dart b = i == 0 && j == 1 ? map.alpha(1, a)
                     : i == 0         ? map.alpha(0, a)
                                      : faces[static_cast<std::size_t>(j)];
      EXPECT_TRUE(sew(edit, 3, a, b));
      return std::make_unique<EmbeddedMap>(std::move(map), [](Dart) { return Point{}; });
    };
    const auto one = sewn(), other = sewn();
    ASSERT_FALSE(validate(*one));
    for (Dart d : assets::all_darts(one->map())) {
      const bool open = apply(rule("unsew-face"), *one, d).ok;
      other->edit([&](Edit& edit) { EXPECT_EQ(unsew(edit, 3, d), open); });
      EXPECT_EQ(assets::links(one->map()), assets::links(other->map()));
      EXPECT_EQ(vertex_slots(*one), vertex_slots(*other));
    }
  }
}

TEST(Remove, an_inner_face_leaves_a_hole) {
  const auto body = assets::grid(3, 3);
  const CellCounts now = after(rule("remove-inner-face"), *body, Dart{4u * 8u});
  EXPECT_EQ(now.faces, 8u);
  EXPECT_EQ(now.euler, 0);
  EXPECT_FALSE(apply(rule("remove-inner-face"), *body, Dart{0u}).ok); // on the border
}

TEST(Remove, isolation_and_removal_in_one_rule_or_in_two_give_the_same_sheet) {
  const auto one = assets::grid(3, 3), two = assets::grid(3, 3);
  const Dart inner{4u * 8u};
  after(rule("remove-inner-face"), *one, inner);
  for (Dart d : darts_of(two->map(), FaceOfVolume, inner)) apply(rule("unsew-edge"), *two, d);
  after(rule("remove-isolated-face"), *two, inner);
  EXPECT_EQ(assets::links(one->map()), assets::links(two->map()));
}

TEST(Remove, any_element_can_go_whatever_it_is_sewn_to) {
  for (const auto& asset : assets::all()) {
    const auto body = asset.make();
    while (body->map().dart_count() > 0) {
      const std::vector<Dart> darts = assets::all_darts(body->map());
      body->edit([&](Edit& edit) { assets::remove_element(edit, darts[darts.size() / 2]); });
      const auto fault = validate(*body);
      ASSERT_FALSE(fault) << asset.name << ": " << fault.value_or("");
    }
    EXPECT_EQ(body->cells(Vertex).count(), 0u);
  }
}

TEST(QuarterFaces, a_hundred_thousand_darts_take_a_moment) {
  const auto body = assets::checkerboard(7); // 2^14 quads, 131,072 darts
  EXPECT_EQ(after(rule("quarter-faces"), *body, Dart{0u}).faces, 65536u);
}

} // namespace
} // namespace rend::rules_test
