// rend list: the presets there are.
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/console/json_or_null.h"
#include "render/console/json_text.h"
#include "render/console/terminal.h"
#include "render/facts/preset_list.h"
#include "render/help/folding.h"
#include "sim/base/printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>

namespace rend {
namespace {

struct ListOptions {
  std::string folder; // empty: that of rend's own presets
  bool thesis = false, json = false;
};

using Json = nlohmann::ordered_json;

Json json_of(const ListedPreset& one) {
  return {{"preset", one.file},
          {"thesis", one.thesis.empty() ? Json(nullptr) : Json(one.thesis)},
          {"about", one.about},
          {"seconds", json_or_null(one.seconds)},
          {"steps", json_or_null(one.steps)}};
}

// 7.9 before 7.17: runs of digits are compared as numbers.
bool comes_before(const std::string& a, const std::string& b) {
  std::size_t m = 0, n = 0;
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  while (m < a.size() && n < b.size()) {
    if (digit(a[m]) && digit(b[n])) {
      std::size_t i = m, j = n;
      while (i < a.size() && digit(a[i])) ++i;
      while (j < b.size() && digit(b[j])) ++j;
      const long x = std::stol(a.substr(m, std::min<std::size_t>(i - m, 9))),
                 y = std::stol(b.substr(n, std::min<std::size_t>(j - n, 9)));
      if (x != y) return x < y;
      m = i;
      n = j;
    } else if (a[m] != b[n]) {
      return a[m] < b[n];
    } else {
      ++m;
      ++n;
    }
  }
  return a.size() - m < b.size() - n;
}

// Where no preset is listed: why.
std::string none_in_words(const std::filesystem::path& folder, std::size_t all) {
  const std::string where = printable(folder.string());
  if (all == 0) return fmt::format("there are no presets in {}: files *.xml with a <scene>\n", where);
  return fmt::format(
      "no preset of {0} names a figure of the thesis (attribute thesis of <scene>); rend list {0} "
      "lists all {1}\n",
      where, all);
}

// "tear/moebius.xml   7.18   20 s   A Moebius band ..."; below each other where the terminal is narrow.
std::string line_of(const ListedPreset& one, std::size_t longest, std::size_t figures, std::size_t columns) {
  const std::string time = one.seconds ? seconds_in_words(*one.seconds) : "-";
  const std::string figure = one.thesis.empty() ? "-" : one.thesis;
  const std::size_t before = longest + 2 + figures + 2 + 12;
  const bool beside = columns >= before + 30;
  std::string out = beside
                        ? fmt::format("{:<{}}  {:<{}}  {:<12}", printable(one.file), longest, printable(figure),
                                      figures, time)
                        : fmt::format("{}\n  {}, {}\n  ", printable(one.file),
                                      one.thesis.empty() ? "no figure" : "figure " + printable(figure), time);
  const std::size_t indent = beside ? before : 2;
  const std::vector<std::string> lines = folded(printable(one.about), columns - indent);
  for (std::size_t n = 0; n < lines.size(); ++n)
    out += (n == 0 ? "" : "\n" + std::string(indent, ' ')) + lines[n];
  return out.substr(0, out.find_last_not_of(" \n") + 1) + "\n";
}

Exit list(const ListOptions& options) {
  const std::filesystem::path folder =
      options.folder.empty() ? folder_of_presets() : std::filesystem::path(options.folder);
  std::vector<ListedPreset> all = list_presets(folder);
  const std::size_t there = all.size();
  if (options.thesis) {
    std::erase_if(all, [](const ListedPreset& one) { return one.thesis.empty(); });
    std::stable_sort(all.begin(), all.end(), [](const ListedPreset& a, const ListedPreset& b) {
      return comes_before(a.thesis, b.thesis);
    });
  }
  if (options.json) {
    Json json = Json::array();
    for (const ListedPreset& one : all) json.push_back(json_of(one));
    print_result(text_of(json, 2) + "\n");
    return Exit::Done;
  }
  if (all.empty()) {
    print_result(none_in_words(folder, there));
    return Exit::Done;
  }
  const std::size_t columns = text_columns(stdout, 140);
  std::size_t longest = 0, figures = 1;
  for (const ListedPreset& one : all) {
    longest = std::max(longest, width(printable(one.file)));
    figures = std::max(figures, width(printable(one.thesis)));
  }
  std::string out;
  for (const ListedPreset& one : all) out += line_of(one, longest, figures, columns);
  const std::string closing = fmt::format(
      "{} preset{} in {}: file, figure or table of the thesis, processor time of rend run on one thread "
      "(measured by presets/measure), and what it shows.",
      all.size(), all.size() == 1 ? "" : "s", printable(folder.string()));
  out += "\n";
  for (const std::string& line : folded(closing, columns)) out += line + "\n";
  print_result(out);
  return Exit::Done;
}

std::function<Exit()> declare_list(const CommandLine& app) {
  auto options = std::make_shared<ListOptions>();
  app.add_option("folder", options->folder,
                 "folder of presets; default: presets in this folder, or those that rend was installed with")
      .type_name("DIR");
  app.add_flag("--thesis", options->thesis, "list only those that reproduce a figure of the thesis, by figure");
  app.add_flag("--json", options->json, "print the same as one JSON array on stdout");
  return [options] { return list(*options); };
}

} // namespace

Command list_command() {
  return {"list", "list presets: what each shows, its figure in the thesis, how long it takes", declare_list};
}

} // namespace rend
