// A block of a page: two pictures of which one is expected and one is there, to be looked at in every way.
//
// Slider, blink, side by side, difference, heat map, each alone; the worst place enlarged in all of them, and
// any other by a click. The pictures stand in the page once each, as their own files, and every way of looking
// is a matter of style and script. Without script the pictures stand side by side.
#pragma once

#include "render/report/page.h"

#include <string>
#include <string_view>

namespace rend::html {

struct Compare {
  std::string name;            // of the case; for alternative texts
  std::string_view a, b, heat; // PNG files: expected, now, map of errors; an empty one is left out
  int width = 0, height = 0;   // [pixels] of all three, or of `a` where b has another size
  bool same_size = true;       // false: they are only shown side by side
  int x = 0, y = 0;            // [pixels] middle of the worst place
};
Html compare(const Compare& all);

// For page().
extern const std::string_view compare_style, compare_script;

} // namespace rend::html
