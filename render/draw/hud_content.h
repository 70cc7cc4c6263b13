// What is written over a picture: words, curves and the legend of its colours. Numbers come as text, since what
// they mean and how exact they are is not known here.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace rend {

struct HudCurve {
  std::string name;
  std::array<std::uint8_t, 3> colour; // sRGB
  std::vector<float> values;          // one a frame of the clip, from its first
};

// Curves over the clip's time, in one frame of axes.
struct HudPlot {
  std::string title;               // with the unit
  std::vector<HudCurve> curves;    // all as long
  float low = 0, high = 0;         // of the axis
  std::string low_text, high_text; // what is written at its ends
  long frames = 0;                 // of the whole clip: where the curves will end
};

// A bar of colours with its ends.
struct HudLegend {
  std::string title; // with the unit
  std::string low, high;
  std::vector<std::array<std::uint8_t, 3>> colours; // sRGB, from low to high
};

struct HudContent {
  std::string title, subtitle;      // top left
  std::vector<std::string> figures; // top right, one a line
  std::vector<HudPlot> plots;       // bottom left
  std::vector<HudLegend> legends;   // bottom right, one above another

  bool empty() const {
    return title.empty() && subtitle.empty() && figures.empty() && plots.empty() && legends.empty();
  }
};

} // namespace rend
