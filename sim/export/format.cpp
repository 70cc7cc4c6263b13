#include "sim/export/format.h"

#include "sim/base/printable.h"

#include <algorithm>

namespace rend {

const std::vector<ExportFormat>& all_export_formats() {
  static const std::vector<ExportFormat> all{vtu_format(), ply_format(), obj_format()};
  return all;
}

const ExportFormat* find_export_format(const std::string& name) {
  const auto& all = all_export_formats();
  const auto at = std::find_if(all.begin(), all.end(), [&](const ExportFormat& f) { return f.name == name; });
  return at == all.end() ? nullptr : &*at;
}

std::vector<std::string> export_format_names() {
  std::vector<std::string> names;
  for (const ExportFormat& format : all_export_formats()) names.push_back(format.name);
  return names;
}

std::string one_word(const std::string& name) {
  std::string word = printable(name, "_");
  std::replace_if(
      word.begin(), word.end(), [](char c) { return c == ' ' || c == '\\'; }, '_');
  return word.empty() ? "_" : word;
}

} // namespace rend
