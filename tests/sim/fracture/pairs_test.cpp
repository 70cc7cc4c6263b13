// Every pair of a criterion and a change on sheets and solids: it is refused with a sentence, or it tears,
// leaves a valid map and bindings as those of a body built anew, and gives the same state on any threads.
#include "sim/fracture/pairs.h"
#include "sim/fracture/torn_checks.h"
#include "sim/presets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::pairs_test {
namespace {

using namespace torn;

struct Shape {
  std::string pattern;
  int dimension;
  bool quads; // faces of four sides, which shear springs need
};
const std::vector<Shape> shapes{
    {"quads", 2, true}, {"triangles", 2, false}, {"hexahedra", 3, true}, {"tetrahedra", 3, false}};

// Springs of every kind and finite elements on one body, held at one side and pulled at the other.
std::string text_of(const Shape& shape, const Pair& pair, double threshold) {
  const std::string body =
      shape.dimension == 2
          ? fmt::format(R"(<sheet pattern="{}" cells="6 4" size="1.2 0.8"/><mass total="0.1"/>)", shape.pattern)
          : fmt::format(R"(<bar pattern="{}" cells="4 2 2" size="0.8 0.4 0.4"/><mass total="1"/>)",
                        shape.pattern);
  const std::string springs = shape.dimension == 2 ? R"(<stretch k="20"/><shear k="10"/><bend k="2"/>)"
                                                   : R"(<stretch k="20"/><shear k="10"/>)";
  const std::string elasticity =
      shape.dimension == 2 ? R"(<elasticity young="4e3" thickness="0.01"/>)" : R"(<elasticity young="1e3"/>)";
  const std::string kind = pair.criterion.kind.empty() ? "" : fmt::format(R"( kind="{}")", pair.criterion.kind);
  return fmt::format(
      R"(<scene><body>{}<springs>{}</springs>{}<fix side="-x"/><drive side="+x" velocity="2 0.2 0.1"/>)"
      R"(<tear criterion="{}"{} change="{}" threshold="{}"/></body>)"
      R"(<world gravity="0 0 -1"/><time step="1e-3" duration="1"/></scene>)",
      body, springs, elasticity, pair.criterion.type->name, kind, pair.change->name, threshold);
}

constexpr int most_steps = 120;

// A tenth of the largest value of an untorn body half way: some of the worst cells cannot tear, such as
// vertices at a side that is held, whose elements all lie on one side of the plane.
double threshold_for(const Shape& shape, const Pair& pair) {
  const presets::Loaded scene = presets::load(text_of(shape, pair, 1e30));
  Body& body = scene.body();
  LawSettings all = body.tear_laws.front().settings();
  all.threshold = 1e-12;
  double most = 0;
  for (int n = 0; n < most_steps / 2; ++n) scene->step();
  body.evaluate();
  TearLaw law(body.request_for(all), all);
  for (const Candidate& candidate : law.find(body.view())) most = std::max(most, candidate.value);
  return most / 10;
}

void expect_tears(const Shape& shape, const Pair& pair) {
  const double threshold = threshold_for(shape, pair);
  ASSERT_GT(threshold, 0);
  const std::string text = text_of(shape, pair, threshold);
  const presets::Loaded one = presets::load(text),
                        two = presets::load(text, {.threads = 2, .parallel_small_bodies = true});
  Body& body = one.body();
  Seen seen(body);
  std::size_t looked = 0;
  int looks = 0;
  for (int n = 0; n < most_steps && looks < 6 && !body.deleted_at; ++n) {
    one->step();
    two->step();
    if (one->tears() == looked) continue;
    looked = one->tears();
    ++looks;
    seen.update();
    expect_as_built_anew(body, seen);
    EXPECT_EQ(one->hash(), two->hash());
    if (testing::Test::HasFailure()) FAIL() << "in step " << n;
  }
  EXPECT_GT(one->tears(), 0u);
  EXPECT_EQ(one->hash(), two->hash());
}

// The error that a preset ends in; empty: none.
std::string refused(const std::string& text) {
  try {
    presets::load(text);
  } catch (const UserError& error) {
    return error.what();
  }
  return {};
}

// Cuts go through triangles and tetrahedra alone.
bool misfit(const Shape& shape, const Pair& pair) {
  return pair.change->name == "cut" && shape.quads;
}

class EveryPair : public testing::TestWithParam<Shape> {};

TEST_P(EveryPair, is_refused_with_a_sentence_or_tears_alike_however_it_is_bound_and_threaded) {
  const Shape& shape = GetParam();
  int made = 0;
  for (const Pair& pair : all_pairs(shape.dimension)) {
    SCOPED_TRACE(pair.criterion.name() + " x " + pair.change->name);
    const std::string refusal = refused(text_of(shape, pair, 1));
    if (!pair.refusal.empty()) {
      EXPECT_NE(refusal.find("'" + pair.criterion.name() + "' " + pair.refusal), std::string::npos) << refusal;
      continue;
    }
    if (pair.criterion.kind == "shear" && !shape.quads) { // this body has no such springs
      EXPECT_NE(refusal.find("springs of kind 'shear', but this body has only"), std::string::npos) << refusal;
      continue;
    }
    if (misfit(shape, pair)) {
      EXPECT_NE(refusal.find("'cut' goes through "), std::string::npos) << refusal;
      continue;
    }
    EXPECT_EQ(refusal, "");
    expect_tears(shape, pair);
    if (HasFailure()) return;
    ++made;
  }
  // 13 criteria with their kinds; in a solid none of bends; without quads none of shears
  const int changes = shape.quads ? 4 : 5;
  EXPECT_EQ(made, changes * (13 - (shape.dimension == 3 ? 2 : 0) - (shape.quads ? 0 : 2)));
}

INSTANTIATE_TEST_SUITE_P(All, EveryPair, testing::ValuesIn(shapes),
                         [](const auto& one) { return one.param.pattern; });

TEST(Pairs, have_a_meaning_but_for_bends_of_solids) {
  for (int dimension : {2, 3}) {
    const std::vector<Pair> pairs = all_pairs(dimension);
    EXPECT_EQ(pairs.size(), 13 * all_changes().size());
    for (const Pair& pair : pairs)
      EXPECT_EQ(pair.refusal.empty(), dimension == 2 || pair.criterion.kind != "bend") << pair.criterion.name();
  }
}

TEST(Pairs, compute_forces_of_single_elements_only_where_the_change_is_made_at_another_cell) {
  for (const Shape& shape : shapes)
    for (const Pair& pair : all_pairs(shape.dimension)) {
      if (!pair.refusal.empty() || misfit(shape, pair) || (pair.criterion.kind == "shear" && !shape.quads))
        continue;
      const presets::Loaded scene = presets::load(text_of(shape, pair, 1e30));
      const bool needed = pair.transfer->find != nullptr || pair.criterion.type->elementary;
      EXPECT_EQ(scene.body().tear_laws.front().elementary(), needed);
      EXPECT_EQ(scene.body().corner_force.empty(), !needed);
    }
}

} // namespace
} // namespace rend::pairs_test
