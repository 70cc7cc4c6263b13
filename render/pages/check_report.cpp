#include "render/pages/check_report.h"

#include "render/console/console.h"
#include "render/report/machine.h"
#include "render/report/page.h"
#include "render/studies/check_run.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>

namespace rend {

CheckCounts count(const std::vector<CheckChapter>& chapters) {
  CheckCounts counts;
  for (const CheckChapter& chapter : chapters)
    for (const CheckResult& result : chapter.results) switch (result.finding.verdict) {
      case Verdict::Ok:
        ++counts.ok;
        break;
      case Verdict::Refused:
        ++counts.refused;
        break;
      case Verdict::Limit:
        ++counts.limits;
        break;
      case Verdict::Failed:
        ++counts.failed;
        break;
      }
  return counts;
}

namespace {

using Json = nlohmann::ordered_json;
using namespace html;

// JSON has no numbers for infinity and NaN.
Json number_or_word(double value) {
  if (std::isfinite(value)) return value;
  return in_digits(value);
}

Json json_of(const CheckCase& which, const CheckResult& result) {
  Json measures = Json::array();
  for (const Measure& m : result.finding.measures) {
    Json one{{"what", m.what}, {"got", number_or_word(m.got)}, {"holds", m.holds()}};
    if (std::isfinite(m.low)) one["low"] = m.low;
    if (std::isfinite(m.high)) one["high"] = m.high;
    measures.push_back(std::move(one));
  }
  return {{"name", which.name},
          {"expectation", which.expectation},
          {"verdict", name_of(result.finding.verdict)},
          {"what", result.finding.what},
          {"why", result.finding.why},
          {"measures", measures},
          {"seconds", result.seconds}};
}

Tone tone_of(Verdict verdict) {
  return verdict == Verdict::Ok        ? Tone::Good
         : verdict == Verdict::Refused ? Tone::Note
         : verdict == Verdict::Limit   ? Tone::Limit
                                       : Tone::Bad;
}

std::string bounds_of(const Measure& m) {
  const bool low = std::isfinite(m.low), high = std::isfinite(m.high);
  if (low && high) {
    const double middle = 0.5 * (m.low + m.high), half = 0.5 * (m.high - m.low);
    if (half < 1e-2 * std::abs(middle)) return fmt::format("{:.9g} ± {:.2g}", middle, half);
    return fmt::format("{:.6g} to {:.6g}", m.low, m.high);
  }
  return low ? fmt::format("at least {:.6g}", m.low) : fmt::format("at most {:.6g}", m.high);
}

Html measures_of(const Finding& finding) {
  Html out;
  for (const Measure& m : finding.measures) {
    if (!out.text.empty()) out += {"<br/>"};
    out += escaped(m.what + ": ") + (m.holds() ? escaped(in_digits(m.got, 9)) : strong(in_digits(m.got, 9))) +
           muted(" (" + bounds_of(m) + ")");
  }
  return out;
}

Html happened(const Finding& finding) {
  Html out = measures_of(finding);
  for (const std::string& line : {finding.what, finding.why}) {
    if (line.empty()) continue;
    if (!out.text.empty()) out += {"<br/>"};
    out += &line == &finding.why ? muted(line) : escaped(line);
  }
  return out;
}

// A case's name without that of its family.
std::string short_name(const CheckChapter& chapter, const CheckCase& which) {
  const std::string front = chapter.family.name + "/";
  return which.name.starts_with(front) ? which.name.substr(front.size()) : which.name;
}

class Report {
public:
  explicit Report(const std::vector<CheckChapter>& chapters) : chapters_(chapters) {}

  Html contents() const;
  Html picked(Verdict verdict, const std::string& title, const std::string& about) const;
  Html chapter(const CheckChapter& chapter) const;

private:
  static std::string mark(const CheckCase& which) { return file_name(which.name); }
  Html matrix(const CheckChapter& chapter) const;
  Html cases(const CheckChapter& chapter) const;
  std::vector<html::TableCell> row(const CheckChapter& chapter, std::size_t n, const std::string& name) const;

