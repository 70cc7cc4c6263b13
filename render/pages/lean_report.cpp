#include "render/pages/lean_report.h"

#include "render/pages/named_values.h"
#include "render/report/page.h"
#include "sim/base/enum_words.h"
#include "sim/base/printable.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;
using namespace html;

constexpr double to_micro = 1e6;

std::string percent(double ratio) {
  return fmt::format("{:+.1f} %", 100 * (ratio - 1));
}

std::string bytes_more(const LeanRow& row) {
  return fmt::format("{:+}", static_cast<long long>(row.bytes_on) - static_cast<long long>(row.bytes_off));
}

std::string sameness(const LeanRow& row) {
  if (row.same == LeanSame::Free) return row.same_state ? "same state" : "another motion";
  if (!row.as_required()) return row.same_pixels ? "OTHER STATE" : "OTHER PIXELS";
  return row.same_state ? "same bits" : "same pixels";
}

// Shared by the page and the table.
std::string verdict_on_unused(const std::vector<LeanRow>& rows) {
  std::string out;
  for (const LeanRow& row : rows) {
    if (row.feature != "all that is not asked for" || !row.measured()) continue;
    const char* noise = row.time.differs() ? "more than" : "within";
    out += fmt::format(
        "{}{}: what is not asked for takes {} bytes, and {} of the time of a loop that knows nothing of it "
        "({} the noise of {:.1f} %).",
        out.empty() ? "" : " ", row.scene, row.bytes_on, percent(row.time.ratio), noise, 100 * row.time.noise);
  }
  return out;
}

// What was not measured is not there.
NamedValues values_of(const LeanRow& row) {
  static constexpr EnumWords<LeanSame::Free> same{"state", "pixels", "nothing"};
  const auto measured = [&](auto value) { return row.measured() ? std::optional(value) : std::nullopt; };
  return {{"scene", row.scene},
          {"feature", row.feature},
          {"what", row.what},
          {"refused", row.measured() ? std::nullopt : std::optional(row.refused)},
          {"bytes_off", measured(row.bytes_off)},
          {"bytes_on", measured(row.bytes_on)},
          {"seconds_off", measured(row.time.off.median)},
          {"seconds_off_iqr", measured(row.time.off.quartiles)},
          {"seconds_on", measured(row.time.on.median)},
          {"seconds_on_iqr", measured(row.time.on.quartiles)},
          {"ratio", measured(row.time.ratio)},
          {"ratio_low", measured(row.time.low)},
          {"ratio_high", measured(row.time.high)},
          {"noise", measured(row.time.noise)},
          {"builds", row.time.builds},
          {"runs", row.time.off.runs},
          {"must_be_same", same[row.same]},
          {"same_state", measured(row.same_state)},
          {"same_pixels", measured(row.same_pixels)},
          {"as_promised", row.as_required()}};
}

} // namespace

Json json_of(const std::vector<LeanRow>& rows) {
  Json all = Json::array();
  for (const LeanRow& row : rows) all.push_back(json_of(values_of(row)));
  return all;
}

std::string csv_of(const std::vector<LeanRow>& rows) {
  std::vector<NamedValues> all;
  for (const LeanRow& row : rows) all.push_back(values_of(row));
  return csv_of(all, CsvStyle::Quoted);
}

std::string table_of(const std::vector<LeanRow>& rows) {
  std::string out =
      fmt::format("{:<7}{:<36}{:>10}{:>11}{:>11}{:>10}{:>8}  {}\n", "scene", "feature, on against off", "bytes",
                  "off, us", "on, us", "time", "noise", "state");
  std::string refused;
  for (const LeanRow& row : rows) {
    if (!row.measured()) {
      refused += printable(fmt::format("  {}, {}: {}", row.scene, row.feature, row.refused)) + "\n";
      continue;
    }
    out +=
        fmt::format("{:<7}{:<36}{:>10}{:>11.3f}{:>11.3f}{:>10}{:>7.1f}%  {}\n", printable(row.scene),
                    row.feature, bytes_more(row), row.time.off.median * to_micro, row.time.on.median * to_micro,
                    percent(row.time.ratio), 100 * row.time.noise, sameness(row));
  }
  return out + verdict_on_unused(rows) + "\n" + (refused.empty() ? "" : "Not there:\n" + refused);
}

std::string page_of(const std::vector<LeanRow>& rows, const Provenance& p) {
  Table table{.columns = {{"scene"},
                          {"feature"},
                          {"what is compared"},
                          number_column("bytes"),
                          number_column("off [µs a step]"),
                          number_column("on [µs a step]"),
                          number_column("time"),
                          number_column("noise"),
                          {"state and pixels"}},
              .rows = {},
              .sortable = true};
  std::vector<Html> refused;
  for (const LeanRow& row : rows) {
    if (!row.measured()) {
      refused.push_back(escaped(row.scene + ", " + row.feature + ": " + row.refused));
      continue;
    }
    table.rows.push_back(
        {{escaped(row.scene)},
         {escaped(row.feature)},
         {escaped(row.what)},
         {escaped(bytes_more(row)), bytes_more(row)},
         {escaped(in_digits(row.time.off.median * to_micro))},
         {escaped(in_digits(row.time.on.median * to_micro))},
         {row.time.differs() ? strong(percent(row.time.ratio)) : escaped(percent(row.time.ratio)),
          fmt::format("{}", row.time.ratio)},
         {escaped(fmt::format("± {:.1f} %", 100 * row.time.noise)), fmt::format("{}", row.time.noise)},
         {badge(!row.as_required()           ? Tone::Bad
                : row.same == LeanSame::Free ? Tone::Plain
                                             : Tone::Good,
                sameness(row))}});
  }
  Html body = paragraph(strong(verdict_on_unused(rows))) + heading(2, "Each feature, on against off") +
              html::table(table);
  if (!refused.empty()) body += heading(2, "Not there") + list(refused);
  body +=
      heading(2, "How it was measured") +
      list({escaped(
                "Short runs of both in turn, by the clock of the thread, one thread; both built anew several "
                "times. Time: the median over builds of the median ratio of pairs; noise: two standard "
                "errors of it, from the quartiles of the builds. Bold: more than noise."),
            escaped("Bytes: of all arrays after the runs. State: the hash of positions, velocities, topology."),
            escaped(
                "The first row compares the loop of every scene, with the checks that guard each step, with "
                "one that knows forces, scheme and fixed vertices alone; its bytes are those of laws, loads, "
                "contact and solver in a scene without them.")});
  body += heading(2, "Where it comes from") + facts_of(p);
  return page("What features cost", body);
}

} // namespace rend
