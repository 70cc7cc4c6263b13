// Strength by place: where a law acts, what its threshold is multiplied by, draws of Weibull's distribution.
#include "sim/fracture/strength.h"

#include "sim/base/math.h"
#include "sim/presets.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <sstream>

namespace rend::strength_test {
namespace {

// A strip from x = 0 to 2 that is pulled at both ends: the same stress everywhere.
presets::Loaded strip(const std::string& law, const std::string& pattern = "quads",
                      const ScenePictures& pictures = {}) {
  return presets::load(
      R"(<scene><body><sheet pattern=")" + pattern + R"(" cells="16 4" size="2 0.5"/><mass total="0.1"/>
         <elasticity model="corotational" young="1e5" poisson="0" thickness="0.001" damping-stiffness="1e-3"/>
         <drive side="-x" velocity="-0.05 0 0"/><drive side="+x" velocity="0.05 0 0"/>)" +
          law +
          R"(</body><world gravity="0 0 0"/><time step="auto" integrator="verlet" duration="2"/></scene>)",
      {}, pictures);
}

std::vector<double> places_of_tears(const presets::Loaded& scene, double until = 1) {
  while (scene->time() < until && scene->tears() < 40) scene->step();
  std::vector<double> x;
  for (const TearEvent& event : scene.body().events) {
    const EmbeddedMap& map = *scene.body().map;
    x.push_back(map.rest_of(event.dart).x());
  }
  return x;
}

std::vector<double> strengths_of(const Body& body) {
  const auto* column = find_column<ElementStrength>(*body.map);
  if (!column) return {};
  std::vector<double> all;
  const CellIndex& elements = body.map->cells(column->orbit());
  for (Slot e = 0; e < elements.slots(); ++e)
    if (elements.alive(e)) all.push_back((*column)[e]);
  return all;
}

TEST(Strength, decides_where_a_body_tears_that_is_loaded_the_same_everywhere) {
  const auto scene = strip(R"-(<tear criterion="vertex-stress" threshold="2e3" change="split-vertex"
                                     strength="if(abs(x(rest) - 1.4) &lt; 0.1, 1, 2)"/>)-");
  const std::vector<double> places = places_of_tears(scene);
  ASSERT_GT(places.size(), 2u);
  EXPECT_THAT(places, testing::Each(testing::AllOf(testing::Ge(1.1), testing::Le(1.7))));
}

TEST(Strength, is_what_the_threshold_is_multiplied_by) {
  const auto first_tear = [](const std::string& law) {
    const auto scene = strip("<tear criterion=\"vertex-stress\" change=\"split-vertex\" " + law + "/>");
    places_of_tears(scene);
    const TearEvent& first = scene.body().events.front();
    return std::pair(first.time, first.dart);
  };
  EXPECT_EQ(first_tear(R"(threshold="3e3")"), first_tear(R"(threshold="1.5e3" strength="2")"));
  EXPECT_EQ(first_tear(R"(threshold="3e3")"), first_tear(R"(threshold="3e3" all="yes")"));
}

TEST(Strength, of_a_law_that_selects_is_asked_for_at_selected_vertices_alone) {
  for (const std::string criterion : {"vertex-stress", "atomic-border", "atomic-element"}) {
    const auto scene =
        strip(fmt::format(R"(<tear criterion="{}" threshold="{}" change="separate" box="-1 -1 -1  0.6 1 1"/>)",
                          criterion, criterion == "atomic-border" ? "0.05" : "2e3"));
    const std::vector<double> places = places_of_tears(scene);
    ASSERT_FALSE(places.empty()) << criterion;
    EXPECT_THAT(places, testing::Each(testing::Le(0.75))) << criterion;
  }
}

TEST(Strength, of_parts_is_that_of_the_element_they_were_cut_from) {
  const auto scene = strip(
      R"(<tear criterion="vertex-stress" threshold="2e3" change="cut" strength="1 + 0.5*random" seed="3"/>)",
      "crossed");
  const std::vector<double> before = strengths_of(scene.body());
  const std::set<double> known(before.begin(), before.end());
  EXPECT_GT(known.size(), before.size() - 2) << "each element has a draw of its own";
  ASSERT_GT(places_of_tears(scene).size(), 5u);
  const std::vector<double> after = strengths_of(scene.body());
  ASSERT_GT(after.size(), before.size()) << "some were cut";
  for (const double each : after) EXPECT_THAT(known, testing::Contains(testing::DoubleNear(each, 1e-14)));
}

TEST(Strength, of_each_law_is_its_own_and_its_largest_value_is_told_relative_to_it) {
  const auto scene = strip(
      R"(<tear criterion="vertex-stress" threshold="1e9" strength="4"/>
         <tear criterion="vertex-stress" threshold="1e9"/>
         <tear criterion="vertex-stress" threshold="1e9" strength="0.5" box="-1 -1 -1  3 1 1"/>)");
  while (scene->time() < 0.2) scene->step();
  const auto& laws = scene.body().tear_laws;
  const double plain = laws[1].reached().value;
  ASSERT_GT(plain, 0);
  EXPECT_NEAR(laws[0].reached().value, plain / 4, 1e-9 * plain);
  EXPECT_NEAR(laws[2].reached().value, plain * 2, 1e-9 * plain);
}

// A picture of so many pixels, row by row from the top.
ScenePictures picture_of(int width, std::vector<float> brightness) {
  const int height = static_cast<int>(brightness.size()) / width;
  const auto mask = std::make_shared<const Mask>(Mask{width, height, std::move(brightness)});
  return {.is_textured = {}, .read_mask = [mask](const auto&) { return mask; }};
}

// By the formula, pixel by pixel: each weighs (1 − |distance|) in both directions; what lies beyond the
// outermost middles of pixels has the value there.
double brightness_at(double u, double v, int width, const std::vector<float>& pixels) {
  const int height = static_cast<int>(pixels.size()) / width;
  const double column = std::min(std::max(u * width - 0.5, 0.0), width - 1.0),
               row = std::min(std::max((1 - v) * height - 0.5, 0.0), height - 1.0);
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      sum += static_cast<double>(pixels[static_cast<std::size_t>(y * width + x)]) *
             std::max(0.0, 1 - std::abs(column - x)) * std::max(0.0, 1 - std::abs(row - y));
  return sum;
}

struct ElementThere {
  Vec3 middle; // [m], at rest
  double strength;
};

std::vector<ElementThere> elements_of(const Body& body) {
  const auto* column = find_column<ElementStrength>(*body.map);
  std::vector<ElementThere> all;
  if (!column) return all;
  const CellIndex& elements = body.map->cells(column->orbit());
  for (Slot e = 0; e < elements.slots(); ++e) {
    std::set<Slot> seen;
    Vec3 sum = Vec3::Zero();
    for (Dart d : darts_of(body.map->map(), column->orbit(), elements.first_dart(e)))
      if (seen.insert(body.map->vertex(d)).second) sum += body.map->rest_of(d);
    all.push_back({sum / static_cast<double>(seen.size()), (*column)[e]});
  }
  return all;
}

const std::vector<float> six{0.1f, 0.2f, 0.9f, 1.0f, 0.0f, 0.5f}; // three pixels in each of two rows

TEST(Strength, by_a_picture_is_that_of_the_picture_where_the_element_lies_on_a_sheet) {
  const auto scene = presets::load(
      R"(<scene><body><sheet pattern="mixed" cells="9 6" size="3 2"/>
         <place scale="2" rotate="90 0 0" translate="1 2 3"/><mass total="0.1"/>
         <tear criterion="atomic-element" threshold="2e3" picture="mask.png"
               strength="2 + picture + 10*u + 100*v"/>
         <elasticity young="1e5" thickness="0.001"/></body><time step="1e-4" duration="1"/></scene>)",
      {}, picture_of(3, six));
  const auto elements = elements_of(scene.body());
  ASSERT_GT(elements.size(), 54u);
  for (const auto& [x, strength] : elements) { // upright: the sheet's y is z
    const double u = (x.x() - 1) / 6, v = (x.z() - 3) / 4;
    EXPECT_NEAR(strength, 2 + brightness_at(u, v, 3, six) + 10 * u + 100 * v, 1e-6);
  }
}

