#include "render/pages/diff_report.h"

#include "render/report/page.h"
#include "sim/base/hash.h"
#include "sim/base/printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace rend {

using Json = nlohmann::ordered_json;

bool failed(const DiffReport& report, std::size_t n) {
  return report.cases[n].state != CaseState::Match && !report.updated[n];
}

std::size_t updated(const DiffReport& report) {
  return static_cast<std::size_t>(std::count(report.updated.begin(), report.updated.end(), true));
}

std::size_t count(const DiffReport& report, CaseState state) {
  std::size_t out = 0;
  for (std::size_t n = 0; n < report.cases.size(); ++n)
    if (report.cases[n].state == state && !report.updated[n]) ++out;
  return out;
}

std::vector<std::size_t> failures_first(const DiffReport& report) {
  std::vector<std::size_t> order(report.cases.size());
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
  const auto rank = [&](std::size_t n) {
    const auto& all = all_states();
    const CaseState state = failed(report, n) ? report.cases[n].state : CaseState::Match;
    return std::find(all.begin(), all.end(), state) - all.begin();
  };
  const auto flip = [&](std::size_t n) {
    return failed(report, n) && report.cases[n].metrics ? report.cases[n].metrics->flip.mean : 0.;
  };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t m, std::size_t n) {
    return rank(m) != rank(n) ? rank(m) < rank(n) : flip(m) > flip(n);
  });
  return order;
}

Exit exit_of(const DiffReport& report) {
  if (count(report, CaseState::Unreadable) > 0) return Exit::DiffError;
  for (std::size_t n = 0; n < report.cases.size(); ++n)
    if (failed(report, n)) return Exit::CheckFailed;
  return Exit::Done;
}

namespace {

Json figures_json(const Metrics& m) {
  const Difference& d = m.difference;
  const OverThreshold& o = m.over;
  Json psnr;
  if (std::isfinite(d.psnr)) psnr = d.psnr;
  return {
      {"max", d.max},
      {"mean", d.mean},
      {"rmse", d.rmse},
      {"psnr", psnr},
      {"ssim", m.ssim},
      {"flip",
       {{"mean", m.flip.mean},
        {"weighted_quartile_1", m.flip.quartile},
        {"weighted_median", m.flip.median},
        {"weighted_quartile_3", m.flip.upper},
        {"max", m.flip.max}}},
      {"share", o.share},
      {"over_threshold", o.pixels},
      {"window",
       {{"share", o.dense}, {"x", o.corner.x}, {"y", o.corner.y}, {"width", o.width}, {"height", o.height}}},
      {"differing", d.differing},
      {"counted", d.counted},
      {"worst_pixel", {{"x", d.worst.x}, {"y", d.worst.y}}},
      {"worst_place", {{"x", m.worst.x}, {"y", m.worst.y}}}};
}

std::string reasons_text(const std::vector<std::string>& parts) {
  std::string out;
  for (const std::string& part : parts) out += (out.empty() ? "" : "; ") + part;
  return out;
}

std::string figures_text(const Metrics& m) {
  const auto line = [](const char* name, const std::string& value) {
    return fmt::format("  {:<12}{}\n", name, value);
  };
  const auto& d = m.difference;
  std::string out = line("max", fmt::format("{:.4g} levels, at ({}, {})", d.max, d.worst.x, d.worst.y));
  out +=
      line("mean", fmt::format("{:.6g} levels", d.mean)) + line("rmse", fmt::format("{:.6g} levels", d.rmse));
  out += line("psnr", std::isfinite(d.psnr) ? fmt::format("{:.4f} dB", d.psnr) : "infinite");
  out += line("ssim", fmt::format("{:.7f}", m.ssim));
  out += line("flip", fmt::format("{:.6f} mean, {:.6f} weighted median (quartiles {:.6f}, {:.6f}), {:.6f} max",
                                  m.flip.mean, m.flip.median, m.flip.quartile, m.flip.upper, m.flip.max));
  out += line("share", fmt::format("{:.6g} over the threshold: {} of {} pixels", m.over.share, m.over.pixels,
                                   d.counted));
  out += line("window", fmt::format("{:.6g} of {} x {} pixels at ({}, {})", m.over.dense, m.over.width,
                                    m.over.height, m.over.corner.x, m.over.corner.y));
  return out;
}

std::string line_of(const DiffReport& report, std::size_t n) {
  const CaseResult& one = report.cases[n];
  std::string line =
      fmt::format("{:<11} {}", report.updated[n] ? "updated" : name_of(one.state), one.paths.name);
  if (!one.why.empty() && !report.updated[n]) line += ": " + reasons_text(one.why);
  return printable(line) + "\n";
}

} // namespace

