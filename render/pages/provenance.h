// Provenance of figures: machine, build, preset and command line, for reproducible reports.
#pragma once

#include "render/report/machine.h"
#include "render/report/page.h"

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rend {

struct Provenance {
  Machine machine;
  std::string preset, hash; // its path as given, and the XXH3 of its bytes, 16 hex digits
  std::string command;      // quoted for a shell
  std::string date;         // of the run, UTC: ISO 8601
};

Provenance provenance_of_build(); // without a preset

Provenance provenance_of(const std::filesystem::path& preset, const std::string& text);

nlohmann::ordered_json json_of(const Provenance& provenance);
html::Html facts_of(const Provenance& provenance); // a part of a page

// The words, quoted so that a shell splits them in the same way.
std::string quoted_for_shell(const std::vector<std::string>& words);

} // namespace rend
