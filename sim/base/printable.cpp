#include "sim/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace rend {
namespace {

struct Character {
  std::size_t bytes = 0;  // 0: no valid character
  std::uint32_t code = 0; // Unicode code point
};

// The UTF-8 character (RFC 3629) at the start of `text`, which is not empty.
Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t n) { return n < text.size() ? static_cast<unsigned char>(text[n]) : 0U; };
  const unsigned first = byte(0);
  if (first < 0x80) return {1, first};
  const std::size_t bytes = first >= 0xC2 && first < 0xE0   ? 2
                            : first >= 0xE0 && first < 0xF0 ? 3
                            : first >= 0xF0 && first < 0xF5 ? 4
                                                            : 0;
  std::uint32_t code = first & (0xFFU >> (bytes + 1));
  for (std::size_t n = 1; n < bytes; ++n) {
    if ((byte(n) & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte(n) & 0x3FU);
  }
  const bool overlong = code < (bytes == 4 ? 0x10000U : bytes == 3 ? 0x800U : 0x80U);
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return overlong || surrogate || code > 0x10FFFF ? Character{} : Character{bytes, code};
}

bool is_between(std::uint32_t code, std::uint32_t low, std::uint32_t high) {
  return code >= low && code <= high;
}

// Characters that act when shown: control characters (C0, DEL, C1: U+009B alone begins a terminal sequence),
// line and paragraph separators, marks that change the direction of reading, and characters that XML does not
// allow.
bool acts(std::uint32_t code) {
  return code < 0x20 || is_between(code, 0x7F, 0x9F) || is_between(code, 0x2028, 0x202E) ||
         is_between(code, 0x2066, 0x2069) || (code & 0xFFFEU) == 0xFFFE;
}

// The escape for a terminal, and the one for JSON (UTF-16 units).
std::string escape(const Character& character, std::string_view raw) {
  if (character.bytes > 1) return fmt::format("\\u{{{:x}}}", character.code);
  return raw == "\n"   ? "\\n"
         : raw == "\t" ? "\\t"
                       : fmt::format("\\x{:02x}", static_cast<unsigned char>(raw[0]));
}
std::string escape_in_json(const Character& character, std::string_view) {
  const std::uint32_t code = character.code, beyond = code - 0x10000;
  if (code < 0x10000) return fmt::format("\\u{:04x}", code);
  return fmt::format("\\u{:04x}\\u{:04x}", 0xD800 + (beyond >> 10U), 0xDC00 + (beyond & 0x3FFU));
}

// Removes the next character from `text` and returns it as it may be shown. An invalid byte counts as one
// character.
template <class Escape> std::string take(std::string_view& text, Escape escape) {
  const Character next = first_character(text);
  const std::string_view raw = text.substr(0, std::max<std::size_t>(next.bytes, 1));
  text.remove_prefix(raw.size());
  return next.bytes == 0 || acts(next.code) ? escape(next, raw) : std::string(raw);
}

template <class Escape> std::string shown(std::string_view text, std::string_view kept, Escape escape) {
  const auto is_plain = [&](unsigned char c) {
    return (c >= 0x20 && c < 0x7F) || kept.find(static_cast<char>(c)) != std::string_view::npos;
  };
  std::string out;
  out.reserve(text.size());
  while (true) { // most texts are copied in one piece
    const auto end = std::find_if_not(text.begin(), text.end(), is_plain);
    out.append(text.begin(), end);
    text.remove_prefix(static_cast<std::size_t>(end - text.begin()));
    if (text.empty()) return out;
    out += take(text, escape);
  }
}

} // namespace

std::string take_printable(std::string_view& text) {
  return take(text, escape);
}

std::string printable(std::string_view text) {
  return shown(text, "", escape);
}

std::string printable(std::string_view text, std::string_view instead) {
  return shown(text, "", [&](const Character&, std::string_view) { return std::string(instead); });
}

std::string printable_lines(std::string_view text) {
  return shown(text, "\n\t", escape);
}

std::string printable_json(std::string_view json) {
  return shown(json, "\n", escape_in_json);
}

} // namespace rend
