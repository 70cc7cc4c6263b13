// --set PATH=VALUE: an attribute of a preset, replaced or added before its value is looked at.
//
// A path names elements from the root's children down, then an attribute, with dots between: time.step,
// body.sheet.cells, body[left].tear[2].threshold. In brackets stands the element's `name` or its number,
// counted from 1 among those of its kind; a number wins over a name of digits. Brackets are needed where there
// are several. The root's own name may come first (scene.name and name are the same). An element that is absent
// but may stand once is made.
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

// Applies them in their order. Throws UserError (Usage) that names the part of a path that is not there, and
// what is. A value that does not fit is found later, and its place is "--set PATH=VALUE".
void apply_overrides(RawElement& root, std::span<const Override> overrides);

// What the table alone tells, whatever a preset holds. The attribute that one is for; UserError (Usage) where
// there is none.
const AttributeType& overridden(const ElementType& root, const Override& one);
// That there is one, and that the value fits it: UserError (Usage, BadInput).
void check_override(const ElementType& root, const Override& one);

} // namespace rend
