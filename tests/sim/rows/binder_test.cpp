// Incremental = from scratch: after every edit, all that depends on the map equals what is built from scratch.
#include "sim/assets.h"
#include "sim/boundary/surface.h"
#include "sim/presets.h"
#include "sim/random_meshes.h"
#include "sim/topology/walk.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace rend::binder_test {
namespace {

using namespace meshes;

// Vertices with a prescribed motion, by testing every one.
std::vector<Slot> prescribed(const Body& body) {
  std::vector<Slot> found;
  for (const auto& column : body.map->columns()) {
    const auto* obedience = dynamic_cast<const Column<MotionMask>*>(column.get());
    if (!obedience) continue;
    const CellIndex& vertices = body.map->cells(Vertex);
    for (Slot v = 0; v < vertices.slots(); ++v)
      if (vertices.alive(v) && (*obedience)[v] != 0) found.push_back(v);
  }
  return found;
}

bool same_candidates(const std::vector<Candidate>& a, const std::vector<Candidate>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Candidate& p, const Candidate& q) {
    return p.value == q.value && p.dart == q.dart;
  });
}

// What differs from a build from scratch; empty: nothing.
std::string stale(Body& body, const Surface* surface) {
  const Program fresh(*body.map, body.interactions, *body.mass, body.drag, body.program->options());
  for (std::size_t n = 0; n < fresh.folded().size(); ++n)
    if (!fresh.folded()[n].rows().same_as(body.program->folded()[n].rows()))
      return "folded rows of " + body.interactions[n]->name;
  for (std::size_t n = 0; n < fresh.elementary().size(); ++n)
    if (!fresh.elementary()[n].rows().same_as(body.program->elementary()[n].rows()))
      return "elementary rows of " + body.interactions[n]->name;
  if (!body.program->same_as(fresh)) return "masses, drag or corners";
  if (surface && !surface->same_as(Surface(*body.map, body.border))) return "surface";
  if (!body.constraints.motions().empty() && body.constraints.vertices() != prescribed(body))
    return "constraints";
  body.evaluate();
  const ForceView view = body.view();
  for (TearLaw& law : body.tear_laws) {
    LawSettings settings = law.settings();
    TearLaw anew(body.request_for(settings), settings);
    if (!same_candidates(law.find(view), anew.find(view))) return "candidates of " + settings.criterion->name;
  }
  return {};
}

TEST(Rebinding, equals_binding_from_scratch_after_every_step_that_tears) {
  const std::string laws = R"(<tear criterion="global-border" threshold="0.02"/>
                              <tear criterion="atomic-border" threshold="0.1"/>)";
  for (const char* pattern : {"quads", "crossed", "mixed", "triangles"}) {
    for (const char* bend : {R"(<bend kind="provot" k="10"/>)", R"(<bend kind="angular" k="0.01"/>)"}) {
      SCOPED_TRACE(std::string(pattern) + bend);
      presets::Loaded scene = presets::load(
          presets::cloth(pattern, 8, laws, R"(<time step="5e-4" integrator="verlet" duration="1"/>)", bend));
      Body& body = scene.body();
      Surface surface(*body.map, body.border);
      std::size_t torn = 0;
      for (int n = 0; n < 800; ++n) {
        scene->step();
        surface.update();
        if (scene->tears() == torn) continue;
        torn = scene->tears();
        ASSERT_EQ(stale(body, &surface), "") << "at step " << n;
      }
      EXPECT_GT(torn, 20u);
    }
  }
}

// Random edits, mostly separations, with rules that change faces among them.
class Storm {
public:
  Storm(const PolygonMesh& mesh, const Recipe& recipe, unsigned seed)
      : body_(body(mesh, recipe)), noise_(seed) {
    shake(*body_, 0.1, seed);
    darts_at_most_ = 2 * body_->map->map().dart_count() + 100;
  }

  Body& operator*() { return *body_; }
  std::size_t fewest_darts() const { return fewest_; }

  void apply_random_edits() {
    const std::size_t edits = 1 + (noise_.below(4) == 0); // sometimes two edits before an update
    for (std::size_t n = 0; n < edits; ++n)
      body_->map->edit([&](Edit& edit) {
        const std::size_t changes = 1 + (noise_.below(3) == 0 ? noise_.below(4) : 0);
        for (std::size_t m = 0; m < changes; ++m) change(edit);
      });
    body_->rebind();
  }

private:
  Dart any(const GMap& map) {
    for (;;) {
      const Dart d{noise_.below(map.capacity())};
      if (map.alive(d)) return d;
    }
  }

