// An edit that throws leaves the map as it was: compared with a copy of every byte from before.
#include "sim/base/archive.h"
#include "sim/base/check.h"
#include "sim/embedding/embedded_map.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <random>

namespace rend::atomic_edit_test {
namespace {

// Links, slots, free lists and values, and how far the arrays reach.
std::vector<std::uint8_t> bytes_of(EmbeddedMap& body) {
  Archive archive;
  body.store(archive);
  return archive.bytes();
}

struct Countdown {
  long left = -1; // calls until one throws; negative: none does
  long calls = 0;
  void tick() {
    ++calls;
    if (left >= 0 && left-- == 0) throw std::runtime_error("a policy fails");
  }
};

// Values that differ, and policies that fail.
template <bool Inherits> struct Failing {
  using Value = std::array<double, 2>;
  std::string name;
  Orbit orbit, support;
  Countdown* countdown;
  Value birth(const EmbeddedMap& map, Dart d) const {
    countdown->tick();
    return {map.rest_of(d).x(), static_cast<double>(d.value)};
  }
  Value split(const Value& whole) const {
    countdown->tick();
    return {whole[0] + 1, whole[1] / 2};
  }
  Value merge(const Value& kept, const Value& absorbed) const {
    countdown->tick();
    return {kept[0] + absorbed[0], kept[1]};
  }
  Value inherit(const EmbeddedMap&, Dart, std::span<const Inherited<Value>> parents) const requires Inherits {
    countdown->tick();
    return {parents.front().value[0], parents.front().weight};
  }
};

struct Storm {
  Storm(unsigned seed, assets::Body made) : random(seed), body(std::move(made)) {
    const int n = body->dimension();
    const std::array<std::pair<Orbit, Orbit>, 6> kinds{{{Vertex, SingleDart},
                                                        {Edge, SingleDart},
                                                        {VertexOfFace, FaceOfVolume},
                                                        {EdgeOfFace, FaceOfVolume},
                                                        {element_orbit(n), element_orbit(n)},
                                                        {Component, SingleDart}}};
    for (const auto& [orbit, support] : kinds) {
      body->add(Failing<false>{"one", orbit, support, &countdown});
      body->add(Failing<true>{"other", orbit, support, &countdown});
    }
    body->subscribe(changes);
  }

  Dart any(const GMap& map) {
    const std::vector<Dart> darts = assets::all_darts(map);
    return darts[random() % darts.size()];
  }

  void change(Edit& edit) {
    const GMap& map = edit.map();
    if (map.dart_count() < 40 || random() % 8 == 0) {
      const std::array<Point, 4> points{assets::at(0, 0), assets::at(1, 0), assets::at(1, 1), assets::at(0, 1)};
      assets::create_polygon(edit, points);
      return;
    }
    const int i = static_cast<int>(random() % static_cast<unsigned>(map.dimension() + 1));
    switch (random() % 8) {
    case 0:
      return remove_orbit(edit, FaceOfVolume, any(map));
    case 1:
    case 2:
      return static_cast<void>(sew(edit, i, any(map), any(map)));
    case 3: {
      const Dart a = any(map);
      const auto done = apply(rule("insert-vertex"), edit, a);
      if (!done.ok) return;
      for (const Dart d : done.darts("c")) {
        edit.inherit(d, Vertex, std::array{Parent{a, 0.5}, Parent{done.darts("a").back(), 0.5}});
        edit.inherit(d, EdgeOfFace, std::array{Parent{map.alpha(0, d), 1}});
        edit.inherit(d, element_orbit(map.dimension()), std::array{Parent{map.alpha(0, d), 1}});
      }
      return;
    }
    case 4:
      return static_cast<void>(apply(rule("star-face"), edit, any(map)));
    default:
      return static_cast<void>(unsew(edit, i, any(map)));
    }
  }

