// For tests of the preset reader: reads texts with the small table, and returns the messages of errors.
#pragma once

#include "sim/preset/preset_reader.h"
#include "tests/render/help/small_table.h"

#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <vector>

namespace rend::small_table {

inline std::unique_ptr<PresetNode> read(const std::string& text, std::vector<std::string> sets = {}) {
  std::vector<Override> overrides;
  for (const std::string& set : sets) overrides.push_back(parse_override(set));
  return read_preset_text(text, "p.xml", scene, overrides);
}

inline std::string with_hint(const UserError& error) {
  return error.what() + (error.hint.empty() ? "" : " | " + error.hint);
}

// Runs `act`, which must throw a UserError with `code`; returns its place, message and hint.
template <class Act> std::string refusal(Exit code, Act act) {
  try {
    act();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, code) << error.what();
    return with_hint(error);
  }
  ADD_FAILURE() << "it was not refused";
  return {};
}

inline std::string refused(const std::string& text) {
  return refusal(Exit::BadInput, [&] { read(text); });
}

// The preset with `from` replaced by `to`.
inline std::string changed(const std::string& from, const std::string& to) {
  std::string text = preset;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

inline void expect_starts(const std::string& text, const std::string& start) {
  EXPECT_EQ(text.substr(0, start.size()), start) << "in: " << text;
}

} // namespace rend::small_table