TEST(Strength, by_a_picture_alone_is_a_tenth_where_it_is_black) {
  const auto scene = strip(R"(<tear criterion="vertex-stress" threshold="2e3" picture="mask.png"/>)", "quads",
                           picture_of(2, {0, 1}));
  for (const auto& [x, strength] : elements_of(scene.body())) {
    if (x.x() < 0.5) {
      EXPECT_NEAR(strength, 0.1, 1e-12);
    } else if (x.x() > 1.5) {
      EXPECT_NEAR(strength, 1, 1e-12);
    }
  }
}

TEST(Strength, by_a_picture_has_its_upper_row_above) {
  const auto scene = strip(R"(<tear criterion="vertex-stress" threshold="2e3" picture="mask.png"/>)", "quads",
                           picture_of(1, {0, 1}));
  double above = 0, below = 0;
  for (const auto& [x, strength] : elements_of(scene.body())) (x.y() > 0.25 ? above : below) += strength;
  EXPECT_LT(above, 0.5 * below);
}

TEST(Strength, by_a_picture_lets_a_strip_break_at_a_black_line) {
  std::vector<float> line(40, 1.0f);
  line[27] = line[28] = 0; // from u = 0.675 to 0.725: x = 1.35 to 1.45
  const auto scene = strip(R"(<tear criterion="vertex-stress" threshold="4e3" change="split-vertex"
                                    picture="mask.png" strength="0.5 + 0.5*picture"/>)",
                           "quads", picture_of(40, line));
  const std::vector<double> places = places_of_tears(scene);
  ASSERT_GT(places.size(), 2u);
  EXPECT_THAT(places, testing::Each(testing::AllOf(testing::Ge(1.1), testing::Le(1.7))));
}

