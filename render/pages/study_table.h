// A study as numbers: one row a run as CSV (RFC 4180), and all of it as JSON. Numbers have all their digits;
// what is not there (the error of a failed run) is empty in CSV and null in JSON.
#pragma once

#include "sim/study/study.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rend {

std::string csv_of(const StudyReport& report);
nlohmann::ordered_json json_of(const StudyReport& report);

} // namespace rend
