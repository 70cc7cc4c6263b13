// `rend help preset`: the parameter table as text, at most 100 columns wide.
#pragma once

#include "sim/base/parameters.h"

#include <optional>
#include <string>

namespace rend {

// The page of all elements, or of `element`: a name (stretch: all elements of that name) or a path as in --set
// (body.springs.stretch). `colour` adds terminal codes. Throws UserError (Usage) if there is no such element.
std::string help_preset(const ElementType& root, const std::optional<std::string>& element, bool colour);

// A few sentences on what a preset is.
std::string introduction(const ElementType& root);

} // namespace rend
