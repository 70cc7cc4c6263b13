// Invariants of topological changes, checked on a body before and after a change.
#pragma once

#include "sim/body/body.h"
#include "sim/boundary/solid_surface.h"
#include "sim/boundary/surface.h"

#include <cstring>
#include <gtest/gtest.h>

namespace rend::torn {

inline bool same_bits(const Vec3& a, const Vec3& b) {
  return std::memcmp(a.data(), b.data(), sizeof(double) * 3) == 0;
}

// Per dart, by number: position, rest position, velocity, and its corner's mass.
struct Snapshot {
  std::vector<Vec3> position, rest, velocity;
  std::vector<double> mass;
  double whole;
  Vec3 momentum;

  explicit Snapshot(const Body& body)
      : position(body.map->map().capacity()), rest(position.size()), velocity(position.size()),
        mass(position.size()), whole(total_mass(*body.map, *body.mass)),
        momentum(total_momentum(*body.map, *body.mass)) {
    body.map->map().for_each_dart([&](Dart d) {
      position[d.value] = body.map->position()[body.map->vertex(d)];
      rest[d.value] = body.map->rest_of(d);
      velocity[d.value] = body.map->velocity()[body.map->vertex(d)];
      mass[d.value] = (*body.mass)[body.map->slot(body.mass->orbit(), d)];
    });
  }
};

// Of a body whose laws divide elements, the darts that were there keep their places unless they become another
// point of the matter, and the sums are kept.
inline void expect_sums_kept(const Snapshot& now, const Snapshot& before, const Body& body) {
  body.map->map().for_each_dart([&](Dart d) {
    if (d.value >= before.position.size()) return;
    if (same_bits(now.rest[d.value], before.rest[d.value])) {
      EXPECT_TRUE(same_bits(now.position[d.value], before.position[d.value]));
    }
  });
  EXPECT_NEAR(now.whole, before.whole, 1e-13 * before.whole);
  EXPECT_LT((now.momentum - before.momentum).norm(), 1e-13 * (before.whole + before.momentum.norm()));
}

inline void expect_nothing_moved(const Body& body, const Snapshot& before, bool deleted) {
  const Snapshot now(body);
  if (body.map->grows()) return expect_sums_kept(now, before, body);
  body.map->map().for_each_dart([&](Dart d) {
    EXPECT_TRUE(same_bits(now.position[d.value], before.position[d.value]));
    EXPECT_TRUE(same_bits(now.velocity[d.value], before.velocity[d.value]));
    EXPECT_EQ(now.mass[d.value], before.mass[d.value]);
  });
  if (deleted) return;
  EXPECT_EQ(now.whole, before.whole);
  EXPECT_TRUE(same_bits(now.momentum, before.momentum));
}

inline std::vector<Slot> prescribed(const Body& body) {
  std::vector<Slot> found;
  for (const auto& column : body.map->columns())
    if (const auto* obedience = dynamic_cast<const Column<MotionMask>*>(column.get()))
      for (Slot v = 0; v < body.map->cells(Vertex).slots(); ++v)
        if (body.map->cells(Vertex).alive(v) && (*obedience)[v] != 0) found.push_back(v);
  return found;
}

// A surface of either kind.
struct Seen {
  std::unique_ptr<Surface> sheet;
  std::unique_ptr<SolidSurface> solid;
  explicit Seen(Body& body) {
    if (body.map->dimension() == 2)
      sheet = std::make_unique<Surface>(*(body).map, (body).border);
    else
      solid = std::make_unique<SolidSurface>(*body.map, body.border);
  }
  void update() {
    if (sheet) sheet->update();
    if (solid) solid->update();
  }
  bool same_as(const Seen& other) const {
    return sheet ? sheet->same_as(*other.sheet) : solid->same_as(*other.solid);
  }
};

inline bool same(const std::vector<Candidate>& a, const std::vector<Candidate>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Candidate& p, const Candidate& q) {
    return p.value == q.value && p.dart == q.dart && p.normal == q.normal;
  });
}

inline void expect_criteria_as_built_anew(Body& body) {
  body.evaluate();
  const ForceView view = body.view();
  for (TearLaw& law : body.tear_laws) {
    if (law.settings().criterion->name == "chance") continue; // its result differs at each call
    TearLaw anew(body.request_for(law.settings()), law.settings());
    EXPECT_TRUE(same(law.find(view), anew.find(view))) << law.settings().criterion->name;
  }
}

inline void expect_as_built_anew(Body& body, const Seen& seen) {
  EXPECT_EQ(validate(*body.map), std::nullopt);
  const Program fresh(*body.map, body.interactions, *body.mass, body.drag, body.program->options());
  EXPECT_TRUE(body.program->same_as(fresh));
  EXPECT_TRUE(seen.same_as(Seen(body)));
  EXPECT_EQ(body.constraints.vertices(), prescribed(body));
  expect_criteria_as_built_anew(body);
}

} // namespace rend::torn
