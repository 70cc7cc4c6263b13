#include "sim/preset/raw_preset.h"

#include "sim/base/check.h"
#include "sim/base/expat_reader.h"

#include <algorithm>
#include <array>
#include <climits>
#include <fmt/format.h>
#include <iterator>
#include <span>
#include <utility>

namespace rend {

const RawAttribute* RawElement::find(std::string_view attribute) const {
  for (const RawAttribute& one : attributes) {
    if (one.type->name == attribute) return &one;
  }
  return nullptr;
}

std::vector<RawElement*> RawElement::all(std::string_view name) const {
  std::vector<RawElement*> out;
  for (const auto& child : children) {
    if (child->type->name == name) out.push_back(child.get());
  }
  return out;
}

void RawElement::set(const AttributeType& attribute, const std::string& text, const Place& at) {
  for (RawAttribute& one : attributes) {
    if (one.type != &attribute) continue;
    one.text = text;
    one.place = at;
    return;
  }
  attributes.push_back({&attribute, text, at});
}

namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::string_view blanks = " \t\r\n";

// Line and column of a byte. Lines end with \n, \r or \r\n. Each search continues from the last byte, since
// bytes are mostly asked for in increasing order: a preset may be one long line. (An earlier byte is searched
// from the start.)
class Lines {
public:
  Lines(std::string_view text, std::string file) : text_(text) { place_.file = std::move(file); }

  Place at(std::size_t byte) {
    byte = std::min(byte, text_.size());
    if (byte < byte_ || byte_ == 0) rewind();
    for (; byte_ < byte; ++byte_) {
      const char c = text_[byte_];
      const bool pair = c == '\r' && byte_ + 1 < text_.size() && text_[byte_ + 1] == '\n';
      if (c == '\n' || (c == '\r' && !pair)) {
        ++place_.line;
        place_.column = 1;
      } else if ((static_cast<unsigned char>(c) & 0xC0U) != 0x80U) {
        ++place_.column;
      }
    }
    return place_;
  }

private:
  void rewind() {
    place_.line = place_.column = 1;
    byte_ = text_.starts_with(byte_order_mark) ? byte_order_mark.size() : 0;
  }

  std::string_view text_;
  std::size_t byte_ = 0;
  Place place_; // of byte_
};

std::vector<std::string> child_names(const ElementType& type) {
  std::vector<std::string> out;
  for (const ChildType& child : type.children) out.push_back(child.type->name);
  return out;
}

std::vector<std::string> attribute_names(const ElementType& type) {
  std::vector<std::string> out;
  for (const AttributeType& attribute : type.attributes) out.push_back(attribute.name);
  return out;
}

const ElementType* child_type(const ElementType& type, std::string_view name) {
  for (const ChildType& child : type.children) {
    if (child.type->name == name) return child.type;
  }
  return nullptr;
}

// What to say of words that other programs have and presets do not; empty: nothing.
std::string said_of_missing(std::string_view name) {
  constexpr std::array opaque{"opacity", "transparency", "transparent", "alpha"};
  constexpr std::array plain{"texture", "map", "uv"};
  const auto among = [&](const auto& words) {
    return std::find(words.begin(), words.end(), name) != words.end();
  };
  if (among(opaque))
    return "there is none: bodies are opaque (<image background=\"none\"> makes what is behind them "
           "transparent). ";
  if (among(plain)) return "there is none: a <look> gives a body one colour, a back, an inside and a finish. ";
  return {};
}

// The elements in which `name` may stand, in the order of the table.
void collect_parents(const ElementType& type, std::string_view name, std::vector<std::string>& out) {
  const std::string own = "<" + type.name + ">";
  if (child_type(type, name) && std::find(out.begin(), out.end(), own) == out.end()) out.push_back(own);
  for (const ChildType& child : type.children) collect_parents(*child.type, name, out);
}

std::string_view name_at(std::string_view text, std::size_t byte) {
  text.remove_prefix(std::min(byte, text.size()));
  return text.substr(0, std::min(text.find_first_of(" \t\r\n=/>\"'<&"), text.size()));
}

// Reads one file.
class Reader : ExpatReader<Reader> {
  friend ExpatReader<Reader>;

public:
  Reader(std::string_view text, const std::string& file, const ElementType& root)
      : ExpatReader("UTF-8"), text_(text), root_type_(root), lines_(text, file) {
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(
        parser_,
        [](void* self, const char* name, const char** attributes) {
          static_cast<Reader*>(self)->guard([&](Reader& reader) { reader.open(name, attributes); });
        },
        [](void* self, const char*) {
          static_cast<Reader*>(self)->guard([](Reader& reader) { reader.close(); });
        });
    XML_SetCharacterDataHandler(parser_, [](void* self, const char* data, int size) {
      static_cast<Reader*>(self)->guard([&](Reader& reader) {
        reader.characters({data, static_cast<std::size_t>(size)});
      });
    });
    XML_SetStartDoctypeDeclHandler(parser_, [](void* self, const char*, const char*, const char*, int) {
      static_cast<Reader*>(self)->guard([](Reader& reader) { reader.doctype(); });
    });
    XML_SetXmlDeclHandler(parser_, [](void* self, const char*, const char* encoding, int) {
      static_cast<Reader*>(self)->guard([&](Reader& reader) { reader.declaration(encoding); });
    });
  }

