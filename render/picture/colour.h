// Colours of presets, of quantities and of fragments. All are sRGB, 8 bits a channel.
#pragma once

#include "sim/base/settings.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace rend {

using Colour = std::array<std::uint8_t, 3>;

// "#rrggbb", and what it stands for; none: it is no colour.
std::string text_of(const Colour& colour);
std::optional<Colour> colour_called(std::string_view text);

// The field of a member that is a colour, or an optional one: the attribute's word `none` stands for no colour.
// Whether the text is a colour is asked before (colour_of): it takes no other.
template <class S> Field<S> colour_field(Colour S::*member, AttributeType type) {
  type.otherwise(text_of(S{}.*member));
  return {type, [member](S& s, const AttributeValue& value) { s.*member = colour_called(value.text).value(); },
          [](const S&, const SettingsSource&) {}};
}
template <class S>
Field<S> colour_field(std::optional<Colour> S::*member, AttributeType type, const std::string& none = {}) {
  const std::optional<Colour> by_default = S{}.*member;
  if (by_default) type.otherwise(text_of(*by_default));
  return {type,
          [member, none](S& s, const AttributeValue& value) {
            s.*member = value.text == none ? std::nullopt : std::optional(colour_called(value.text).value());
          },
          [](const S&, const SettingsSource&) {}};
}

// The colour "#rrggbb" that an attribute holds. UserError with its place where it holds none.
Colour colour_of(const PresetNode& node, std::string_view attribute);

// The colour map viridis (van der Walt and Smith 2015) at `share` = 0 to 1 of the scale; it is perceptually
// uniform, also for readers with red-green colour blindness. Values outside are clamped.
Colour colour_of_share(double share);

// Categorical colours: hues in steps of the golden ratio, so that any first n are well spread; of equal
// lightness, except that every other one is darker or lighter (Oklch, Ottosson 2020).
Colour colour_of_number(std::size_t number);

// The smallest of 1, 2, 5, 10, 20, ... times a power of ten that is not below `value`; 0 for 0.
double rounded_up(double value);

} // namespace rend
