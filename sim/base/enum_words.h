// The words of an enumeration: one array in the order of its enumerators, the last of which says how many.
//
//   const char* name_of(Verdict verdict) {
//     static constexpr EnumWords<Verdict::Failed> words{"ok", "refused", "known limit", "failed"};
//     return words[verdict];
//   }
//
// An enumerator without a word does not compile. (A switch says the same in ten lines, and has to return
// something after them.)
#pragma once

#include <array>
#include <concepts>
#include <cstddef>

namespace rend {

// For enumerators from 0 to `last`, without gaps.
template <auto last> class EnumWords {
public:
  static constexpr std::size_t count = static_cast<std::size_t>(last) + 1;
  template <std::convertible_to<const char*>... Each>
  requires(sizeof...(Each) == count) constexpr EnumWords(Each... each) : words_{each...} {}

  constexpr const char* operator[](decltype(last) enumerator) const {
    return words_[static_cast<std::size_t>(enumerator)];
  }

private:
  std::array<const char*, count> words_;
};

} // namespace rend