  void change(Edit& edit) {
    const GMap& map = edit.map();
    const Dart d = any(map);
    const std::size_t what = noise_.below(100);
    const bool room = map.dart_count() < darts_at_most_;
    fewest_ = std::min(fewest_, map.dart_count());
    if (what < 40)
      separate(edit, d);
    else if (what < 75)
      sew_back(edit);
    else if (what < 82)
      sew(edit, 2, d, any(map));
    else if (what < 87 && room && sides_of_face(map, d) < 7)
      apply(rule("insert-vertex"), edit, d);
    else if (what < 92 && room)
      apply(rule("star-face"), edit, d);
    else if (room && (map.dart_count() < 150 || darts_of(map, Component, d).size() < 40))
      apply(rule("quarter-faces"), edit, d);
    else
      assets::remove_element(edit, d);
  }

  void separate(Edit& edit, Dart d) {
    const Dart other = edit.map().alpha(2, d);
    if (unsew(edit, 2, d)) opened_.push_back({d, other});
  }

  void sew_back(Edit& edit) {
    if (opened_.empty()) return;
    const std::size_t n = noise_.below(opened_.size());
    const auto [a, b] = opened_[n];
    opened_[n] = opened_.back();
    opened_.pop_back();
    if (edit.map().alive(a) && edit.map().alive(b)) sew(edit, 2, a, b);
  }

  std::unique_ptr<Body> body_;
  Noise noise_;
  std::size_t darts_at_most_ = 0, fewest_ = 1000000;
  std::vector<std::pair<Dart, Dart>> opened_;
};

void expect_storm_survived(const PolygonMesh& mesh, const Recipe& recipe, int edits, unsigned seed) {
  Storm storm(mesh, recipe, seed);
  Surface surface(*(*storm).map, (*storm).border);
  ASSERT_GT((*storm).program->folded().size(), 2u);
  ASSERT_EQ((*storm).program->elementary().size(), (*storm).program->folded().size());
  for (int n = 0; n < edits; ++n) {
    storm.apply_random_edits();
    surface.update();
    ASSERT_EQ(stale(*storm, &surface), "") << "after edit " << n;
    ASSERT_EQ(validate(*(*storm).map), std::nullopt) << "after edit " << n;
  }
  EXPECT_GT(storm.fewest_darts(), 60u) << "the storm blew itself out";
}

Recipe everything() {
  Recipe recipe;
  recipe.springs = all_springs(0.3);
  recipe.criteria = {"global-border", "atomic-border"};
  recipe.threshold = 0.5;
  recipe.drag = 0.1;
  recipe.fixed = true;
  recipe.scheme = "rk4"; // both sets of rows
  return recipe;
}

TEST(Rebinding, equals_binding_from_scratch_through_two_thousand_random_edits) {
  expect_storm_survived(sheet(SheetPattern::Mixed, 6, 5), everything(), 2000, 11);
}

TEST(Rebinding, equals_binding_from_scratch_through_random_edits_of_every_sheet) {
  unsigned seed = 20;
  for (const Named& each : irregular()) {
    SCOPED_TRACE(each.name);
    expect_storm_survived(each.mesh, everything(), 300, seed++);
  }
}

TEST(Rebinding, of_unfolded_rows_equals_binding_from_scratch) {
  Recipe recipe = everything();
  recipe.cumulated = Cumulated::No;
  expect_storm_survived(sheet(SheetPattern::Quads, 5, 5), recipe, 300, 40);
}

// No present interaction has patterns that depend on links beyond its own faces; a binder must handle them
// anyway.
TEST(Rebinding, of_words_that_reach_over_several_faces_equals_binding_from_scratch) {
  const Pattern pattern{.owner = EdgeOfFace,
                        .support = EdgeOfFace,
                        .units = {{"", "0121210"}, {"", "1210121"}},
                        .fold = {},
                        .present = [](const GMap&, Dart, std::size_t) { return true; }};
  const std::vector<IndexColumn> fields{{{"", ""}, Vertex},
                                        {{"0121210", "1210121"}, Vertex},
                                        {{"01210", "12101"}, FaceOfVolume},
                                        {{"0121", "121012"}, EdgeOfVolume}};
  Storm storm(sheet(SheetPattern::Mixed, 6, 5), everything(), 50);
  EmbeddedMap& map = *(*storm).map;
  map.use(FaceOfVolume);
  Binder binder(map, pattern, fields, 2);
  binder.bind();
  Changes changes;
  map.subscribe(changes);
  for (int n = 0; n < 600; ++n) {
    storm.apply_random_edits();
    binder.rebind(changes);
    changes.clear();
    Binder anew(map, pattern, fields, 2);
    anew.bind();
    ASSERT_TRUE(binder.rows().same_as(anew.rows())) << "after edit " << n;
  }
  map.unsubscribe(changes);
}

} // namespace
} // namespace rend::binder_test
