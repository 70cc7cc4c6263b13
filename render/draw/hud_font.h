// The fonts of the HUD: Inter (SIL Open Font License), embedded in the program at build time.
#pragma once

#include <cstdint>
#include <span>

namespace rend {

std::span<const std::uint8_t> hud_font();      // for text
std::span<const std::uint8_t> hud_font_bold(); // for titles

} // namespace rend
