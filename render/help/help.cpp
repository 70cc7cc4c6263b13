#include "render/help/help.h"

#include "render/help/folding.h"
#include "render/help/table.h"

#include <algorithm>
#include <fmt/format.h>
#include <set>
#include <string_view>

namespace rend {
namespace {

struct Style {
  bool colour;
  std::size_t columns;
  std::string strong(std::string_view text) const { return wrap("\033[1m", text); }
  std::string faint(std::string_view text) const { return wrap("\033[2m", text); }

private:
  std::string wrap(std::string_view code, std::string_view text) const {
    return colour ? fmt::format("{}{}\033[0m", code, text) : std::string(text);
  }
};

std::string multiplicity(int at_least, int at_most) {
  if (at_least == 1 && at_most == 1) return "exactly one";
  if (at_least == 0 && at_most == 1) return "at most one";
  if (at_least == 0 && at_most < 0) return "any number";
  if (at_least == 1 && at_most < 0) return "one or more";
  if (at_most < 0) return fmt::format("{} or more", at_least);
  return at_least == at_most ? fmt::format("exactly {}", at_least) : fmt::format("{} to {}", at_least, at_most);
}

std::string value_text(const AttributeType& attribute) {
  const std::string out = expected(attribute);
  if (attribute.required) return out + "; required";
  if (!attribute.fallback) return out + "; optional";
  return out + (attribute.fallback->empty() ? "; default empty" : "; default " + *attribute.fallback);
}

// "    name  " and `lines` beside it, or below it where the page is narrow.
void print_item(const std::string& name, std::size_t longest, const std::string& what, const std::string& value,
                const Style& style, std::string& out) {
  const bool beside = style.columns >= longest + 36;
  const std::size_t indent = beside ? 4 + longest + 2 : 6;
  out += "    " + style.strong(name) + (beside ? std::string(longest + 2 - width(name), ' ') : "\n");
  std::string gap = beside ? "" : std::string(indent, ' ');
  for (const std::string& line : folded(what, style.columns - indent)) {
    out += gap + line + '\n';
    gap.assign(indent, ' ');
  }
  if (value.empty()) return;
  for (const std::string& line : folded(value, style.columns - indent))
    out += std::string(indent, ' ') + style.faint(line) + '\n';
}

// A row per attribute: name, description and type, aligned after the column of names.
void print_attributes(const ElementType& type, const Style& style, std::string& out) {
  std::size_t longest = 8;
  for (const AttributeType& attribute : type.attributes) longest = std::max(longest, width(attribute.name));
  for (const AttributeType& attribute : type.attributes)
    print_item(attribute.name, longest, attribute.what, value_text(attribute), style, out);
}

void print_entry(const TableEntry& entry, const Style& style, std::string& out) {
  const bool is_root = entry.path().find('.') == std::string::npos;
  for (const TablePlace& place : entry.places) {
    const std::string count = is_root ? "the root" : multiplicity(place.at_least, place.at_most);
    out += style.strong(place.path) + style.faint("  (" + count + ")") + '\n';
  }
  for (const std::string& line : folded(entry.type->what, style.columns - 2)) out += "  " + line + '\n';
  if (!entry.type->attributes.empty()) {
    out += "  Attributes:\n";
    print_attributes(*entry.type, style, out);
  }
  if (entry.type->children.empty()) return;
  std::size_t longest = 8;
  for (const ChildType& child : entry.type->children) longest = std::max(longest, width(child.type->name));
  out += "  Elements:\n";
  for (const ChildType& child : entry.type->children)
    print_item(child.type->name, longest,
               fmt::format("{} ({})", child.type->what, multiplicity(child.at_least, child.at_most)), {}, style,
               out);
}

// Whether `asked` is the entry's name or the end of one of its paths: key, sphere.key or world.sphere.key.
bool matches(const TableEntry& entry, const std::string& asked) {
  if (entry.type->name == asked) return true;
  return std::any_of(entry.places.begin(), entry.places.end(), [&](const TablePlace& place) {
    return place.path == asked || place.path.ends_with("." + asked);
  });
}

} // namespace

std::string introduction(const ElementType& root) {
  return fmt::format(
      "A preset is an XML file with one <{0}>. Elements may be in any order. Units are SI; vectors are numbers "
      "separated by spaces. On the command line, --set PATH=VALUE replaces an attribute: write the path as "
      "below, without \"{0}.\", and end it with the attribute's name, as in --set time.step=1e-4.",
      root.name);
}

std::string help_preset(const ElementType& root, const std::optional<std::string>& element, bool colour,
                        std::size_t columns) {
  return help_elements(root, introduction(root), element, colour, columns);
}

std::string help_elements(const ElementType& root, const std::string& opening,
                          const std::optional<std::string>& element, bool colour, std::size_t columns) {
  const Style style{colour, columns};
  const std::vector<TableEntry> entries = table_entries(root);
  std::string out;
  if (!element) {
    for (const std::string& line : folded(opening, columns)) out += line + '\n';
  }
  bool found = false;
  for (const TableEntry& entry : entries) {
    if (element && !matches(entry, *element)) continue;
    if (!out.empty()) out += '\n';
    print_entry(entry, style, out);
    found = true;
  }
  if (found) return out;
  std::set<std::string> names;
  for (const TableEntry& entry : entries) names.insert(entry.type->name);
  const std::vector<std::string> list(names.begin(), names.end());
  throw UserError(Exit::Usage, {},
                  fmt::format("{} has no element {}", root.name == "scene" ? "a preset" : "<" + root.name + ">",
                              in_quotes(*element)),
                  suggestion(*element, list, "there are"));
}

} // namespace rend
