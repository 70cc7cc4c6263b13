#include "sim/preset/override.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <optional>
#include <utility>
#include <vector>

namespace rend {
namespace {

struct Part {
  std::string name;
  std::optional<std::string> which; // the text in the brackets
};

std::string shown(const RawElement& element) {
  for (const RawAttribute& attribute : element.attributes) {
    if (attribute.type->name == "name") return attribute.text;
  }
  return "(no name)";
}

// The path of one --set, followed down the tree.
class Path {
public:
  explicit Path(const Override& override)
      : value_(override.value), place_{"--set " + override.path + "=" + override.value, 0, 0},
        parts_(split(override.path)) {}

  void apply(RawElement& root) const {
    RawElement* element = &root;
    for (std::size_t i = first_below(*root.type); i + 1 < parts_.size(); ++i)
      element = &step(*element, parts_[i]);
    element->set(attribute(*element->type, parts_.back()), value_, place_);
  }

  // Checked against the table only.
  const ElementType& element(const ElementType& root) const {
    const ElementType* element = &root;
    for (std::size_t i = first_below(root); i + 1 < parts_.size(); ++i)
      element = child_type(*element, parts_[i].name).type;
    return *element;
  }
  const AttributeType& attribute(const ElementType& element) const { return attribute(element, parts_.back()); }
  void check(const ElementType& root) const {
    const ElementType& type = element(root);
    PresetNode(type, place_).set(attribute(type), value_, place_);
  }

private:
  std::size_t first_below(const ElementType& root) const { // the root's own name may come first
    return parts_.size() > 1 && parts_[0].name == root.name && !parts_[0].which ? 1 : 0;
  }

  [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const {
    throw UserError(Exit::Usage, place_, what, hint);
  }

  // Dots inside brackets belong to a name.
  std::vector<Part> split(std::string_view path) const {
    std::vector<Part> out;
    while (true) {
      Part part;
      const std::size_t end = std::min(path.find_first_of(".[]"), path.size());
      part.name = path.substr(0, end);
      if (part.name.empty())
        fail("the path has an empty name", "a path is such as body[left].tear[2].threshold");
      path.remove_prefix(end);
      if (path.starts_with('[')) {
        const std::size_t close = path.find(']');
        if (close == std::string_view::npos) fail("a bracket is not closed in the path");
        part.which = path.substr(1, close - 1);
        if (part.which->empty()) fail("nothing stands in the brackets", "put a name there, or a number from 1");
        path.remove_prefix(close + 1);
      }
      out.push_back(std::move(part));
      if (path.empty()) return out;
      if (!path.starts_with('.')) fail(fmt::format("'.' is expected before {}", in_quotes(path)));
      path.remove_prefix(1);
    }
  }

  RawElement& step(RawElement& parent, const Part& part) const {
    const ChildType& child = child_type(*parent.type, part.name);
    const std::vector<RawElement*> present = parent.all(part.name);
    if (part.which) return chosen(parent, part, present, child);
    if (present.size() == 1) return *present[0];
    if (present.empty()) return made(parent, child);
    std::vector<std::string> choices;
    for (std::size_t i = 0; i < present.size(); ++i)
      choices.push_back(fmt::format("{} {}", i + 1, shown(*present[i])));
    fail(fmt::format("there are {} <{}> in <{}>", present.size(), part.name, parent.type->name),
         fmt::format("say which, as {}[1] or by its name: {}", part.name, listed(choices)));
  }

  const ChildType& child_type(const ElementType& parent, const std::string& name) const {
    std::vector<std::string> names;
    for (const ChildType& child : parent.children) {
      if (child.type->name == name) return child;
      names.push_back(child.type->name);
    }
    if (parent.find(name)) fail(fmt::format("{} is an attribute of <{}>, not an element", name, parent.name));
    fail(fmt::format("there is no element {} in <{}>", in_quotes(name), parent.name),
         names.empty() ? fmt::format("<{}> holds no elements", parent.name)
                       : suggestion(name, names, fmt::format("in <{}> may stand", parent.name)));
  }

  RawElement& chosen(RawElement& parent, const Part& part, const std::vector<RawElement*>& present,
                     const ChildType& child) const {
    const std::string& which = *part.which;
    std::vector<RawElement*> named;
    std::vector<std::string> names;
    for (RawElement* element : present) {
      const RawAttribute* name = element->find("name");
      if (name) names.push_back(name->text);
      if (name && name->text == which) named.push_back(element);
    }
    if (which.find_first_not_of("0123456789") == std::string::npos) {
      std::size_t number = 0;
      const auto read = std::from_chars(which.data(), which.data() + which.size(), number);
      if (read.ec == std::errc() && number >= 1 && number <= present.size()) return *present[number - 1];
      if (present.empty() && number == 1) return made(parent, child);
    }
    if (named.size() == 1) return *named[0];
    if (named.size() > 1)
      fail(fmt::format("{} <{}> are called {}", named.size(), part.name, in_quotes(which)),
           "say which by its number");
    fail(fmt::format("there is no {}[{}] in <{}>, which has {} <{}>", part.name, which, parent.type->name,
                     present.size(), part.name),
         suggestion(which, names, "there are"));
  }

  RawElement& made(RawElement& parent, const ChildType& child) const {
    if (child.at_most != 1)
      fail(fmt::format("there is no <{}> in this <{}>", child.type->name, parent.type->name),
           "--set can make an element only where there can be no more than one");
    auto element = std::make_unique<RawElement>();
    element->type = child.type;
    element->place = place_;
    parent.children.push_back(std::move(element));
    return *parent.children.back();
  }

  const AttributeType& attribute(const ElementType& element, const Part& part) const {
    std::vector<std::string> names;
    for (const AttributeType& one : element.attributes) names.push_back(one.name);
    const auto is_it = [&](const ChildType& child) { return child.type->name == part.name; };
    if (std::any_of(element.children.begin(), element.children.end(), is_it))
      fail(fmt::format("<{}> is an element: the path must end with an attribute of it", part.name));
    if (part.which)
      fail(fmt::format("{} is the last part and so an attribute, which takes no brackets", part.name));
    if (const AttributeType* type = element.find(part.name)) return *type;
    fail(fmt::format("<{}> has no attribute {}", element.name, in_quotes(part.name)),
         names.empty() ? fmt::format("<{}> has no attributes", element.name)
                       : suggestion(part.name, names, fmt::format("<{}> has", element.name)));
  }

  const std::string& value_;
  Place place_; // the words of the command line
  std::vector<Part> parts_;
};

} // namespace

Override parse_override(std::string_view text) {
  bool inside = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '[') inside = true;
    if (text[i] == ']') inside = false;
    if (text[i] == '=' && !inside) return {std::string(text.substr(0, i)), std::string(text.substr(i + 1))};
  }
  throw UserError(Exit::Usage, {"--set " + std::string(text), 0, 0}, "there is no '=' in it",
                  "write --set PATH=VALUE, such as --set time.step=1e-4");
}

void apply_overrides(RawElement& root, std::span<const Override> overrides) {
  for (const Override& one : overrides) Path(one).apply(root);
}

const AttributeType& overridden(const ElementType& root, const Override& one) {
  const Path path(one);
  return path.attribute(path.element(root));
}

void check_override(const ElementType& root, const Override& one) {
  Path(one).check(root);
}

} // namespace rend
