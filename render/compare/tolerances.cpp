#include "render/compare/tolerances.h"

#include "sim/preset/paths.h"
#include "sim/preset/preset_reader.h"

#include <fmt/format.h>
#include <fnmatch.h>

#include <algorithm>

namespace rend {
namespace {

std::vector<AttributeType> settings() {
  std::vector<AttributeType> out{
      number("threshold", "levels",
             "for share and window: a pixel counts if it differs by more than this; default 0")
          .at_least(0)
          .at_most(255),
      integer("window-size", "for window: the side of the window [pixels]; default 16")
          .at_least(1)
          .at_most(4096)};
  out.push_back(
      word("antialiased", {"count", "ignore"},
           "ignore: pixels that differ only because an edge is smoothed differently are left out (the "
           "rule of pixelmatch; it may also leave out a crack one pixel wide); default count"));
  for (const Limit& limit : all_limits())
    out.push_back(number_or(limit.name, {"any"}, limit.unit,
                            limit.what + (limit.kind == LimitKind::AtLeast ? ", at least" : ", at most"))
                      .at_least(limit.low)
                      .at_most(limit.high));
  out.push_back(text("mask", "a PNG of the pictures' size, in this file's folder or below: white pixels are "
                             "compared, black ones are not"));
  return out;
}

const ElementType& default_type() {
  static const ElementType type{"default", "limits for every picture", settings(), {}};
  return type;
}

const ElementType& case_type() {
  static const ElementType type = [] {
    std::vector<AttributeType> attributes = settings();
    attributes.insert(
        attributes.begin(),
        text("name", "which pictures: the path within the folders; * and ? are wildcards").is_required());
    return ElementType{
        "case", "limits for the pictures of a name; later cases replace earlier ones", attributes, {}};
  }();
  return type;
}

bool fits(const PresetNode& one, const std::string& name) {
  return one.name() == "default" || fnmatch(one.text("name").c_str(), name.c_str(), 0) == 0;
}

void apply(const PresetNode& node, const std::filesystem::path& folder, CompareOptions& options) {
  if (node.given("threshold")) options.tolerance.threshold = node.number("threshold");
  if (node.given("window-size")) options.tolerance.window_side = node.integer("window-size");
  if (node.given("antialiased")) options.tolerance.leave_out_smoothed = node.text("antialiased") == "ignore";
  if (node.given("mask")) options.mask = node.text("mask").empty() ? "" : folder / node.text("mask");
  for (const Limit& limit : all_limits()) {
    if (!node.given(limit.name)) continue;
    if (node.is_word(limit.name)) {
      options.tolerance.limits.erase(limit.name);
      options.tolerance.lifted = true;
    } else
      options.tolerance.limits[limit.name] = node.number(limit.name);
  }
}

void check_mask(const PresetNode& node, const std::filesystem::path& folder) {
  if (!node.given("mask") || node.text("mask").empty() || stays_below(folder, node.text("mask"))) return;
  node.fail("mask", in_quotes(node.text("mask")) + " is outside of the tolerances' folder",
            "put the mask beside the tolerances, or allow it with --allow-path");
}

// Whether a node sets `setting` ("threshold", ...) without effect: no picture that the node applies to has one
// of `limits`.
bool has_no_effect(const Tolerances& all, const PresetNode& node, const char* setting,
                   std::initializer_list<const char*> limits, const std::vector<std::string>& names) {
  if (!node.given(setting)) return false;
  bool fits_one = false;
  for (const std::string& name : names) {
    if (!fits(node, name)) continue;
    fits_one = true;
    const Tolerance tolerance = all.of(name).tolerance;
    for (const char* limit : limits)
      if (tolerance.limits.contains(limit)) return false;
  }
  return fits_one;
}

// A --limit of the command line, as a <default/> element.
std::unique_ptr<PresetNode> node_of(const std::string& name, const std::string& value) {
  auto node = std::make_unique<PresetNode>(default_type(), Place{});
  const AttributeType* attribute = default_type().find(name);
  try {
    if (attribute && name != "mask") node->set(*attribute, value, {});
  } catch (const UserError& error) {
    throw UserError(Exit::Usage, {}, std::string("--limit: ") + error.what(), error.hint);
  }
  if (attribute && name != "mask") return node;
  std::vector<std::string> names;
  for (const AttributeType& one : default_type().attributes)
    if (one.name != "mask") names.push_back(one.name);
  throw UserError(Exit::Usage, {}, "--limit: there is no limit " + in_quotes(name),
                  suggestion(name, names, "there are"));
}

} // namespace

const ElementType& tolerances_type() {
  static const ElementType type{
      "tolerances",
      "the differences that are allowed between pictures; without a limit they must be equal",
      {word("version", {"1"}, "version of this format").otherwise("1")},
      {{&default_type(), 0, 1}, {&case_type(), 0, -1}}};
  return type;
}

Tolerances::Tolerances(const std::filesystem::path& file, bool allow_path)
    : file_(read_preset(file, tolerances_type())), folder_(file.parent_path()) {
  if (allow_path) return;
  for (const auto& child : file_->children()) check_mask(*child, folder_);
}

void Tolerances::add(const std::string& setting) {
  const std::size_t at = setting.find('=');
  if (at == std::string::npos)
    throw UserError(Exit::Usage, {}, "--limit: " + in_quotes(setting) + " has no '='",
                    "write NAME=VALUE, such as --limit share=0.001");
  settings_.push_back({setting.substr(0, at), setting.substr(at + 1)});
  node_of(settings_.back().first, settings_.back().second);
}

CompareOptions Tolerances::of(const std::string& name) const {
  CompareOptions options;
  if (file_)
    for (const auto& child : file_->children())
      if (fits(*child, name)) apply(*child, folder_, options);
  for (const auto& [what, value] : settings_) apply(*node_of(what, value), {}, options);
  if (!mask_.empty()) options.mask = mask_;
  return options;
}

std::vector<std::string> Tolerances::remarks(const std::vector<std::string>& names) const {
  std::vector<std::string> out;
  for (const std::string& pattern : unused(names))
    out.emplace_back("the tolerances have a case " + in_quotes(pattern) + ", but no picture has that name");
  const auto look_at = [&](const PresetNode& node, const std::string& where) {
    if (has_no_effect(*this, node, "threshold", {"share", "window"}, names))
      out.push_back(where + " gives a threshold, which has no effect without a limit on share or window");
    if (has_no_effect(*this, node, "window-size", {"window"}, names))
      out.push_back(where + " gives a window-size, which has no effect without a limit on window");
  };
  if (file_)
    for (const auto& child : file_->children()) look_at(*child, child->place().text());
  for (const auto& [what, value] : settings_) look_at(*node_of(what, value), "--limit");
  return out;
}

std::vector<std::string> Tolerances::unused(const std::vector<std::string>& names) const {
  std::vector<std::string> out;
  if (!file_) return out;
  for (const PresetNode* one : file_->all("case")) {
    const auto used = [&](const std::string& name) { return fits(*one, name); };
    if (std::none_of(names.begin(), names.end(), used)) out.push_back(one->text("name"));
  }
  return out;
}

} // namespace rend
