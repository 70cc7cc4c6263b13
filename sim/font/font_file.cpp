#ifdef REND_FONT
#include "sim/font/font.h"

// The assembler embeds the font files unchanged.
__asm__(".section .rodata\n"
        ".global rend_font, rend_font_end, rend_font_bold, rend_font_bold_end\n"
        ".balign 16\n"
        "rend_font: .incbin \"" REND_FONT_REGULAR "\"\n"
        "rend_font_end:\n"
        ".balign 16\n"
        "rend_font_bold: .incbin \"" REND_FONT_BOLD "\"\n"
        "rend_font_bold_end:\n"
        ".previous\n");

extern "C" {
extern const std::uint8_t rend_font[], rend_font_end[], rend_font_bold[], rend_font_bold_end[];
}

namespace rend {

std::span<const std::uint8_t> font_file(FontWeight weight) {
  if (weight == FontWeight::SemiBold) return {rend_font_bold, rend_font_bold_end};
  return {rend_font, rend_font_end};
}

} // namespace rend

#endif
