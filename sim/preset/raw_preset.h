// A preset as it stands in its file: elements and attributes with their places, before values are looked at.
//
// expat decides whether the file is XML (it refuses duplicate attributes, two roots and trailing text). Beyond
// that only names are checked here, while the file is read: an element that the table does not know is refused
// at once, so nothing can nest deeper than the table does. DTDs, and with them entities of one's own, are
// refused: no preset needs them, and they can swell to any size. Comments and processing instructions are
// skipped.
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

  const RawAttribute* find(std::string_view attribute) const; // null if it does not stand there
  std::vector<RawElement*> all(std::string_view name) const;  // the children of that name
  void set(const AttributeType& type, const std::string& text, const Place& place); // replaces or adds
};

// Reads `text`, which is UTF-8 and came from `file` (only for messages; columns count characters, not bytes).
// Throws UserError (BadInput) with line and column where it is not well-formed or a name is unknown.
std::unique_ptr<RawElement> read_raw_preset(std::string_view text, const std::string& file,
                                            const ElementType& root);

} // namespace rend
