#include "render/help/schema.h"

#include "render/help/folding.h"
#include "render/help/table.h"
#include "sim/base/check.h"
#include "sim/base/markup.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

namespace rend {
namespace {

std::string escaped(std::string_view text) {
  return in_markup(text, MarkupQuotes::Double);
}

// Appends lines to the schema, indented by the depth of open elements.
class Schema {
public:
  explicit Schema(const ElementType& root) : entries_(table_entries(root)) {
    out_ = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
           "<!-- Made from the parameter table, which is where to change it. Too few or too many elements of a "
           "kind\n"
           "     pass here where others may be repeated; the reader refuses them. -->\n";
    open("xs:schema xmlns:xs=\"http://www.w3.org/2001/XMLSchema\"");
    line(fmt::format(R"(<xs:element name="{0}" type="{0}"/>)", escaped(root.name)));
    number_type();
    for (const TableEntry& entry : entries_) element_type(entry);
    close("xs:schema");
  }

  std::string take() { return std::move(out_); }

private:
  void line(const std::string& text) { out_ += std::string(depth_, ' ') + text + '\n'; }
  void open(const std::string& tag) {
    line("<" + tag + ">");
    depth_ += 2;
  }
  void close(const std::string& tag) {
    depth_ -= 2;
    line("</" + tag + ">");
  }
  void facet(std::string_view name, std::string_view value) {
    line(fmt::format(R"(<xs:{} value="{}"/>)", name, escaped(value)));
  }
  void documentation(std::string_view text) {
    if (text.empty()) return;
    line(fmt::format("<xs:annotation><xs:documentation>{}</xs:documentation></xs:annotation>",
                     escaped(on_one_line(text))));
  }

  // Excludes INF and NaN, which xs:double allows and presets do not.
  void number_type() {
    const AttributeType free;
    open(R"(xs:simpleType name="number")");
    open(R"(xs:restriction base="xs:double")");
    facet("pattern", R"([\-+]?([0-9]+(\.[0-9]*)?|\.[0-9]+)([eE][\-+]?[0-9]+)?)");
    facet("minInclusive", fmt::format("{}", free.low));
    facet("maxInclusive", fmt::format("{}", free.high));
    close("xs:restriction");
    close("xs:simpleType");
  }

  const std::string& type_name(const ElementType& type) const {
    const auto found = std::find_if(entries_.begin(), entries_.end(),
                                    [&](const TableEntry& one) { return one.type == &type; });
    CHECK(found != entries_.end());
    return found->path();
  }

  void element_type(const TableEntry& entry) {
    open(fmt::format(R"(xs:complexType name="{}")", escaped(entry.path())));
    documentation(entry.type->what);
    children(*entry.type);
    for (const AttributeType& attribute : entry.type->attributes) attribute_type(attribute);
    if (!entry.type->further.empty()) line(R"(<xs:anyAttribute processContents="skip"/>)");
    close("xs:complexType");
  }

  void children(const ElementType& type) {
    if (type.children.empty()) return;
    int least = 0, most = 0;
    bool repeated = false, unbounded = false;
    for (const ChildType& child : type.children) {
      least += child.at_least;
      most += child.at_most;
      repeated = repeated || child.at_most != 1;
      unbounded = unbounded || child.at_most < 0;
    }
    const std::string upper = unbounded ? "unbounded" : fmt::format("{}", most);
    open(repeated ? fmt::format(R"(xs:choice minOccurs="{}" maxOccurs="{}")", least, upper) : "xs:all");
    for (const ChildType& child : type.children) {
      const std::string occurs = repeated ? "" : fmt::format(R"( minOccurs="{}")", child.at_least);
      line(fmt::format(R"(<xs:element name="{}" type="{}"{}/>)", escaped(child.type->name),
                       escaped(type_name(*child.type)), occurs));
    }
    close(repeated ? "xs:choice" : "xs:all");
  }

  void attribute_type(const AttributeType& attribute) {
    std::string tag = fmt::format(R"(xs:attribute name="{}")", escaped(attribute.name));
    if (attribute.required)
      tag += R"( use="required")";
    else if (attribute.fallback)
      tag += fmt::format(R"( default="{}")", escaped(*attribute.fallback));
    open(tag);
    documentation(attribute.unit.empty() ? attribute.what : attribute.what + " [" + attribute.unit + "]");
    value_type(attribute);
    close("xs:attribute");
  }

  void value_type(const AttributeType& attribute) {
    open("xs:simpleType");
    switch (attribute.kind) {
    case AttributeKind::Number:
    case AttributeKind::Integer:
      one_number(attribute);
      break;
    case AttributeKind::Numbers:
    case AttributeKind::Integers:
      list(attribute, attribute.count);
      break;
    case AttributeKind::Words:
      list(attribute, 0);
      break;
    case AttributeKind::Word:
      enumeration(attribute.words);
      break;
    case AttributeKind::Flag:
      enumeration({"yes", "no"});
      break;
    case AttributeKind::Text:
      line(R"(<xs:restriction base="xs:string"/>)");
      break;
    case AttributeKind::NumberOrWord:
      open("xs:union");
      simple([&] { enumeration(attribute.words); });
      simple([&] { one_number(attribute); });
      close("xs:union");
      break;
    case AttributeKind::NumberOrExpression: // whose words the schema does not know
      line(R"(<xs:restriction base="xs:string"/>)");
      break;
    }
    close("xs:simpleType");
  }

  template <class Inside> void simple(Inside inside) {
    open("xs:simpleType");
    inside();
    close("xs:simpleType");
  }

  void one_number(const AttributeType& attribute) {
    const AttributeType free;
    const bool whole = attribute.kind == AttributeKind::Integer || attribute.kind == AttributeKind::Integers;
    const double lowest = whole ? INT_MIN : free.low, highest = whole ? INT_MAX : free.high;
    // The bound of an integer must be an integer, as a facet must be of its type.
    const double low = whole && attribute.open_low ? std::floor(attribute.low) : attribute.low;
    open(fmt::format(R"(xs:restriction base="{}")", whole ? "xs:int" : "number"));
    if (low > lowest)
      facet(attribute.open_low ? "minExclusive" : "minInclusive",
            fmt::format("{}", whole ? std::ceil(low) : low));
    if (attribute.high < highest)
      facet("maxInclusive", fmt::format("{}", whole ? std::floor(attribute.high) : attribute.high));
    close("xs:restriction");
  }

  // count = 0: one or more.
  void list(const AttributeType& attribute, int count) {
    open("xs:restriction");
    simple([&] {
      open("xs:list");
      simple([&] {
        if (attribute.kind == AttributeKind::Words)
          enumeration(attribute.names ? std::vector<std::string>() : attribute.words);
        else
          one_number(attribute);
      });
      close("xs:list");
    });
    facet(count > 0 ? "length" : "minLength", fmt::format("{}", count > 0 ? count : 1));
    close("xs:restriction");
  }

  void enumeration(const std::vector<std::string>& words) {
    open(R"(xs:restriction base="xs:token")");
    for (const std::string& word : words) facet("enumeration", word);
    close("xs:restriction");
  }

  std::vector<TableEntry> entries_;
  std::string out_;
  std::size_t depth_ = 0;
};

} // namespace

std::string schema(const ElementType& root) {
  return Schema(root).take();
}

} // namespace rend