  const std::vector<CheckChapter>& chapters_;
};

const std::vector<html::TableColumn> case_columns{
    {"case"}, {"verdict"}, {"expected"}, {"what happened"}, number_column("s")};

std::vector<html::TableCell> Report::row(const CheckChapter& chapter, std::size_t n,
                                         const std::string& name) const {
  const CheckCase& which = chapter.cases[n];
  const CheckResult& result = chapter.results[n];
  const Html title = link(fmt::format("cases/{}.xml", file_name(which.name)), name);
  return {{{fmt::format("<span id=\"{}\"></span>{}", mark(which), title.text)}, name},
          {badge(tone_of(result.finding.verdict), name_of(result.finding.verdict)), {}},
          {escaped(which.expectation), {}},
          {happened(result.finding), {}},
          {escaped(fmt::format("{:.2f}", result.seconds)), fmt::format("{}", result.seconds)}};
}

Html Report::contents() const {
  Table t{.columns = {{"family"},
                      number_column("cases"),
                      number_column("ok"),
                      number_column("refused"),
                      number_column("known limits"),
                      number_column("failed"),
                      number_column("s")},
          .rows = {}};
  const auto number = [](std::size_t n) {
    return html::TableCell{n == 0 ? muted("-") : escaped(std::to_string(n)), {}};
  };
  for (const CheckChapter& chapter : chapters_) {
    const CheckCounts counts = count({chapter});
    double seconds = 0;
    for (const CheckResult& result : chapter.results) seconds += result.seconds;
    t.rows.push_back({{link(fmt::format("#{}", chapter.family.name), chapter.family.title), {}},
                      number(counts.all()),
                      number(counts.ok),
                      number(counts.refused),
                      number(counts.limits),
                      {counts.failed == 0 ? muted("-") : badge(Tone::Bad, std::to_string(counts.failed)), {}},
                      {escaped(fmt::format("{:.1f}", seconds)), {}}});
  }
  return table(t);
}

Html Report::picked(Verdict verdict, const std::string& title, const std::string& about) const {
  Table t{.columns = case_columns, .rows = {}};
  for (const CheckChapter& chapter : chapters_)
    for (std::size_t n = 0; n < chapter.results.size(); ++n)
      if (chapter.results[n].finding.verdict == verdict) {
        t.rows.push_back(row(chapter, n, chapter.cases[n].name));
        t.rows.back()[0].what = link(fmt::format("#{}", mark(chapter.cases[n])), chapter.cases[n].name);
      }
  if (t.rows.empty()) return {};
  return heading(2, title) + paragraph(escaped(about)) + table(t);
}

// A known limit of a model is described once, with the cases that show it.
Html limits_of(const std::vector<CheckChapter>& chapters) {
  std::vector<std::pair<std::string, std::vector<std::string>>> all; // reason, and its cases
  for (const CheckChapter& chapter : chapters)
    for (std::size_t n = 0; n < chapter.results.size(); ++n) {
      const Finding& finding = chapter.results[n].finding;
      if (finding.verdict != Verdict::Limit) continue;
      auto known =
          std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == finding.why; });
      if (known == all.end()) known = all.insert(all.end(), {finding.why, {}});
      known->second.push_back(chapter.cases[n].name);
    }
  if (all.empty()) return {};
  Html out =
      heading(2, "Known limits", "limits") +
      paragraph(escaped(
          "True of the models, whatever the program does. Each case asks that its figures hold all the same."));
  for (const auto& [why, cases] : all) {
    Html names;
    for (const std::string& name : cases)
      names += (names.text.empty() ? Html{} : escaped(", ")) + link(fmt::format("#{}", file_name(name)), name);
    out += paragraph(badge(Tone::Limit, "known limit") + escaped(" " + why));
    out += details(escaped(fmt::format("{} case{}", cases.size(), cases.size() == 1 ? "" : "s")),
                   paragraph(names));
  }
  return out;
}

