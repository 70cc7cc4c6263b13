// Fills HudContent from the state of a scene, as the preset's <hud> asks for.
//
// Curves and scales follow the whole clip, whether a frame is drawn or not: observe() is called for every one,
// as for pictures (scene_picture.h). What is not asked for is neither measured nor kept.
//
// A <text> stands anywhere in the picture. Words in braces are replaced in every frame, "{time}, {tears}
// tears": hud_placeholders() lists them.
#pragma once

#include "render/draw/hud_content.h"
#include "render/picture/colour.h"
#include "sim/base/settings.h"
#include "sim/scene/scene.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rend {

// <text>
struct HudText {
  enum class Align { Left, Centre, Right };
  enum class Size { Small, Large };
  std::array<double, 2> at{0.5,
                           0.9}; // of its anchor, in shares of width and height, from the upper left corner
  std::string text = {};
  Align align = Align::Centre; // where in the text its anchor is
  Size size = Size::Small;
  Colour colour{0x1c, 0x20, 0x26};
  SettingsSource source = {};
};
template <> const Fields<HudText>& fields_of();

// Words that a text may have in braces, with what takes their place.
const std::vector<std::pair<std::string, std::string>>& hud_placeholders();

// UserError: braces that are not closed, or around another word.
void check_text(const HudText& text);

// <hud>
struct HudSettings {
  // Any of: title, time, energy (curves of the energies), tears (how many, and fragments), legend (the scale of
  // the bodies' colours), cost (of a step; it differs from run to run); or none.
  std::vector<std::string> show{"title", "time", "tears", "legend"};
  std::optional<std::string> title = {}; // none: the scene's name
  std::optional<std::string> subtitle = {};
  std::vector<HudText> texts = {};
  SettingsSource source = {};
};
template <> const Fields<HudSettings>& fields_of();

class HudWriter {
public:
  // frames: of the clip.
  HudWriter(const HudSettings& hud, const Scene& scene, long frames);

  void observe(); // call with the state of each frame
  // frame: its number; speed: of the clip there (playback.h).
  HudContent content(std::vector<HudLegend> legends, long frame, double speed) const;
  bool wants_legends() const { return legend_; }
  void store(Archive& archive); // the curves so far; checkpoint

private:
  HudPlot energy_plot() const;
  std::string value_of(const std::string& placeholder, long frame, double speed) const;

  const Scene& scene_;
  std::string title_, subtitle_; // that are shown
  std::string name_;             // the title, shown or not
  std::vector<HudText> texts_;
  bool time_ = false, energy_ = false, tears_ = false, legend_ = false, cost_ = false;
  long frames_;
  // [J]: kinetic, elastic, gravitational since the start, their sum
  std::array<std::vector<float>, 4> energies_;
  double gravity_at_start_ = 0; // [J]
  double low_ = 0, high_ = 0;   // [J], range of the energy axis
};

} // namespace rend
