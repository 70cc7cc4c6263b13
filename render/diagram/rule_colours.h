// The colours of links: α0 black, α1 red, α2 blue, as in the thesis (fig. 3.14), and α3 green. Dashes tell them
// apart in grey as well.
#pragma once

#include "render/diagram/drawing.h"

namespace rend {

inline Ink ink_of_link(int link) {
  constexpr unsigned colours[] = {0x111111, 0xc8102e, 0x1f5fbf, 0x1f8a3b};
  return {colours[link]};
}
inline std::vector<double> dashes_of_link(int link) {
  const std::vector<double> dashes[] = {{}, {7, 3}, {2, 3}, {9, 3, 2, 3}};
  return dashes[link];
}

} // namespace rend
