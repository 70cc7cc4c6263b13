// A study's data: one row per run as CSV (RFC 4180), and everything as JSON. Numbers have all their digits; a
// value that does not exist (the error of a failed run) is empty in CSV and null in JSON.
#pragma once

#include "sim/study/study.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace rend {

std::string csv_of(const StudyReport& report);
nlohmann::ordered_json json_of(const StudyReport& report);

} // namespace rend
