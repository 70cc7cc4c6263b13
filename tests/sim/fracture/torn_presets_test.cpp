// Every shipped preset that tears, checked at each change: the map stays valid, no vertex moves, mass and
// momentum are conserved to the last bit, and all that depends on the map equals what is built from scratch;
// flat arrays agree with walking the map; and two threads give the same events.
//
// By default the first torn steps of each; with REND_WHOLE in the environment the whole clips (tests/run
// --all).
#include "render/picture/scene_preset.h"
#include "sim/build/build_scene.h"
#include "sim/fracture/torn_checks.h"
#include "sim/rows/walk_forces.h"
#include "sim/scene/scene.h"
#include "tests/test_paths.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace rend::torn_presets_test {
namespace {

namespace fs = std::filesystem;
using namespace torn;

const fs::path root = fs::path(test::source_root) / "presets";

std::vector<std::string> presets_with_laws() {
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(root)) {
    if (entry.path().extension() != ".xml") continue;
    std::ifstream file(entry.path());
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    if (text.find("<tear ") != std::string::npos)
      names.push_back(fs::relative(entry.path(), root).replace_extension().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

struct Played {
  std::unique_ptr<PresetNode> preset;
  Scene scene;
  Played(const std::string& name, int threads)
      : preset(load_scene(root / (name + ".xml"))),
        scene(read_scene(*preset, scene_pictures()), SceneOptions{.threads = threads}) {}
  long steps() const { return static_cast<long>(scene.duration() / scene.step_size()); }
};

// Within 1e-12 of the largest force, or of the forces that cancel at a vertex.
void expect_walk_agrees(const Body& body) {
  const Record *x = body.map->position().values().data(), *v = body.map->velocity().values().data();
  std::vector<Record> flat(body.vertices()), walked(body.vertices());
  body.program->forces(x, v, flat.data());
  walk_forces(*body.map, body.interactions, body.mass->orbit(), x, v, nullptr, walked.data());
  double most = 0, apart = 0;
  for (std::size_t n = 0; n < flat.size(); ++n) {
    most = std::max(most, flat[n].vec().norm());
    apart = std::max(apart, (flat[n].vec() - walked[n].vec()).norm());
  }
  EXPECT_LE(apart, 1e-12 * most);
}

// Checks a body before and after each law's changes.
class Watch {
public:
  explicit Watch(Body& body) : body_(body), seen_(body) {
    body.change_observer = [this](WitnessAt when) { when == WitnessAt::AfterChanges ? after() : before(); };
  }
  int looks = 0;

private:
  void before() {
    events_ = body_.events.size();
    then_.emplace(body_);
  }
  void after() {
    ++looks;
    bool deleted = false;
    for (std::size_t e = events_; e < body_.events.size(); ++e)
      deleted |=
          body_.tear_laws[static_cast<std::size_t>(body_.events[e].law)].settings().change->name.starts_with(
              "delete");
    expect_nothing_moved(body_, *then_, deleted);
    seen_.update();
    expect_as_built_anew(body_, seen_);
    expect_walk_agrees(body_);
  }

  Body& body_;
  Seen seen_;
  std::size_t events_ = 0;
  std::optional<Snapshot> then_;
};

bool same_events(const Body& a, const Body& b) {
  return std::equal(a.events.begin(), a.events.end(), b.events.begin(), b.events.end(),
                    [](const TearEvent& p, const TearEvent& q) {
                      return p.step == q.step && p.law == q.law && p.value == q.value && p.dart == q.dart &&
                             p.place == q.place;
                    });
}

class TornPreset : public testing::TestWithParam<std::string> {};

TEST_P(TornPreset, keeps_what_a_change_must_keep_and_two_threads_make_the_same_events) {
  const bool whole = std::getenv("REND_WHOLE");
  if (!whole && GetParam() == "showcase/paper-ball")
    GTEST_SKIP() << "its first change comes after minutes of packed contact: in tests/run --all=whole";
  const int most = whole ? std::numeric_limits<int>::max() : 12; // number of checks
  Played run(GetParam(), 1), other(GetParam(), 2);
  std::vector<std::unique_ptr<Watch>> watches;
  for (const auto& body : run.scene.bodies())
    if (body->tears()) watches.push_back(std::make_unique<Watch>(*body));
  const auto looks = [&] {
    int sum = 0;
    for (const auto& watch : watches) sum += watch->looks;
    return sum;
  };
  while (run.scene.steps_done() < run.steps() && looks() < most && !HasFailure()) run.scene.step();
  EXPECT_GT(looks(), 0) << "it never tears";
  while (other.scene.steps_done() < run.scene.steps_done()) other.scene.step();
  EXPECT_EQ(run.scene.hash(), other.scene.hash());
  for (std::size_t n = 0; n < run.scene.bodies().size(); ++n)
    EXPECT_TRUE(same_events(*run.scene.bodies()[n], *other.scene.bodies()[n]));
}

INSTANTIATE_TEST_SUITE_P(All, TornPreset, testing::ValuesIn(presets_with_laws()), [](const auto& one) {
  std::string name = one.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

} // namespace
} // namespace rend::torn_presets_test