Json case_json(const CaseResult& one, Expectation expectation) {
  Json out{{"name", one.paths.name},
           {"state", name_of(one.state)},
           {"updated", expectation == Expectation::Updated}};
  if (!one.paths.a.empty()) out["expected"] = one.paths.a.string();
  if (!one.paths.b.empty()) out["now"] = one.paths.b.string();
  out["width"] = one.width;
  out["height"] = one.height;
  out["why"] = one.why;
  out["notes"] = one.notes;
  out["limits"] = limits_of(one.tolerance);
  out["threshold"] = one.tolerance.threshold;
  if (one.metrics) out["figures"] = figures_json(*one.metrics);
  return out;
}

namespace {

Json clip_json(const DiffReport& report, const ClipDifference& clip) {
  Json curve = Json::array();
  for (std::size_t n = 0; n < clip.cases.size(); ++n)
    curve.push_back({{"name", report.cases[clip.cases[n]].paths.name}, {"flip", clip.flip[n]}});
  return {{"name", clip.name},
          {"frames", clip.cases.size()},
          {"first", report.cases[clip.cases[clip.first]].paths.name},
          {"worst", report.cases[clip.cases[clip.worst]].paths.name},
          {"curve", curve}};
}

} // namespace

Json diff_json(const DiffReport& report) {
  Json counts, cases = Json::array();
  for (const CaseState state : all_states()) counts[name_of(state)] = count(report, state);
  counts["updated"] = updated(report);
  for (std::size_t n = 0; n < report.cases.size(); ++n)
    cases.push_back(case_json(report.cases[n], report.expectation(n)));
  Json out{{"expected", report.a}, {"now", report.b},           {"exit", static_cast<int>(exit_of(report))},
           {"counts", counts},     {"remarks", report.remarks}, {"cases", cases}};
  for (const ClipDifference& clip : report.clips) out["clips"].push_back(clip_json(report, clip));
  return out;
}

// Whether a frame does not match and was not updated.
bool any_is_left(const DiffReport& report, const ClipDifference& clip) {
  return std::any_of(clip.cases.begin(), clip.cases.end(), [&](std::size_t n) { return failed(report, n); });
}

std::string clip_text(const DiffReport& report, const ClipDifference& clip) {
  const auto name = [&](std::size_t n) { return report.cases[clip.cases[n]].paths.name; };
  return fmt::format("{}: {} frames; the first that does not match is {}, the worst {} (mean of FLIP {:.4g})",
                     clip.name.empty() ? "clip" : clip.name, clip.cases.size(), name(clip.first),
                     name(clip.worst), clip.flip[clip.worst]);
}

std::string diff_text(const DiffReport& report) {
  std::string out;
  for (const std::size_t n : failures_first(report))
    if (failed(report, n) || report.updated[n] || report.cases.size() == 1) out += line_of(report, n);
  if (report.cases.size() == 1) {
    const CaseResult& one = report.cases.front();
    for (const std::string& note : one.notes) out += "  " + printable(note) + "\n";
    return one.metrics ? out + figures_text(*one.metrics) : out;
  }
  for (const ClipDifference& clip : report.clips)
    if (any_is_left(report, clip)) out += "clip        " + printable(clip_text(report, clip)) + "\n";
  out += fmt::format("{} pictures:", report.cases.size());
  std::string counts;
  for (const CaseState state : all_states())
    if (const std::size_t number = count(report, state); number > 0)
      counts += fmt::format("{} {} {}", counts.empty() ? "" : ",", number, name_of(state));
  if (const std::size_t number = updated(report); number > 0)
    counts += fmt::format("{} {} updated", counts.empty() ? "" : ",", number);
  return out + counts + "\n";
}

