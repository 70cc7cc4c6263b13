// presets/scene.xsd, from the table by which presets are read: for completion and checks in editors.
//
// XSD 1.0 cannot express all of the table. Elements in any order are xs:all where none may be repeated, and
// then their counts are exact; where one may be repeated, they are an xs:choice, so that too few or too many of
// a kind pass the schema (the reader refuses them). Attributes are exact with two exceptions: the schema
// accepts numbers too small for a double, and xsi: attributes anywhere.
#pragma once

#include "sim/base/parameters.h"

#include <string>

namespace rend {

// The schema, XSD 1.0, UTF-8. A type is named after the path of the first element that has it.
std::string schema(const ElementType& root);

} // namespace rend
