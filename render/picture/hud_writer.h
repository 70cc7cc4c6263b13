// Fills HudContent from the state of a scene, as the preset's <hud> asks for.
//
// Curves and scales follow the whole clip, whether a frame is drawn or not: observe() is called for every one,
// as for pictures (scene_picture.h). What is not asked for is neither measured nor kept.
#pragma once

#include "render/draw/hud_content.h"
#include "sim/base/settings.h"
#include "sim/scene/scene.h"

#include <array>
#include <optional>
#include <vector>

namespace rend {

// <hud>
struct HudSettings {
  // Any of: title, time, energy (curves of the energies), tears (how many, and fragments), legend (the scale of
  // the bodies' colours), cost (of a step; it differs from run to run).
  std::vector<std::string> show{"title", "time", "tears", "legend"};
  std::optional<std::string> title = {}; // none: the scene's name
  std::optional<std::string> subtitle = {};
  SettingsSource source = {};
};
template <> const Fields<HudSettings>& fields_of();

class HudWriter {
public:
  // frames: of the clip.
  HudWriter(const HudSettings& hud, const Scene& scene, long frames);

  void observe(); // call with the state of each frame
  HudContent content(std::vector<HudLegend> legends) const;
  bool wants_legends() const { return legend_; }
  void store(Archive& archive); // the curves so far; checkpoint

private:
  HudPlot energy_plot() const;

  const Scene& scene_;
  std::string title_, subtitle_;
  bool time_ = false, energy_ = false, tears_ = false, legend_ = false, cost_ = false;
  long frames_;
  // [J]: kinetic, elastic, gravitational since the start, their sum
  std::array<std::vector<float>, 4> energies_;
  double gravity_at_start_ = 0; // [J]
  double low_ = 0, high_ = 0;   // [J], range of the energy axis
};

} // namespace rend