  std::unique_ptr<RawElement> read() {
    CHECK(text_.size() <= INT_MAX);
    refuse_utf16();
    if (!parse(text_)) fail_as_xml();
    return std::move(root_);
  }

private:
  [[noreturn]] void fail(std::size_t byte, const std::string& what, const std::string& hint = {}) {
    throw UserError(Exit::BadInput, lines_.at(byte), what, hint);
  }

  void refuse_utf16() {
    if (is_utf16(text_))
      fail(0, "this is not UTF-8 text", "write the preset in UTF-8 (this looks like UTF-16)");
  }

  void open(std::string_view name, const char** attributes) {
    auto element = std::make_unique<RawElement>();
    element->type = &type_of(name);
    element->place = lines_.at(here());
    read_attributes(*element, attributes);
    RawElement* opened = element.get();
    if (open_.empty())
      root_ = std::move(element);
    else
      open_.back()->children.push_back(std::move(element));
    open_.push_back(opened);
  }

  const ElementType& type_of(std::string_view name) {
    if (open_.empty()) {
      if (name == root_type_.name) return root_type_;
      fail(here(), fmt::format("a {} begins with <{}>, not with <{}>",
                               root_type_.name == "scene" ? "preset" : "file of " + root_type_.name,
                               root_type_.name, bare(name)));
    }
    const ElementType& parent = *open_.back()->type;
    if (const ElementType* type = child_type(parent, name)) return *type;
    std::vector<std::string> parents;
    collect_parents(root_type_, name, parents);
    std::string hint =
        parents.empty() ? said_of_missing(name) : fmt::format("it belongs in {}. ", listed(parents));
    hint += parent.children.empty()
                ? fmt::format("<{}> holds no elements", parent.name)
                : suggestion(name, child_names(parent), "in <" + parent.name + "> may stand");
    fail(here(), fmt::format("there is no <{}> in <{}>", bare(name), parent.name), hint);
  }

  static std::string bare(std::string_view name) {
    const std::string out = in_quotes(name);
    return out.substr(1, out.size() - 2);
  }

  // expat reports where a tag begins, not where its attributes are: their places are found in the raw tag,
  // which is well-formed at this point and lists them in the same order.
  void read_attributes(RawElement& element, const char** attributes) {
    std::size_t byte = here() + 1 + element.type->name.size();
    for (; *attributes; attributes += 2) {
      const std::string_view name = attributes[0];
      const std::size_t at = text_.find_first_not_of(blanks, byte);
      const std::size_t quote = text_.find_first_of("\"'", at);
      CHECK(at != std::string_view::npos && quote != std::string_view::npos && name_at(text_, at) == name);
      byte = text_.find(text_[quote], quote + 1) + 1;
      if (open_.empty() && names_schema(name)) continue;
      element.attributes.push_back({&attribute_type(element, name, at), attributes[1], lines_.at(quote + 1)});
    }
  }

  // These two attributes of the root tell editors where the schema is.
  static bool names_schema(std::string_view attribute) {
    return attribute == "xmlns:xsi" || attribute == "xsi:noNamespaceSchemaLocation";
  }

  const AttributeType& attribute_type(RawElement& raw, std::string_view name, std::size_t byte) {
    const ElementType& element = *raw.type;
    if (const AttributeType* type = element.find(name)) return *type;
    if (!element.further.empty()) {
      raw.further.push_back(std::make_unique<AttributeType>(text(std::string(name), element.further)));
      return *raw.further.back();
    }
    const std::string hint =
        said_of_missing(name) +
        (element.attributes.empty() ? fmt::format("<{}> has no attributes", element.name)
                                    : suggestion(name, attribute_names(element), "<" + element.name + "> has"));
    fail(byte, fmt::format("<{}> has no attribute {}", element.name, in_quotes(name)), hint);
  }