std::string diff_junit(const DiffReport& report) {
  const auto text = [](const std::string& any) { return html::escaped(any).text; };
  const std::size_t errors = count(report, CaseState::Unreadable);
  std::size_t failures = 0;
  std::string cases;
  for (std::size_t n = 0; n < report.cases.size(); ++n) {
    const CaseResult& one = report.cases[n];
    const std::size_t slash = one.paths.name.rfind('/');
    const std::string folder = slash == std::string::npos ? "" : one.paths.name.substr(0, slash);
    cases += fmt::format("    <testcase classname=\"{}\" name=\"{}\"",
                         text(folder.empty() ? "pictures" : folder), text(one.paths.name));
    if (!failed(report, n)) {
      cases += "/>\n";
      continue;
    }
    const char* element = one.state == CaseState::Unreadable ? "error" : "failure";
    if (one.state != CaseState::Unreadable) ++failures;
    cases += fmt::format(
        ">\n      <{0} type=\"{1}\" message=\"{1}: {2}\">expected: {3}\nnow: {4}\n{5}</{0}>\n    "
        "</testcase>\n",
        element, name_of(one.state), text(reasons_text(one.why)), text(one.paths.a.string()),
        text(one.paths.b.string()), one.metrics ? html::escaped_lines(figures_text(*one.metrics)).text : "");
  }
  return fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{0}\" failures=\"{1}\" "
                     "errors=\"{2}\">\n  <testsuite name=\"rend diff\" tests=\"{0}\" failures=\"{1}\" "
                     "errors=\"{2}\">\n{3}  </testsuite>\n</testsuites>\n",
                     report.cases.size(), failures, errors, cases);
}

namespace {

// The file that a reviewer knows: the expected picture, or the new one.
std::string file_of(const CaseResult& one) {
  return (one.paths.a.empty() ? one.paths.b : one.paths.a).string();
}

// As workflow commands take it: in properties ':' and ',' have a meaning, too.
std::string github_text(const std::string& text, bool property) {
  std::string out;
  for (const char c : text) {
    const bool special = c == '%' || c == '\r' || c == '\n' || (property && (c == ':' || c == ','));
    out += special ? fmt::format("%{:02X}", static_cast<unsigned char>(c)) : std::string(1, c);
  }
  return out;
}

} // namespace

std::string diff_gitlab(const DiffReport& report) {
  Json issues = Json::array();
  for (const std::size_t n : failures_first(report)) {
    const CaseResult& one = report.cases[n];
    if (!failed(report, n)) continue;
    const std::string what =
        fmt::format("{}: {}: {}", one.paths.name, name_of(one.state), reasons_text(one.why));
    issues.push_back(
        {{"description", printable(what)},
         {"check_name", fmt::format("rend diff: {}", name_of(one.state))},
         {"fingerprint", fmt::format("{:016x}", hash_bytes(one.paths.name.data(), one.paths.name.size()))},
         {"severity", one.state == CaseState::Unreadable ? "blocker" : "major"},
         {"location", {{"path", file_of(one)}, {"lines", {{"begin", 1}}}}}});
  }
  return text_of(issues, 2) + "\n";
}

std::string diff_github(const DiffReport& report) {
  std::string out;
  for (const std::size_t n : failures_first(report)) {
    const CaseResult& one = report.cases[n];
    if (failed(report, n))
      out += fmt::format("::error file={},title={}::{}\n", github_text(printable(file_of(one)), true),
                         github_text(fmt::format("rend diff: {}", name_of(one.state)), true),
                         github_text(printable(one.paths.name + ": " + reasons_text(one.why)), false));
  }
  return out;
}

} // namespace rend
