// Index types that the compiler tells apart: a dart is not a vertex, a vertex is not an edge.
#pragma once

#include <compare>
#include <cstdint>

namespace rend {

// A 32-bit index of one kind of thing. `none` stands for "no such thing".
template <class Tag> struct Id {
  static constexpr std::uint32_t none_value = 0xffffffffu;

  std::uint32_t value = none_value;

  constexpr Id() = default;
  constexpr explicit Id(std::uint32_t v) : value(v) {}
  constexpr explicit Id(std::size_t v) : value(static_cast<std::uint32_t>(v)) {}
  constexpr explicit operator bool() const { return value != none_value; }
  friend constexpr auto operator<=>(Id, Id) = default;
};

using Dart = Id<struct DartTag>;

} // namespace rend