// Rows and columns in the order of the cases' names. Empty if there would be a single column.
Html Report::matrix(const CheckChapter& chapter) const {
  std::vector<std::string> across, down;
  std::map<std::pair<std::string, std::string>, std::vector<std::size_t>> at;
  for (std::size_t n = 0; n < chapter.cases.size(); ++n) {
    const CheckCase& one = chapter.cases[n];
    if (std::find(across.begin(), across.end(), one.column) == across.end()) across.push_back(one.column);
    if (std::find(down.begin(), down.end(), one.row) == down.end()) down.push_back(one.row);
    at[{one.row, one.column}].push_back(n);
  }
  if (across.size() < 2) return {};
  Table t{.columns = {{""}}, .rows = {}};
  for (const std::string& name : across) t.columns.push_back({name});
  for (const std::string& name : down) {
    std::vector<html::TableCell> row{{escaped(name), {}}};
    for (const std::string& other : across) {
      Html cell;
      for (const std::size_t n : at[{name, other}]) {
        const Verdict verdict = chapter.results[n].finding.verdict;
        const char* word = verdict == Verdict::Limit ? "limit" : name_of(verdict);
        cell += Html{fmt::format("<a href=\"#{}\">", mark(chapter.cases[n]))} + badge(tone_of(verdict), word) +
                Html{"</a> "};
      }
      row.push_back({cell, {}});
    }
    t.rows.push_back(std::move(row));
  }
  return table(t);
}

Html Report::cases(const CheckChapter& chapter) const {
  Table t{.columns = case_columns, .rows = {}, .sortable = true};
  for (std::size_t n = 0; n < chapter.cases.size(); ++n)
    t.rows.push_back(row(chapter, n, short_name(chapter, chapter.cases[n])));
  return table(t);
}

Html Report::chapter(const CheckChapter& chapter) const {
  const Html grid = matrix(chapter), all = cases(chapter);
  return heading(2, chapter.family.title, chapter.family.name) + paragraph(escaped(chapter.family.about)) +
         grid +
         (grid.text.empty() ? all
                            : details(escaped(fmt::format("Every case ({})", chapter.cases.size())), all));
}

} // namespace

Json check_json(const std::vector<CheckChapter>& chapters, double seconds) {
  Json machine, families = Json::array();
  for (const auto& [name, value] : described(this_machine())) machine[name] = value;
  for (const CheckChapter& chapter : chapters) {
    Json cases = Json::array();
    for (std::size_t n = 0; n < chapter.results.size(); ++n)
      cases.push_back(json_of(chapter.cases[n], chapter.results[n]));
    families.push_back({{"name", chapter.family.name}, {"title", chapter.family.title}, {"cases", cases}});
  }
  const CheckCounts counts = count(chapters);
  return {
      {"machine", machine},
      {"seconds", seconds},
      {"counts",
       {{"ok", counts.ok}, {"refused", counts.refused}, {"limits", counts.limits}, {"failed", counts.failed}}},
      {"families", families}};
}

std::string check_page(const std::vector<CheckChapter>& chapters, double seconds) {
  const CheckCounts counts = count(chapters);
  const Report report(chapters);
  Html body = paragraph(escaped("Each case is a scene that strains the program, with what is expected of it "
                                "said before it ran. Ok: every figure "
                                "lies within its bounds. Refused: the scene is not accepted, and the message "
                                "says what would work. Known limit: true "
                                "of the model, and stated. Failed: anything else."));
  body += tiles({{std::to_string(counts.ok), "ok", Tone::Good},
                 {std::to_string(counts.refused), "refused, as they should be", Tone::Note},
                 {std::to_string(counts.limits), "known limits", Tone::Limit},
                 {std::to_string(counts.failed), "failed", counts.failed > 0 ? Tone::Bad : Tone::Plain},
                 {seconds_in_words(seconds), "for all of it", Tone::Plain}});
  body += report.picked(Verdict::Failed, "Failed", "What is not as expected.");
  body += report.contents();
  body += limits_of(chapters);
  for (const CheckChapter& chapter : chapters) body += report.chapter(chapter);
  std::vector<std::pair<std::string, Html>> machine;
  for (const auto& [name, value] : described(this_machine())) machine.push_back({name, escaped(value)});
  body += heading(2, "Made on") + facts(machine);
  body += paragraph(escaped("The presets of all cases stand in cases/ beside this page; any of them runs by ") +
                    code("rend run cases/NAME.xml") + escaped("."));
  return page("rend check", body);
}

} // namespace rend