  void close() { open_.pop_back(); }

  void characters(std::string_view data) {
    const std::size_t first = data.find_first_not_of(blanks);
    if (first == std::string_view::npos) return;
    const std::size_t last = data.find_last_not_of(blanks);
    fail(here() + first,
         fmt::format("stray text {} in <{}>", in_quotes(data.substr(first, last - first + 1)),
                     open_.back()->type->name),
         "values are given as attributes, such as name=\"value\"");
  }

  void doctype() {
    fail(text_.rfind("<!DOCTYPE", here()), "a preset may have no DOCTYPE and no entities of its own",
         "take the DOCTYPE out");
  }

  void declaration(const char* encoding) {
    std::string name = encoding ? encoding : "UTF-8";
    for (char& c : name) c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    if (name == "UTF-8" || name == "US-ASCII") return;
    fail(here(), fmt::format("the encoding {} is not read", in_quotes(name)), "write the preset in UTF-8");
  }

  // Errors of expat, reworded where that helps.
  [[noreturn]] void fail_as_xml() {
    const XML_Error error = XML_GetErrorCode(parser_);
    const std::size_t byte = here();
    const unsigned char c = byte < text_.size() ? static_cast<unsigned char>(text_[byte]) : ' ';
    const std::string innermost =
        open_.empty() ? "" : fmt::format("<{}> of line {}", open_.back()->type->name, open_.back()->place.line);
    if (error == XML_ERROR_NO_MEMORY) throw std::bad_alloc();
    if (error == XML_ERROR_DUPLICATE_ATTRIBUTE)
      fail(byte, fmt::format("the attribute {} is given twice", in_quotes(name_at(text_, byte))));
    if (error == XML_ERROR_TAG_MISMATCH)
      fail(byte, fmt::format("</{}> where {} is to be closed", bare(name_at(text_, byte)), innermost));
    if (error == XML_ERROR_NO_ELEMENTS && open_.empty()) fail(byte, "there is nothing in this preset");
    if (error == XML_ERROR_NO_ELEMENTS || error == XML_ERROR_UNCLOSED_TOKEN)
      fail(byte, "this is not closed where the file ends",
           innermost.empty() ? ""
                             : fmt::format("{} is open as well; is the end of the file missing?", innermost));
    if (error == XML_ERROR_JUNK_AFTER_DOC_ELEMENT)
      fail(byte, fmt::format("after </{}> nothing may stand but comments", root_type_.name));
    if (error == XML_ERROR_UNDEFINED_ENTITY) fail_as_entity(byte);
    const std::string what = fmt::format("this is not XML: {}", XML_ErrorString(error));
    if (c >= 0x80 || c == 0) fail(byte, what, "a preset is a text in UTF-8");
    fail(byte, what, "values stand in quotes; in text, < is written &lt; and & is written &amp;");
  }

  // Within an attribute expat only reports where the tag begins.
  [[noreturn]] void fail_as_entity(std::size_t tag) {
    constexpr std::string_view known[] = {"&lt;", "&gt;", "&amp;", "&quot;", "&apos;", "&#"};
    const auto stands_at = [&](std::size_t byte) {
      return std::any_of(std::begin(known), std::end(known),
                         [&](std::string_view one) { return text_.substr(byte).starts_with(one); });
    };
    std::size_t byte = text_.find('&', tag);
    while (byte != std::string_view::npos && stands_at(byte)) byte = text_.find('&', byte + 1);
    if (byte == std::string_view::npos) byte = tag;
    const std::string_view name = text_.substr(byte, text_.find(';', byte) + 1 - byte);
    fail(byte, fmt::format("the entity {} is not known", in_quotes(name)),
         "there are &lt; &gt; &amp; &quot; &apos; and &#...;");
  }

  std::string_view text_;
  const ElementType& root_type_;
  Lines lines_;
  std::unique_ptr<RawElement> root_;
  std::vector<RawElement*> open_; // outermost first
};

} // namespace

std::unique_ptr<RawElement> read_raw_preset(std::string_view text, const std::string& file,
                                            const ElementType& root) {
  return Reader(text, file, root).read();
}

} // namespace rend
