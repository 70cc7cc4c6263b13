// --set PATH=VALUE: an attribute of a preset, replaced or added before its value is parsed.
//
// A path consists of element names from the root's children down, then an attribute, separated by dots:
// time.step, body.sheet.cells, body[left].tear[2].threshold. Brackets contain the element's `name` or its
// number, counted from 1 among those of its kind; a number takes precedence over a name of digits. Brackets are
// required if there are several such elements. The root's own name may come first (scene.name and name are the
// same). An absent element that may occur once is created.
#pragma once

#include "sim/preset/raw_preset.h"

#include <span>
#include <string>
#include <string_view>

namespace rend {

struct Override {
  std::string path;
  std::string value;
};

// Splits "PATH=VALUE" at the first '=' outside brackets. Throws UserError (Usage) if there is none.
Override parse_override(std::string_view text);

// Applies them in order. Throws UserError (Usage) naming the part of a path that does not exist, and what does.
// A value that does not fit is found later, with the place "--set PATH=VALUE".
void apply_overrides(RawElement& root, std::span<const Override> overrides);

// What follows from the table alone, for every preset: the attribute of an override; UserError (Usage) if it
// does not exist.
const AttributeType& overridden(const ElementType& root, const Override& one);
// Checks that it exists, and that the value fits it: UserError (Usage, BadInput).
void check_override(const ElementType& root, const Override& one);

} // namespace rend
