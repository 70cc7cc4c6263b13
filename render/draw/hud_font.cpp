#ifdef REND_HUD
#include "render/draw/hud_font.h"

#include "sim/base/check.h"

// The assembler embeds the font files unchanged.
__asm__(".section .rodata\n"
        ".global rend_hud_font, rend_hud_font_end, rend_hud_font_bold, rend_hud_font_bold_end\n"
        ".balign 16\n"
        "rend_hud_font: .incbin \"" REND_FONT "\"\n"
        "rend_hud_font_end:\n"
        ".balign 16\n"
        "rend_hud_font_bold: .incbin \"" REND_FONT_BOLD "\"\n"
        "rend_hud_font_bold_end:\n"
        ".previous\n");

extern "C" {
extern const std::uint8_t rend_hud_font[], rend_hud_font_end[], rend_hud_font_bold[], rend_hud_font_bold_end[];
}

namespace rend {

std::span<const std::uint8_t> hud_font() {
  return {rend_hud_font, rend_hud_font_end};
}
std::span<const std::uint8_t> hud_font_bold() {
  return {rend_hud_font_bold, rend_hud_font_bold_end};
}

} // namespace rend

#endif
