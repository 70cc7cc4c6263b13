// presets/scene.xsd, from the same table that reads presets: editors complete and check by it.
//
// XSD 1.0 cannot say all of the table. Elements in any order are xs:all where none may be repeated, and then
// their numbers are exact; where one may, they are an xs:choice of any of them, so that too few or too many of
// one kind pass the schema (the reader refuses them). Attributes are exact but for this: the schema takes
// numbers too small for a double, and lets xsi: attributes stand anywhere.
#pragma once

#include "sim/base/parameters.h"

#include <string>

namespace rend {

// The schema, XSD 1.0, UTF-8. Types are called by the path of the element that has them first.
std::string schema(const ElementType& root);

} // namespace rend
