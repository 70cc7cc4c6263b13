// The figures of a run: one object for `--json`, whose names are a contract with tests and benchmarks, and a
// summary to read.
#pragma once

#include "render/clip/session.h"
#include "render/pipeline/pipeline.h"

#include <nlohmann/json.hpp>
#include <string>

namespace rend {

// What a run cost beyond the time loop.
struct Costs {
  double total = 0;         // [s], from reading the preset on
  double surface = 0;       // [s]
  PipelineSeconds pictures; // [s]
  std::size_t surface_bytes = 0;
};

// Of the present state: the last good one where the run was stopped. Without `simulated` nothing was, and what
// one would come to is not known: all figures of the state are null.
nlohmann::ordered_json figures_of(const Session& session, Stopped stopped, const Costs& costs,
                                  bool simulated = true);

std::string summary_of(const nlohmann::ordered_json& figures);

} // namespace rend