TEST(Strength, of_a_solid_is_that_of_a_picture_seen_through_its_thinnest_side) {
  const std::string law = R"(<tear criterion="atomic-element" threshold="2e3" strength="1 + u + 10*v"/>)",
                    rest = R"(<mass total="1"/><elasticity young="1e5"/>)" + law +
                           R"(</body><time step="1e-4" duration="1"/></scene>)";
  struct Case {
    std::string size;
    int u, v; // along which axes
  };
  for (const auto& [size, u, v] :
       {Case{"2 0.1 1", 0, 2}, {"0.1 2 1", 1, 2}, {"2 1 0.1", 0, 1}, {"1 1 1", 0, 1}}) {
    const auto scene = presets::load(R"(<scene><body><bar cells="4 3 2" size=")" + size + R"("/>)" + rest);
    std::array<double, 3> sides{};
    std::istringstream(size) >> sides[0] >> sides[1] >> sides[2];
    const double widest = *std::max_element(sides.begin(), sides.end());
    for (const auto& [x, strength] : elements_of(scene.body())) {
      const auto share = [&](int axis) {
        return (x[axis] - sides[static_cast<std::size_t>(axis)] / 2) / widest + 0.5;
      };
      EXPECT_NEAR(strength, 1 + share(u) + 10 * share(v), 1e-9) << size;
    }
  }
}

TEST(Strength, by_a_picture_is_refused_where_nobody_reads_pictures) {
  try {
    strip(R"(<tear criterion="vertex-stress" threshold="2e3" picture="mask.png"/>)");
    FAIL() << "it was built";
  } catch (const UserError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("'mask.png' was not read"));
  }
}

TEST(Strength, costs_nothing_where_nothing_asks_for_it) {
  const auto scene = strip(R"(<tear criterion="vertex-stress" threshold="2e3" change="split-vertex"/>)");
  EXPECT_EQ(scene.body().tear_laws.front().settings().by_place, nullptr);
  EXPECT_EQ(find_column<ElementStrength>(*scene.body().map), nullptr);
  EXPECT_EQ(find_column<SelectedVertex>(*scene.body().map), nullptr);
}

// ln of the strengths of 4,000 bars, each that of its weakest element.
std::vector<double> weakest(const std::string& factor, const std::string& bar) {
  const auto scene = presets::load("<scene><body>" + bar + R"(<mass density="1000"/></body>
                                   <time step="1e-3" duration="1"/></scene>)");
  EmbeddedMap& map = *scene.body().map;
  const CellIndex& elements = map.use(Volume);
  std::vector<double> all;
  for (int seed = 0; seed < 4000; ++seed) {
    const ElementExpression strength(factor, {.seed = seed}, strength_quantity(), {map, {}}, {});
    double least = 1e300;
    for (Slot e = 0; e < elements.slots(); ++e)
      least = std::min(least, strength.at(map, elements.first_dart(e)));
    all.push_back(std::log(least));
  }
  return all;
}

double mean(const std::vector<double>& all) {
  double sum = 0;
  for (const double each : all) sum += each;
  return sum / static_cast<double>(all.size());
}

// That of Weibull's distribution whose logarithms have this variance: π²/6m².
double modulus(const std::vector<double>& all) {
  double sum = 0;
  for (const double each : all) sum += (each - mean(all)) * (each - mean(all));
  return pi / std::sqrt(6 * sum / static_cast<double>(all.size() - 1));
}

// E ln = ln σ₀ − γ/m
double characteristic(const std::vector<double>& all, double m) {
  constexpr double euler = 0.57721566490153286;
  return std::exp(mean(all) + euler / m);
}

TEST(Strength, of_a_bar_has_the_modulus_asked_for_however_fine_its_mesh_is) {
  for (const std::string cells : {"10 1 1", "20 2 2"}) {
    const auto all = weakest("weibull(6)", R"(<bar cells=")" + cells + R"(" size="1 0.1 0.1"/>)");
    EXPECT_NEAR(modulus(all), 6, 0.08 * 6) << cells;
    EXPECT_NEAR(characteristic(all, 6), 1, 0.02) << cells;
  }
}

TEST(Strength, of_a_larger_bar_is_less_by_the_root_of_its_volume) {
  const auto small = weakest("weibull(6, 0.01)", R"(<bar cells="10 1 1" size="1 0.1 0.1"/>)"),
             large = weakest("weibull(6, 0.01)", R"(<bar cells="20 2 2" size="2 0.2 0.2"/>)");
  EXPECT_NEAR(std::exp(mean(large) - mean(small)), std::pow(8, -1.0 / 6), 0.02);
}

} // namespace
} // namespace rend::strength_test
