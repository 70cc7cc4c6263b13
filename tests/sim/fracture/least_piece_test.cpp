// min-piece: nothing is torn off that is lighter than a share of its body. Pieces are found by another search.
#include "sim/fracture/least_piece.h"

#include "sim/embedding/cell_size.h"
#include "sim/presets.h"
#include "sim/topology/validate.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <ostream>

namespace rend::least_piece_test {
namespace {

// Torn at once in many places: pulled at both ends, hard.
presets::Loaded pulled(const std::string& shape, const std::string& law) {
  const bool sheet = shape.find("sheet") != std::string::npos;
  return presets::load(fmt::format(
      R"(<scene><body>{}<mass density="100" {}/>
         <elasticity young="1e5" poisson="0.2" {} damping-mass="5" damping-stiffness="1e-4"/>
         <drive side="-x" velocity="-2 0.3 0"/><drive side="+x" velocity="2 0 0.4"/>{}</body>
         <world gravity="0 0 0"/><time step="auto" integrator="symplectic" duration="2"/></scene>)",
      shape, sheet ? R"(thickness="0.01")" : "", sheet ? R"(thickness="0.01")" : "", law));
}

// The sizes at rest [m², m³] of what is connected across borders, by union of the elements on both sides.
std::vector<double> pieces_of(const Body& body) {
  const EmbeddedMap& map = *body.map;
  const int across = map.dimension();
  const CellIndex& elements = map.cells(element_orbit(across));
  std::vector<Slot> root(elements.slots());
  std::iota(root.begin(), root.end(), Slot{0});
  const auto find = [&](Slot e) {
    while (root[e] != e) e = root[e];
    return e;
  };
  map.map().for_each_dart([&](Dart d) {
    const Slot a = find(elements.slot(d)), b = find(elements.slot(map.map().alpha(across, d)));
    root[std::max(a, b)] = std::min(a, b);
  });
  std::map<Slot, double> sizes;
  for (Slot e = 0; e < elements.slots(); ++e)
    if (elements.alive(e)) {
      const Dart d = elements.first_dart(e);
      sizes[find(e)] += across == 2 ? rest_area(map, d) : rest_volume(map, d);
    }
  std::vector<double> all;
  for (const auto& [slot, size] : sizes) all.push_back(size);
  return all;
}

struct Torn {
  std::vector<double> least; // share of the smallest piece, after each step that tore
  std::size_t pieces = 0;    // at the end
  Refusals refused;
};

Torn tear(const std::string& shape, const std::string& law) {
  const auto scene = pulled(shape, law);
  const std::vector<double> start = pieces_of(scene.body());
  EXPECT_EQ(start.size(), 1u);
  Torn torn;
  std::size_t tears = 0;
  for (int n = 0; n < 4000 && scene->time() < 0.25; ++n) {
    scene->step();
    if (scene->tears() == tears) continue;
    tears = scene->tears();
    const std::vector<double> pieces = pieces_of(scene.body());
    torn.least.push_back(*std::min_element(pieces.begin(), pieces.end()) / start.front());
    torn.pieces = pieces.size();
  }
  const auto fault = validate(*scene.body().map);
  EXPECT_FALSE(fault) << *fault;
  torn.refused = scene.body().tear_laws.front().refusals();
  return torn;
}

const std::string sheet = R"(<sheet pattern="crossed" cells="16 6" size="2 0.75"/>)",
                  bar = R"(<bar pattern="tetrahedra" cells="8 2 2" size="1.2 0.3 0.3"/>)";

struct Case {
  std::string shape, law;
  double share;
};
void PrintTo(const Case& one, std::ostream* out) {
  *out << one.shape << ' ' << one.law << ' ' << one.share;
}

class LeastPieceOf : public testing::TestWithParam<Case> {};

TEST_P(LeastPieceOf, is_kept_after_every_change) {
  const auto& [shape, law, share] = GetParam();
  const Torn plain = tear(shape, "<tear " + law + "/>"),
             kept = tear(shape, fmt::format("<tear {} min-piece=\"{}\"/>", law, share));
  ASSERT_FALSE(plain.least.empty());
  EXPECT_LT(plain.least.back(), share) << "without it there are smaller ones";
  ASSERT_FALSE(kept.least.empty());
  EXPECT_THAT(kept.least, testing::Each(testing::Ge(share * (1 - 1e-9))));
  EXPECT_GT(kept.pieces, 1u) << "larger ones are torn off";
  EXPECT_TRUE(kept.refused.contains("it would tear off a piece of less than min-piece of the mass"));
}

const std::string split = R"(criterion="vertex-stress" threshold="3e3" change="split-vertex")",
                  cut = R"(criterion="vertex-stress" threshold="3e3" change="cut")",
                  square = R"(<sheet pattern="crossed" cells="12 12" size="2 2"/>)",
                  fine = R"(<bar pattern="tetrahedra" cells="12 3 3" size="1.2 0.3 0.3"/>)";

std::string borders(int threshold) { // [N]
  return fmt::format(R"(criterion="atomic-border" threshold="{}" change="separate")", threshold);
}

INSTANTIATE_TEST_SUITE_P(Sheets, LeastPieceOf,
                         testing::Values(Case{sheet, split, 0.04}, Case{sheet, cut, 0.05},
                                         Case{square, cut, 0.06}, Case{sheet, borders(2), 0.04}));
INSTANTIATE_TEST_SUITE_P(Solids, LeastPieceOf,
                         testing::Values(Case{fine, split, 0.05}, Case{fine, cut, 0.1},
                                         Case{bar, borders(20), 0.04}));

TEST(LeastPiece, of_a_body_in_pieces_is_kept_where_their_walls_open) {
  const std::string pieces = R"(<pieces count="12" seed="3" strength="0.1"/>)";
  const std::string law = R"(<tear criterion="vertex-stress" threshold="3e4" change="split-vertex")";
  const Torn plain = tear(bar + pieces, law + "/>"), kept = tear(bar + pieces, law + R"( min-piece="0.15"/>)");
  ASSERT_FALSE(plain.least.empty());
  EXPECT_LT(plain.least.back(), 0.15);
  EXPECT_THAT(kept.least, testing::Each(testing::Ge(0.15 * (1 - 1e-9))));
  EXPECT_GT(kept.pieces, 1u);
}

} // namespace
} // namespace rend::least_piece_test
