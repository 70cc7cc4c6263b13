#include "render/studies/lean_study.h"

#include "render/picture/scene_preset.h"
#include "render/studies/lean_picture.h"
#include "sim/build/build_scene.h"
#include "sim/scene/memory.h"
#include "sim/study/minimal_loop.h"

#include <fmt/format.h>

namespace rend {
namespace {

// A preset's text with `more` inserted into the first element of this name.
std::string with(const std::string& text, const std::string& name, const std::string& more) {
  if (more.empty()) return text;
  const std::size_t end = text.find("</" + name + ">");
  if (end == std::string::npos)
    throw UserError(Exit::BadInput, {}, "the scene has no <" + name + "> to put it into");
  return text.substr(0, end) + more + text.substr(end);
}

// One of the two scenes of a comparison.
class Built {
public:
  Built(const LeanScene& scene, const LeanSide& side, std::vector<Override> overrides) : bare_(side.bare) {
    for (const Setting& setting : side.settings) overrides.push_back({setting.path, setting.value});
    preset_ = load_scene_text(with(with(scene.text, "body", side.element), "world", side.world_element),
                              scene.file.empty() ? scene.name : scene.file, overrides);
    scene_ = std::make_unique<Scene>(
        read_scene(*preset_, scene_pictures()),
        SceneOptions{.walk = side.walk, .threads = 1, .count_fragments = side.count_fragments});
    if (!bare_) return;
    if (const std::string more = beyond_minimal(*scene_); !more.empty())
      throw UserError(Exit::BadInput, preset_->place(), "the scene has " + more);
    loop_ = std::make_unique<MinimalLoop>(*scene_);
  }

  void step() { loop_ ? loop_->step() : scene_->step(); }
  const Scene& scene() const { return *scene_; }

  std::size_t bytes() const { return bytes_of_all(*scene_); }

  // What the scene has of that which it was not asked for: against a loop that is bare.
  std::size_t bytes_not_asked_for() const {
    std::size_t sum = 0;
    std::vector<MemoryEntry> all = footprint_of(*scene_);
    for (const auto& body : scene_->bodies())
      for (MemoryEntry& one : footprint_of(*body)) all.push_back(std::move(one));
    for (const char* part : {"laws", "loads", "contact", "solver"}) sum += bytes_of_part(all, part);
    return sum;
  }

  Image picture(SmallPictures& pictures) { return pictures.of(*preset_, *scene_); }

private:
  std::unique_ptr<PresetNode> preset_;
  std::unique_ptr<Scene> scene_; // refers to the preset
  std::unique_ptr<MinimalLoop> loop_;
  bool bare_;
};

// Builds both scenes, alternating which is built first, since that determines where the second one lies in
// memory.
struct BothSides {
  BothSides(const LeanFeature& feature, const LeanScene& scene, const LeanPlan& plan, bool off_first) {
    const auto build = [&](std::unique_ptr<Built>& to, const LeanSide& side) {
      to = std::make_unique<Built>(scene, side, plan.overrides);
    };
    if (off_first) build(off, feature.off);
    build(on, feature.on);
    if (!off_first) build(off, feature.off);
  }
  std::unique_ptr<Built> off, on;
};

LeanRow measure(const LeanFeature& feature, const LeanScene& scene, const LeanPlan& plan,
                SmallPictures& pictures) {
  LeanRow row{.scene = scene.name,
              .feature = feature.name,
              .what = feature.what,
              .refused = "",
              .same = feature.same,
              .time = {}};
  if (feature.may_change_other_scenes && !scene.file.empty()) row.same = LeanSame::Free;
  try {
    if (!feature.needs.empty() && scene.text.find("<" + feature.needs) == std::string::npos)
      throw UserError(Exit::BadInput, {}, "the scene has no <" + feature.needs + ">");
    std::vector<TimedPairs> builds;
    row.same_state = row.same_pixels = true;
    for (int n = 0; n < plan.builds; ++n) {
      const BothSides sides(feature, scene, plan, n % 2 == 0);
      Built &off = *sides.off, &on = *sides.on;
      builds.push_back(time_pairs([&] { off.step(); }, [&] { on.step(); }, plan.pairs, plan.seconds));
      row.bytes_off = feature.off.bare ? 0 : off.bytes();
      row.bytes_on = feature.off.bare ? on.bytes_not_asked_for() : on.bytes();
      row.same_state = row.same_state && off.scene().hash() == on.scene().hash();
      if (n + 1 == plan.builds) row.same_pixels = off.picture(pictures).pixels == on.picture(pictures).pixels;
    }
    row.time = comparison_of(builds);
  } catch (const UserError& error) {
    row.refused = error.what();
  }
  return row;
}

} // namespace

bool LeanRow::as_required() const {
  if (!measured() || same == LeanSame::Free) return true;
  return same_pixels && (same_state || same == LeanSame::Pixels);
}

std::vector<LeanRow> run_lean(const LeanPlan& plan, const StudyCalls& calls) {
  SmallPictures pictures;
  std::vector<LeanRow> rows;
  const auto& features = lean_features();
  const double count = static_cast<double>(plan.scenes.size() * features.size());
  for (const LeanScene& scene : plan.scenes) {
    Built(scene, {}, plan.overrides); // reports errors in it now
    for (const LeanFeature& feature : features) {
      if (calls.going && !calls.going()) throw StopRequested{};
      if (calls.progress)
        calls.progress(scene.name + ": " + feature.name, static_cast<double>(rows.size()) / count);
      rows.push_back(measure(feature, scene, plan, pictures));
    }
  }
  return rows;
}

} // namespace rend
