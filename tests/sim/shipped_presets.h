// The shipped presets, for tests that run over each of them.
#pragma once

#include "tests/test_paths.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

namespace rend::shipped {

inline std::filesystem::path folder() {
  return std::filesystem::path(test::source_root) / "presets";
}
inline std::filesystem::path path_of(const std::string& name) {
  return folder() / (name + ".xml");
}

// Sorted names, such as "tear/moebius".
inline std::vector<std::string> all_presets() {
  namespace fs = std::filesystem;
  std::vector<std::string> names;
  for (const auto& entry : fs::recursive_directory_iterator(folder()))
    if (entry.path().extension() == ".xml")
      names.push_back(fs::relative(entry.path(), folder()).replace_extension().string());
  std::sort(names.begin(), names.end());
  return names;
}

// The name of a preset as part of a test's name.
inline std::string as_word(const testing::TestParamInfo<std::string>& one) {
  std::string name = one.param;
  std::replace_if(
      name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
}

} // namespace rend::shipped
