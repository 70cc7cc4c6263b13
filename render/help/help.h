// `rend help preset`, `rend help tolerances`: a table of parameters as text.
#pragma once

#include "render/help/folding.h"
#include "sim/base/parameters.h"

#include <optional>
#include <string>

namespace rend {

// The page of all elements, after `opening`, or of `element`: a name (stretch: all elements of that name) or a
// path as in --set (body.springs.stretch). `colour` adds terminal codes; lines have at most `columns`, unless a
// word is longer. Throws UserError (Usage) if there is no such element.
std::string help_elements(const ElementType& root, const std::string& opening,
                          const std::optional<std::string>& element, bool colour, std::size_t columns);

// The same of presets.
std::string help_preset(const ElementType& root, const std::optional<std::string>& element, bool colour,
                        std::size_t columns = page_columns);

// A few sentences on what a preset is.
std::string introduction(const ElementType& root);

} // namespace rend
