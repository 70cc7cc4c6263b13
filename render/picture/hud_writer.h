// What <hud> asks for, written from the state of a scene: HudContent.
//
// Curves and scales follow the whole clip, whether a frame is drawn or not: observe() is called for every one,
// as for pictures (picture.h). What is not asked for is neither measured nor kept.
#pragma once

#include "render/draw/hud_content.h"
#include "sim/scene/scene.h"

#include <array>
#include <optional>
#include <vector>

namespace rend {

const ElementType& hud_type();

class HudWriter {
public:
  // `hud` is the preset's element; frames: of the clip.
  HudWriter(const PresetNode& hud, const Scene& scene, long frames);

  void observe(); // the state is that of a frame
  HudContent content(std::vector<HudLegend> legends) const;
  bool wants_legends() const { return legend_; }
  void store(Archive& archive); // the curves so far

private:
  HudPlot energy_plot() const;

  const Scene& scene_;
  std::string title_, subtitle_;
  bool time_ = false, energy_ = false, tears_ = false, legend_ = false, cost_ = false;
  long frames_;
  std::array<std::vector<float>, 4> energies_; // [J]: kinetic, elastic, of gravity since the start, their sum
  double gravity_at_start_ = 0;                // [J]
  double low_ = 0, high_ = 0;                  // [J], of the energies' axis
};

} // namespace rend
