// A block of a page that compares two pictures, the expected and the current one, interactively.
//
// Slider, blink, side by side, difference, heat map, each by itself; with a magnified view of the worst place
// in all of them, and of any other place by a click. Each picture is embedded once, as its original file; all
// views are made by CSS and script. Without script the pictures are shown side by side.
#pragma once

#include "render/report/page.h"

#include <string>
#include <string_view>

namespace rend::html {

struct ComparisonView {
  std::string name;            // of the case; for alternative texts
  std::string_view a, b, heat; // PNG files: expected, current, heat map of errors; an empty one is omitted
  int width = 0, height = 0;   // [pixels] of all three, or of `a` if b has another size
  bool same_size = true;       // false: only shown side by side
  int x = 0, y = 0;            // [pixels] centre of the worst place
};
Html compare(const ComparisonView& all);

// Arguments for page().
extern const std::string_view compare_style, compare_script;

} // namespace rend::html
