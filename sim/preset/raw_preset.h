// A preset as written in its file: elements and attributes with their places, before values are parsed.
//
// expat checks that the file is XML (it refuses duplicate attributes, two roots and trailing text). Beyond that
// only names are checked here, while reading: an element that is not in the table is refused at once, so
// nesting is limited by the table. DTDs, and with them user-defined entities, are refused: no preset needs
// them, and they can expand to any size. Comments and processing instructions are skipped.
#pragma once

#include "sim/base/parameters.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

struct RawAttribute {
  const AttributeType* type;
  std::string text;
  Place place; // of the first character of the value
};

struct RawElement {
  const ElementType* type;
  Place place; // of its '<'
  std::vector<RawAttribute> attributes;
  std::vector<std::unique_ptr<RawElement>> children;
  std::vector<std::unique_ptr<AttributeType>> further; // of attributes that its type does not list

  const RawAttribute* find(std::string_view attribute) const;                       // null if it is not given
  std::vector<RawElement*> all(std::string_view name) const;                        // the children of that name
  void set(const AttributeType& type, const std::string& text, const Place& place); // replaces or adds
};

// Reads `text`, which is UTF-8 and came from `file` (only for messages; columns count characters, not bytes).
// Throws UserError (BadInput) with line and column if it is not well-formed or a name is unknown.
std::unique_ptr<RawElement> read_raw_preset(std::string_view text, const std::string& file,
                                            const ElementType& root);

} // namespace rend
