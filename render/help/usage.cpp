#include "render/help/usage.h"

#include "sim/base/parameters.h"

#include <functional>
#include <map>
#include <set>

namespace rend {
namespace {

// Visits every element at each of its positions, with its path without the root's name.
void visit(const ElementType& type, const std::string& path,
           const std::function<void(const ElementType&, const std::string&)>& take) {
  take(type, path);
  for (const ChildType& child : type.children)
    visit(*child.type, path.empty() ? child.type->name : path + "." + child.type->name, take);
}

} // namespace

std::string choices(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : "|") + name;
  return out;
}

std::vector<SettableAttribute> settable_attributes(const ElementType& root) {
  std::map<std::string, SettableAttribute> sorted;
  visit(root, "", [&](const ElementType& type, const std::string& path) {
    for (const AttributeType& attribute : type.attributes) {
      const std::string whole = path.empty() ? attribute.name : path + "." + attribute.name;
      const std::vector<std::string> flag{"yes", "no"};
      sorted[whole] = {whole, attribute.kind == AttributeKind::Flag ? flag : attribute.words};
    }
  });
  std::vector<SettableAttribute> out;
  for (const auto& [path, set] : sorted) out.push_back(set);
  return out;
}

std::vector<std::string> element_names(const ElementType& root) {
  std::set<std::string> names;
  visit(root, "", [&](const ElementType& type, const std::string& path) {
    names.insert(type.name);
    if (!path.empty()) names.insert(path);
  });
  return {names.begin(), names.end()};
}

} // namespace rend