  std::mt19937 random;
  Countdown countdown;
  assets::Body body;
  Changes changes;
};

std::array<std::size_t, 4> lengths(const Changes& changes) {
  std::array<std::size_t, 4> sum{changes.any, 0, 0, 0};
  for (const auto& list : changes.touched) sum[1] += list.size();
  for (const auto& list : changes.moved) sum[2] += list.size();
  for (const auto& list : changes.slots) sum[3] += list.size();
  return sum;
}

void weather(Storm& storm, int rounds) {
  EmbeddedMap& body = *storm.body;
  int failed = 0;
  for (int round = 0; round < rounds; ++round) {
    const auto before = bytes_of(body);
    const auto told = lengths(storm.changes);
    const std::mt19937 random = storm.random;
    const std::size_t count = 1 + storm.random() % 6, stop = storm.random() % (2 * count);
    const bool in_scope = storm.random() % 3 == 0;
    if (!in_scope) storm.countdown.left = static_cast<long>(storm.random() % 60);
    bool thrown = false;
    try {
      body.edit([&](Edit& edit) {
        for (std::size_t n = 0; n < count; ++n) {
          if (in_scope && n == stop) throw std::runtime_error("the change fails");
          storm.change(edit);
        }
      });
    } catch (const std::runtime_error&) {
      thrown = true;
    }
    storm.countdown.left = -1;
    if (thrown) {
      ++failed;
      ASSERT_EQ(bytes_of(body), before) << "round " << round;
      EXPECT_EQ(lengths(storm.changes), told);
      storm.random = random;
      storm.random.discard(7);
    }
    ASSERT_EQ(validate(body), std::nullopt);
  }
  EXPECT_GT(failed, rounds / 10);
  EXPECT_LT(failed, rounds);
}

TEST(AtomicEdit, takes_back_everything_if_a_change_or_a_policy_throws) {
  for (unsigned seed = 0; seed < 4; ++seed) {
    Storm sheet(seed, assets::mixed_sheet());
    weather(sheet, 150);
    Storm grid(seed, assets::grid(4, 3));
    weather(grid, 100);
    Storm solid(seed, assets::row_of_cubes(3));
    weather(solid, 100);
  }
}

TEST(AtomicEdit, fails_at_each_call_of_a_policy_and_then_succeeds_with_the_same_result) {
  const auto make = [] { return std::make_unique<Storm>(3, assets::grid(3, 2)); };
  const auto edit = [](Storm& storm) {
    storm.body->edit([&](Edit& open) {
      for (int n = 0; n < 12; ++n) storm.change(open);
    });
  };
  const auto straight = make();
  edit(*straight);
  const auto tried = make();
  const auto before = bytes_of(*tried->body);
  long failures = 0;
  for (long left = 0;; ++left) {
    tried->random = std::mt19937(3);
    tried->countdown.left = left;
    try {
      edit(*tried);
      break;
    } catch (const std::runtime_error&) {
      ++failures;
    }
    ASSERT_EQ(bytes_of(*tried->body), before) << left;
  }
  EXPECT_GT(failures, 50);
  EXPECT_EQ(bytes_of(*tried->body), bytes_of(*straight->body));
  EXPECT_EQ(lengths(tried->changes), lengths(straight->changes));
}

TEST(AtomicEdit, a_vertex_without_a_point_leaves_no_trace) {
  EmbeddedMap body(2);
  assets::add_quad(body, 0, 0);
  const auto before = bytes_of(body);
  EXPECT_THROW(body.edit([](Edit& edit) { edit.add_dart(); }), InternalError);
  EXPECT_EQ(bytes_of(body), before);
  assets::add_quad(body, 1, 0);
  EXPECT_EQ(validate(body), std::nullopt);
}

TEST(AtomicEdit, refuses_an_edit_within_an_edit_and_takes_back_both) {
  const auto body = assets::grid(2, 1);
  const auto before = bytes_of(*body);
  EXPECT_THROW(body->edit([&](Edit& edit) {
    for (const Dart d : assets::all_darts(edit.map())) unsew(edit, 2, d);
    body->edit([](Edit&) {});
  }),
               InternalError);
  EXPECT_EQ(bytes_of(*body), before);
  EXPECT_TRUE(apply(rule("quarter-faces"), *body, Dart{0u}).ok);
}

TEST(AtomicEdit, a_packed_table_of_slots_is_packed_again) {
  Storm storm(0, assets::grid(20, 20)); // corners have packed slots, which new darts unpack
  const auto before = bytes_of(*storm.body);
  storm.countdown.left = 20;
  EXPECT_THROW(apply(rule("quarter-faces"), *storm.body, Dart{0u}), std::runtime_error);
  EXPECT_EQ(bytes_of(*storm.body), before);
}

TEST(Savepoint, takes_back_points_and_parents) {
  const auto body = assets::grid(2, 1);
  body->edit([&](Edit& edit) {
    const Dart before = edit.add_dart();
    edit.give(before, assets::at(5, 5));
    const Edit::Savepoint start = edit.savepoint();
    edit.give(before, assets::at(6, 6));
    edit.inherit(before, Vertex, std::array{Parent{Dart{0u}, 1}});
    const Dart later = edit.add_dart();
    edit.give(later, assets::at(7, 7));
    edit.rollback(start);
    EXPECT_EQ(edit.point(before).position, Vec3(5, 5, 0));
    EXPECT_FALSE(edit.map().alive(later));
    EXPECT_THROW(edit.point(later), InternalError);
  });
  EXPECT_EQ(validate(*body), std::nullopt);
}

} // namespace
} // namespace rend::atomic_edit_test
