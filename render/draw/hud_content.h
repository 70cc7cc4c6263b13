// The content of the head-up display: text, plots, and legends of colour scales. Numbers come as text,
// formatted by who knows their meaning and precision.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rend {

struct HudCurve {
  std::string name;
  std::array<std::uint8_t, 3> colour; // sRGB
  std::vector<float> values;          // one per frame of the clip, from its first
};

// Curves over the clip's time, with common axes.
struct HudPlot {
  std::string title;               // with the unit
  std::vector<HudCurve> curves;    // all of the same length
  float low = 0, high = 0;         // of the axis
  std::string low_text, high_text; // labels of its ends
  long frames = 0;                 // of the whole clip: the length of the time axis
};

// A colour bar, labelled at its ends.
struct HudLegend {
  std::string title; // with the unit
  std::string low, high;
  std::vector<std::array<std::uint8_t, 3>> colours; // sRGB, from low to high
};

// A line of text anywhere.
struct HudLine {
  std::string text = {};
  float x = 0, y = 0; // of its anchor, in shares of the picture, from its upper left corner
  float anchor = 0;   // the share of the line that is left of the anchor
  bool large = false; // as the title; else as the figures
  std::array<std::uint8_t, 3> colour{0x1c, 0x20, 0x26}; // sRGB
};

struct HudContent {
  std::string title, subtitle;      // top left
  std::vector<std::string> figures; // top right, one a line
  std::vector<HudPlot> plots;       // bottom left
  std::vector<HudLegend> legends;   // bottom right, stacked
  std::vector<HudLine> lines;       // over all of these

  bool empty() const {
    return title.empty() && subtitle.empty() && figures.empty() && plots.empty() && legends.empty() &&
           lines.empty();
  }
};

} // namespace rend
