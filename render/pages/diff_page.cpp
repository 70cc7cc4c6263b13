#include "render/pages/diff_page.h"

#include "render/files/input_file.h"
#include "render/report/page.h"
#include "render/report/picture_viewer.h"
#include "sim/base/error.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <set>

namespace rend {
namespace {

namespace fs = std::filesystem;
using namespace html;

constexpr std::size_t most_bytes = 100'000'000; // of pictures in a page

Tone tone_of(CaseState state) {
  switch (state) {
  case CaseState::Match:
    return Tone::Good;
  case CaseState::New:
    return Tone::Note;
  case CaseState::Missing:
  case CaseState::Size:
    return Tone::Limit;
  case CaseState::Differ:
  case CaseState::Unreadable:
    break;
  }
  return Tone::Bad;
}

std::uintmax_t size_of(const fs::path& path) { // 0 if there is no such file
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

std::vector<std::uint8_t> bytes_of(const fs::path& path) {
  if (path.empty()) return {};
  try {
    return file_bytes(path);
  } catch (const UserError&) {
    return {};
  }
}

std::string_view view(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

html::TableCell figure_cell(double value, int digits = 3) {
  return {escaped(in_digits(value, digits)), fmt::format("{}", value)};
}

const std::vector<html::TableColumn> picture_columns{{"picture"},
                                                     {"state"},
                                                     number_column("max"),
                                                     number_column("mean"),
                                                     number_column("RMSE"),
                                                     number_column("PSNR"),
                                                     number_column("SSIM"),
                                                     number_column("FLIP"),
                                                     number_column("share"),
                                                     number_column("window")};

std::vector<html::TableCell> row_of(const CaseResult& one, const Html& name, const Html& state) {
  std::vector<html::TableCell> row{{name, one.paths.name}, {state, {}}};
  if (!one.metrics) {
    for (std::size_t n = row.size(); n < picture_columns.size(); ++n) row.push_back({muted("-"), {}});
    return row;
  }
  const Metrics& m = *one.metrics;
  for (const double value : {m.difference.max, m.difference.mean, m.difference.rmse, m.difference.psnr})
    row.push_back(figure_cell(value));
  row.push_back(figure_cell(m.ssim, 6));
  for (const double value : {m.flip.mean, m.over.share, m.over.dense}) row.push_back(figure_cell(value));
  return row;
}

std::string mark_of(std::size_t n) {
  return fmt::format("case-{}", n);
}

Html state_of(const DiffReport& report, std::size_t n) {
  const CaseState state = report.cases[n].state;
  return report.updated[n] ? badge(Tone::Note, "updated") : badge(tone_of(state), name_of(state));
}

Html figures_of(const CaseResult& one) {
  const Metrics& m = *one.metrics;
  const auto& d = m.difference;
  return facts(
      {{"largest difference", escaped(fmt::format("{:.4g} levels, at ({}, {})", d.max, d.worst.x, d.worst.y))},
       {"mean, RMSE", escaped(fmt::format("{:.4g}, {:.4g} levels", d.mean, d.rmse))},
       {"PSNR, SSIM", escaped(fmt::format("{:.2f} dB, {:.6f}", d.psnr, m.ssim))},
       {"FLIP",
        escaped(fmt::format("mean {:.5f}; weighted median {:.4f}, quartiles {:.4f} and {:.4f}; largest {:.4f}",
                            m.flip.mean, m.flip.median, m.flip.quartile, m.flip.upper, m.flip.max))},
       {fmt::format("over {:.4g} levels", one.tolerance.threshold),
        escaped(fmt::format("{} of {} pixels ({:.3g} %)", m.over.pixels, d.counted, 100 * m.over.share))},
       {"densest window",
        escaped(fmt::format("{} x {} pixels at ({}, {}), of which {:.3g} % are over it", m.over.width,
                            m.over.height, m.over.corner.x, m.over.corner.y, 100 * m.over.dense))}});
}

class Chapters {
public:
  explicit Chapters(const DiffReport& report) : report_(report) {}
  Html chapter(std::size_t n);

private:
  Html pictures(const CaseResult& one);

  const DiffReport& report_;
  std::size_t bytes_ = 0; // of the pictures embedded so far
};

Html Chapters::pictures(const CaseResult& one) {
  if (bytes_ + size_of(one.paths.a) + size_of(one.paths.b) + one.heat.size() > most_bytes)
    return paragraph(
        muted("The pictures are left out here, for this page has 100 MB of them; compare this one alone "
              "to see it."));
  const std::vector<std::uint8_t> a = bytes_of(one.paths.a), b = bytes_of(one.paths.b);
  if (a.empty() && b.empty()) return {};
  bytes_ += a.size() + b.size() + one.heat.size();
  ComparisonView all;
  all.name = one.paths.name;
  all.a = view(a);
  all.b = view(b);
  all.heat = view(one.heat);
  all.width = one.width;
  all.height = one.height;
  all.same_size = one.metrics.has_value();
  if (one.metrics) {
    all.x = one.metrics->worst.x;
    all.y = one.metrics->worst.y;
  }
  return compare(all);
}

Html Chapters::chapter(std::size_t n) {
  const CaseResult& one = report_.cases[n];
  Html out = heading(3, one.paths.name, mark_of(n));
  Html line = state_of(report_, n);
  for (const std::string& why : one.why)
    line += escaped(" ") + strong(why) + escaped(&why == &one.why.back() ? "" : ";");
  out += paragraph(line);
  for (const std::string& note : one.notes) out += paragraph(muted(note));
  if (one.state != CaseState::Unreadable) out += pictures(one);
  if (one.metrics) out += details(escaped("Figures"), figures_of(one), Details::Open);
  return out;
}

// FLIP over the frames, as a drawing of its own; the worst frame is marked.
Html curve_of(const ClipDifference& clip) {
  constexpr double width = 640, height = 120, rim = 4; // [pixels]
  const double most = std::max(clip.flip[clip.worst], 1e-9);
  const auto x = [&](std::size_t n) {
    return rim + (width - 2 * rim) * static_cast<double>(n) /
                     static_cast<double>(std::max<std::size_t>(clip.flip.size() - 1, 1));
  };
  const auto y = [&](double flip) { return height - rim - (height - 2 * rim) * flip / most; };
  std::string points;
  for (std::size_t n = 0; n < clip.flip.size(); ++n)
    points += fmt::format("{:.1f},{:.1f} ", x(n), y(clip.flip[n]));
  return Html{
      fmt::format("<svg class=\"curve\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\">"
                  "<polyline points=\"{2}\" fill=\"none\" stroke=\"#0072b2\" stroke-width=\"1.5\"/>"
                  "<circle cx=\"{3:.1f}\" cy=\"{4:.1f}\" r=\"3\" fill=\"#d55e00\"/></svg>\n",
                  width, height, points, x(clip.worst), y(clip.flip[clip.worst]))};
}

Html clip_chapter(const DiffReport& report, const ClipDifference& clip) {
  return heading(2, fmt::format("Over time: {}", clip.name)) + paragraph(escaped(clip_text(report, clip))) +
         curve_of(clip);
}

Html counts_of(const DiffReport& report) {
  std::vector<Tile> all;
  for (const CaseState state : all_states()) {
    const std::size_t number = count(report, state);
    if (number == 0 && state != CaseState::Match && state != CaseState::Differ) continue;
    all.push_back({std::to_string(number), name_of(state), number == 0 ? Tone::Plain : tone_of(state)});
  }
  if (const std::size_t number = updated(report); number > 0)
    all.push_back({std::to_string(number), "updated", Tone::Note});
  return tiles(all);
}

} // namespace

std::string diff_page(const DiffReport& report) {
  Html body = counts_of(report);
  body += facts({{"expected", code(report.a)}, {"now", code(report.b)}});
  for (const std::string& remark : report.remarks)
    body += paragraph(badge(Tone::Limit, "note") + escaped(fmt::format(" {}", remark)));
  Table failures{.columns = picture_columns, .rows = {}, .sortable = true}, rest = failures;
  Html pictures;
  Chapters chapters(report);
  for (const std::size_t n : failures_first(report)) {
    const CaseResult& one = report.cases[n];
    const bool shown = one.state != CaseState::Match;
    const Html name = shown ? link(fmt::format("#{}", mark_of(n)), one.paths.name) : escaped(one.paths.name);
    (failed(report, n) ? failures : rest).rows.push_back(row_of(one, name, state_of(report, n)));
    if (shown) pictures += chapters.chapter(n);
  }
  if (failures.rows.empty())
    body += paragraph(strong("Every picture is as it should be."));
  else
    body += heading(2, "What is not as expected", "failures") + table(failures);
  for (const ClipDifference& clip : report.clips) body += clip_chapter(report, clip);
  if (!pictures.text.empty()) body += heading(2, "Pictures", "pictures") + pictures;
  if (!rest.rows.empty())
    body += heading(2, "As expected", "matches") +
            details(escaped(fmt::format("{} picture{}", rest.rows.size(), rest.rows.size() == 1 ? "" : "s")),
                    table(rest), failures.rows.empty() ? Details::Open : Details::Closed);
  return page("rend diff", body, compare_style, compare_script);
}

DiffFiles::DiffFiles(const DiffFileNames& names) {
  if (!names.folder.empty()) {
    folder_.emplace(names.folder);
    maps_.emplace(folder_->path() / "maps");
    folder_->make();
    json_.emplace(folder_->path() / "diff.json");
    page_.emplace(folder_->path() / "index.html");
  }
  if (!names.junit.empty()) junit_.emplace(resolve_link(names.junit));
  if (!names.gitlab.empty()) gitlab_.emplace(resolve_link(names.gitlab));
  if (!names.github.empty()) github_.emplace(resolve_link(names.github));
}

void DiffFiles::write_maps(const DiffReport& report) const {
  std::set<fs::path> folders;
  for (const CaseResult& one : report.cases) {
    if (one.heat.empty()) continue;
    const fs::path path = maps_->path() / one.paths.name;
    const OutputFolder into(path.parent_path());
    into.make();
    OutputFile file(path);
    file.write(one.heat);
    file.commit();
    folders.insert(into.path());
  }
  for (const fs::path& folder : folders) sync_folder(folder);
}

void DiffFiles::write(const std::string& page, const DiffReport& report) {
  const auto write = [](OutputFile& file, const std::string& text) {
    file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    file.commit();
    sync_folder(file.path().parent_path());
  };
  if (junit_) write(*junit_, diff_junit(report));
  if (gitlab_) write(*gitlab_, diff_gitlab(report));
  if (github_) write(*github_, diff_github(report));
  if (!folder_) return;
  write_maps(report);
  write(*json_, text_of(diff_json(report), 2) + "\n");
  write(*page_, page);
}

} // namespace rend
