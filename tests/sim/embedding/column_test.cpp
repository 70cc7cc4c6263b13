#include "sim/embedding/column.h"

#include "sim/embedding/embedded_map.h"
#include "tests/sim/assets.h"

#include <gtest/gtest.h>

#include <numeric>

namespace rend::column_test {
namespace {

struct Calls {
  int births = 0, splits = 0, merges = 0;
  bool operator==(const Calls&) const = default;
  void clear() { *this = {}; }
};

// Counts the calls of its policies; the value is the sum of what it was made of.
struct Counting {
  using Value = double;
  std::string name = "counting";
  Orbit orbit = Vertex;
  Orbit support = SingleDart;
  Calls* calls = nullptr;
  Value birth(const EmbeddedMap&, Dart) const {
    ++calls->births;
    return 1;
  }
  Value split(const Value& whole) const {
    ++calls->splits;
    return whole;
  }
  Value merge(const Value& kept, const Value& absorbed) const {
    ++calls->merges;
    return kept + absorbed;
  }
};

// A corner's share of the mass of its face, by area at rest [kg], of a sheet of 1 kg/m².
struct CornerMass {
  using Value = double;
  std::string name = "corner mass";
  Orbit orbit = VertexOfFace;
  Orbit support = FaceOfVolume;
  Calls* calls = nullptr;
  Value birth(const EmbeddedMap& body, Dart d) const {
    ++calls->births;
    Vec3 area = Vec3::Zero();
    int corners = 0;
    const GMap& map = body.map();
    Dart at = d;
    do {
      area += body.rest_of(at).cross(body.rest_of(map.alpha(0, at))) / 2;
      at = map.alpha(1, map.alpha(0, at));
      ++corners;
    } while (at != d);
    return area.norm() / corners;
  }
  Value split(const Value& whole) const {
    ++calls->splits;
    return whole / 2;
  }
  Value merge(const Value& kept, const Value& absorbed) const {
    ++calls->merges;
    return kept + absorbed;
  }
};

template <class E> double total(const EmbeddedMap& body, const Column<E>& column) {
  double sum = 0;
  const CellIndex& cells = body.cells(column.orbit());
  for (Slot s = 0; s < cells.slots(); ++s)
    if (cells.alive(s)) sum += column[s];
  return sum;
}

Dart find_edge(const EmbeddedMap& body, const Vec3& from, const Vec3& to) {
  Dart found;
  body.map().for_each_dart([&](Dart d) {
    if (!found && body.position_of(d) == from && body.position_of(body.map().alpha(0, d)) == to) found = d;
  });
  EXPECT_TRUE(found);
  return found;
}

TEST(Column, a_column_that_is_added_is_born_on_every_orbit) {
  Calls calls;
  const auto body = assets::grid(3, 2);
  const auto& column = body->add(Counting{.calls = &calls});
  EXPECT_EQ(calls, (Calls{12, 0, 0}));
  EXPECT_EQ(total(*body, column), 12);
}

TEST(Column, sewing_merges_once_per_vertex_that_goes) {
  Calls calls;
  EmbeddedMap body(2);
  const Dart a = assets::add_quad(body, 0, 0), b = assets::add_quad(body, 1, 0);
  const auto& column = body.add(Counting{.calls = &calls});
  calls.clear();
  apply(rule("sew-edges"), body, {a, b});
  EXPECT_EQ(calls, (Calls{0, 0, 2}));
  EXPECT_EQ(column[body.vertex(a)], 2);
  EXPECT_EQ(total(body, column), 8);
}

TEST(Column, separation_splits_once_per_new_fragment) {
  Calls calls;
  const auto body = assets::grid(2, 1);
  body->add(Counting{.calls = &calls});
  calls.clear();
  apply(rule("unsew-edge"), *body, find_edge(*body, Vec3(1, 0, 0), Vec3(1, 1, 0)));
  EXPECT_EQ(calls, (Calls{0, 2, 0}));
}

TEST(Column, creation_calls_birth_once_per_orbit_and_removal_calls_none) {
  Calls vertex_calls, corner_calls;
  EmbeddedMap body(2);
  body.add(Counting{.calls = &vertex_calls});
  body.add(CornerMass{.calls = &corner_calls});
  const Dart d = assets::add_quad(body, 0, 0);
  EXPECT_EQ(vertex_calls, (Calls{4, 0, 0}));
  EXPECT_EQ(corner_calls, (Calls{4, 0, 0}));
  apply(rule("remove-isolated-face"), body, d);
  EXPECT_EQ(vertex_calls, (Calls{4, 0, 0}));
  EXPECT_EQ(corner_calls, (Calls{4, 0, 0}));
}

TEST(Column, what_depends_on_a_face_does_not_notice_a_separation) {
  Calls calls;
  const auto body = assets::grid(3, 3);
  const auto& mass = body->add(CornerMass{.calls = &calls});
  const std::vector<double> before = mass.values();
  calls.clear();
  for (Dart d : assets::all_darts(body->map())) apply(rule("unsew-edge"), *body, d);
  EXPECT_EQ(count_cells(body->map(), Component), 9u);
  EXPECT_EQ(calls, Calls{});
  EXPECT_EQ(mass.values(), before);
}

TEST(Column, what_depends_on_a_face_is_born_again_by_subdivision_and_its_total_stays) {
  Calls calls;
  const auto body = assets::mixed_sheet();
  const auto& mass = body->add(CornerMass{.calls = &calls});
  const double before = total(*body, mass);
  calls.clear();
  const std::size_t old_corners = body->cells(VertexOfFace).count();
  apply(rule("quarter-faces"), *body, Dart{0u});
  EXPECT_EQ(static_cast<std::size_t>(calls.births), body->cells(VertexOfFace).count());
  EXPECT_EQ(body->cells(VertexOfFace).count(), 4 * old_corners);
  EXPECT_NEAR(total(*body, mass), before, 1e-12);
}

TEST(Column, triangulation_of_one_face_leaves_the_masses_of_the_others_alone) {
  Calls calls;
  const auto body = assets::grid(2, 2);
  const auto& mass = body->add(CornerMass{.calls = &calls});
  calls.clear();
  apply(rule("star-face"), *body, Dart{0u});
  EXPECT_EQ(calls.births, 12);
  EXPECT_NEAR(total(*body, mass), 4, 1e-12);
}

TEST(Column, inserting_a_vertex_calls_birth_on_corners_of_both_faces) {
  Calls calls;
  const auto body = assets::grid(2, 1);
  const auto& mass = body->add(CornerMass{.calls = &calls});
  calls.clear();
  apply(rule("insert-vertex"), *body, find_edge(*body, Vec3(1, 0, 0), Vec3(1, 1, 0)));
  EXPECT_EQ(calls.births, 10);
  EXPECT_NEAR(total(*body, mass), 2, 1e-12);
  EXPECT_NEAR(mass[body->slot(VertexOfFace, Dart{0u})], 0.2, 1e-15);
}

} // namespace
} // namespace rend::column_test
