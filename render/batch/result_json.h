// Results of jobs as JSON: a line of `rend batch --json`, and all of a result, as files store it.
#pragma once

#include "render/batch/batch_jobs.h"
#include "render/batch/batch_result.h"

#include <nlohmann/json_fwd.hpp>

namespace rend {

nlohmann::ordered_json line_of(const BatchJob& job, const BatchResult& result);

nlohmann::ordered_json stored_result(const BatchJob& job, const BatchResult& result);
// Throw exceptions of nlohmann's where it is no such object.
BatchJob job_from(const nlohmann::ordered_json& json);
BatchResult result_from(const nlohmann::ordered_json& json);

} // namespace rend
