// All figures of a batch of runs as one CSV: a line a job, a column a figure.
#pragma once

#include "render/pages/batch_page.h"

#include <string>

namespace rend {

// The columns: job, preset, state, code, message (of a job that failed), seconds, peak_bytes; one for each
// attribute that differs between jobs, by its path; then every number, word and flag of `rend run --json`, by
// its path in there ("energy.kinetic", "probes.tip.position.0"), in the order in which they first appear. What
// a job does not have is empty. As RFC 4180 says, with line feeds. A text that begins with = + - or @ and is
// not a number has a ' before it: spreadsheets would run it as a formula.
std::string batch_csv(const BatchReport& report);

} // namespace rend
