#include "render/help/usage.h"

#include "sim/base/parameters.h"

#include <CLI/CLI.hpp>

#include <functional>
#include <map>
#include <set>

namespace rend {
namespace {

OptionUsage option_usage(const CLI::Option& option) {
  OptionUsage out;
  for (const std::string& name : option.get_snames()) out.names.emplace_back("-" + name);
  for (const std::string& name : option.get_lnames()) out.names.emplace_back("--" + name);
  if (out.names.empty()) out.names.push_back(option.get_name(true));
  const std::string type = option.get_type_name(); // "N:INT in [1 - 256]" for a validated number
  if (option.get_items_expected_max() > 0) out.value = type.substr(0, type.find(':'));
  out.what = option.get_description();
  out.fallback = option.get_default_str();
  out.required = option.get_required() || option.get_group() == required_by_command;
  out.repeated = option.get_expected_max() > 1;
  return out;
}

// Visits every element at each of its positions, with its path without the root's name.
void visit(const ElementType& type, const std::string& path,
           const std::function<void(const ElementType&, const std::string&)>& take) {
  take(type, path);
  for (const ChildType& child : type.children)
    visit(*child.type, path.empty() ? child.type->name : path + "." + child.type->name, take);
}

} // namespace

CommandUsage usage_of(const CLI::App& app) {
  CommandUsage out{app.get_name(), app.get_description(), app.get_footer(), {}, {}, {}};
  if (app.get_parent() != nullptr && app.get_parent()->get_footer() == out.footer) out.footer.clear();
  for (const CLI::Option* option : app.get_options())
    (option->get_positional() ? out.positionals : out.options).push_back(option_usage(*option));
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    out.commands.push_back(usage_of(*command));
  return out;
}

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
