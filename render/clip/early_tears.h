// Laws that tear in their first steps, at many times their threshold: it is far too low, or meant in another
// unit. A scene that begins at rest takes some steps until anything is stretched; one that is pulled suddenly
// may tear at once as it should, near its threshold.
#pragma once

#include "render/clip/session.h"

#include <optional>
#include <string>
#include <vector>

namespace rend {

// The step of a law's first tear, counted from the law's start, if it is one of the first ten (in a short clip,
// of the first hundredth of its steps, at least of two) and the law has reached ten times its threshold.
std::optional<long> early_step(const Session& session, const TearLaw& law, const TearEvent& first);

// A sentence on each such law.
std::vector<std::string> notes_on_early_tears(const Session& session);

} // namespace rend
