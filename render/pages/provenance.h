// Where figures come from: machine, build, preset and command line, for reports that others should be able to
// repeat.
#pragma once

#include "render/report/machine.h"
#include "render/report/page.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rend {

struct Provenance {
  Machine machine;
  std::string preset, hash; // its path as it was given, and XXH3 of its bytes, 16 hex digits
  std::string command;      // for a shell
  std::string date;         // of the run, UTC: ISO 8601
};

Provenance provenance_of_build(); // without a preset

Provenance provenance_of(const std::filesystem::path& preset, const std::string& text);

nlohmann::ordered_json json_of(const Provenance& provenance);
html::Html facts_of(const Provenance& provenance); // a part of a page

// The words as a shell reads them again.
std::string quoted_for_shell(const std::vector<std::string>& words);

} // namespace rend
