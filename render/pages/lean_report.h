// The results of `rend study --lean`, as CSV, JSON, a text table, and a page.
#pragma once

#include "render/pages/provenance.h"
#include "render/studies/lean_study.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace rend {

std::string csv_of(const std::vector<LeanRow>& rows);
nlohmann::ordered_json json_of(const std::vector<LeanRow>& rows);
std::string table_of(const std::vector<LeanRow>& rows); // at most 112 columns
std::string page_of(const std::vector<LeanRow>& rows, const Provenance& provenance);

} // namespace rend
