// Bodies of every kind of mesh for tests of topological changes, and a criterion whose findings the test
// controls.
#pragma once

#include "sim/boundary/solid_surface.h"
#include "sim/boundary/solids.h"
#include "sim/boundary/surface.h"
#include "sim/elements.h"
#include "sim/fracture/pairs.h"
#include "sim/fracture/tear_law.h"
#include "sim/topology/count.h"
#include "sim/topology/walk.h"

#include <set>

namespace rend::torn {

using meshes::Noise;

// Finds cells at random: some candidates each time it is evaluated, with random planes.
template <Cell C> class RandomCriterion final : public Criterion {
public:
  static inline std::size_t most = 4;
  static inline Noise noise{1};
  static inline std::vector<Candidate> found; // all candidates so far

  explicit RandomCriterion(const CriterionRequest&) {}
  void find(const ForceView& view, double threshold, std::vector<Candidate>& candidates) override {
    const GMap& map = view.map.map();
    std::set<Dart> met;
    if (map.dart_count() == 0) return;
    for (std::size_t n = 1 + noise.below(most); n > 0; --n) {
      Dart d{noise.below(map.capacity())};
      while (!map.alive(d)) d = Dart{noise.below(map.capacity())};
      const Dart first = smallest_dart(map, orbit_of(C, map.dimension()), d);
      if (!met.insert(first).second) continue;
      candidates.push_back({threshold + 1 + noise(), first, noise.vector().normalized()});
      found.push_back(candidates.back());
    }
  }
  void rebind(const Changes&) override {}
  void reserve_for_separations() override {}
  std::size_t bytes() const override { return 0; }
};

template <Cell C> const CriterionType& chance() {
  static const CriterionType type{.name = "chance",
                                  .what = "anything",
                                  .unit = "",
                                  .cell = [](std::string_view) { return C; },
                                  .lacking = [](const CriterionRequest&) { return std::string(); },
                                  .make = [](const CriterionRequest& r) -> std::unique_ptr<Criterion> {
                                    return std::make_unique<RandomCriterion<C>>(r);
                                  }};
  return type;
}

inline const ChangeType& change(const std::string& name) {
  for (const ChangeType& type : all_changes())
    if (type.name == name) return type;
  throw std::invalid_argument(name);
}

// A change on cells found at random.
struct RandomChange {
  std::string change;
  Cell cell;
};

inline const CriterionType& chance_on(Cell cell) {
  switch (cell) {
  case Cell::Edges:
    return chance<Cell::Edges>();
  case Cell::Borders:
    return chance<Cell::Borders>();
  case Cell::Vertices:
    return chance<Cell::Vertices>();
  case Cell::Elements:
    break;
  }
  return chance<Cell::Elements>();
}

// Adds a law with each applicable criterion; none ever reaches its threshold.
inline void watch(Body& body) {
  for (const CriterionType& type : all_criteria()) {
    LawSettings law;
    law.criterion = &type;
    if (type.name == "atomic-spring") law.kind = "stretch";
    const CriterionRequest request = body.request_for(law);
    if (!type.lacking(request).empty()) continue;
    law.cell = type.cell(law.kind);
    law.change = &default_change(law.cell);
    law.threshold = 1e-3;
    law.from = 1e9;
    body.tear_laws.emplace_back(request, law);
  }
}

// Elements, co-rotational unless asked for otherwise, and springs along edges; viscous drag, one fixed vertex;
// displaced at random.
inline std::unique_ptr<Body> body(std::unique_ptr<EmbeddedMap> map, const std::vector<RandomChange>& laws = {},
                                  const std::string& scheme = "symplectic", bool watched = false,
                                  bool springs = true, const elements::Elastic& elastic = {}) {
  auto made = std::make_unique<Body>();
  made->name = "torn";
  made->map = std::move(map);
  CornerMass mass;
  mass.density = 10;
  made->mass = &made->map->add(mass.on(*made->map));
  CornerDrag drag;
  drag.per_vertex = 0.1;
  made->drag = &made->map->add(drag.on(*made->map));
  elements::add_elasticity(*made, elastic);
  if (springs) made->interactions.push_back(meshes::interaction(*made->map, {"stretch", "", 60, 0.3}));
  made->constraints.add(*made->map, Motion{}, {made->map->vertex(Dart{0u})});
  made->border = &made->map->add(InitialBorder(made->map->dimension()));
  made->fragment_counter = std::make_unique<FragmentCounter>();
  for (const RandomChange& by : laws) {
    LawSettings law;
    law.criterion = &chance_on(by.cell);
    law.change = &change(by.change);
    law.cell = by.cell;
    made->tear_laws.emplace_back(made->request_for(law), law);
  }
  if (watched) watch(*made);
  made->prepare(*find_scheme(scheme));
  meshes::shake(*made, 0.05, 3);
  made->constrain(0, made->map->position().values().data(), made->map->velocity().values().data());
  made->evaluate();
  return made;
}

inline std::unique_ptr<Body> block(int n) {
  return body(solid_from(solids::bar(BarPattern::Hexahedra, n, n, n)));
}

// The cell counts of the map.
inline std::string counts(const Body& body) {
  const CellCounts c = count_cells(body.map->map());
  return std::to_string(c.vertices) + " " + std::to_string(c.edges) + " " + std::to_string(c.faces) + " " +
         std::to_string(c.volumes) + " in " + std::to_string(c.fragments);
}

inline std::vector<Dart> cell_of(const Body& body, Cell cell, Dart d) {
  return darts_of(body.map->map(), orbit_of(cell, body.map->dimension()), d);
}

// Makes one change as a law would, on the remains of a cell, by the forces that were last evaluated; false: it
// was not possible.
inline bool make(Body& body, const std::string& name, Cell cell, const Candidate& candidate,
                 std::vector<Dart> darts) {
  bool made = false;
  const ForceView view = body.view();
  const ChangeType& type = change(name);
  const int dimension = body.map->dimension();
  std::erase_if(darts, [&](Dart d) { return !body.map->map().alive(d); });
  Places places;
  if (const auto find = transfer(cell, type.cell, dimension).find)
    find(view, candidate, darts, places);
  else
    places.add(darts, candidate.normal);
  body.map->edit([&](Edit& edit) {
    for (std::size_t n = 0; n < places.count() && !made; ++n) {
      std::vector<Dart> at(places.darts(n).begin(), places.darts(n).end());
      if (type.cell != cell) grown(edit.map(), orbit_of(type.cell, dimension), places.darts(n), at);
      made = type.apply(edit, view, places.normal(n), at);
    }
  });
  body.rebind();
  return made;
}

inline bool make(Body& body, const std::string& name, Cell cell, const Candidate& candidate) {
  const bool made = make(body, name, cell, candidate, cell_of(body, cell, candidate.dart));
  body.evaluate();
  return made;
}

// The dart of the cell whose centre at rest is nearest.
inline Dart cell_at(const Body& body, Cell cell, const Vec3& place) {
  Dart best;
  double least = 1e300;
  body.map->map().for_each_dart([&](Dart d) {
    const double far =
        (middle_of(*body.map, body.map->rest().values().data(), cell_of(body, cell, d)) - place).norm();
    if (far < least - 1e-9) {
      least = far;
      best = d;
    }
  });
  return best;
}

} // namespace rend::torn
