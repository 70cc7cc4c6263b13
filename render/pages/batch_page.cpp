#include "render/pages/batch_page.h"

#include "render/console/console.h"
#include "render/files/png.h"
#include "render/pages/provenance.h"
#include "render/pages/run_columns.h"
#include "render/report/page.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

namespace fs = std::filesystem;
using namespace html;

constexpr int thumbnail_width = 480; // [pixels]

// Downscales by a box filter: each pixel is the mean of those that it covers.
Image made_smaller(const Image& from, int width) {
  const int height = std::max(1, from.height * width / from.width);
  Image to(width, height, from.channels);
  for (int y = 0; y < height; ++y) {
    const int top = y * from.height / height, bottom = std::max(top + 1, (y + 1) * from.height / height);
    for (int x = 0; x < width; ++x) {
      const int left = x * from.width / width, right = std::max(left + 1, (x + 1) * from.width / width);
      const int count = (bottom - top) * (right - left);
      for (int c = 0; c < from.channels; ++c) {
        int sum = 0;
        for (int v = top; v < bottom; ++v)
          for (int u = left; u < right; ++u) sum += from.row(v)[u * from.channels + c];
        to.row(y)[x * to.channels + c] = static_cast<std::uint8_t>((sum + count / 2) / count);
      }
    }
  }
  return to;
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
  std::vector<fs::path> all;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ".png") all.push_back(at->path());
  std::sort(all.begin(), all.end());
  return all;
}

// The picture two thirds into the clip: by then much has usually happened.
Html thumbnail(const fs::path& folder, const std::string& name) {
  const std::vector<fs::path> all = pictures_in(folder);
  if (all.empty() || !png_available()) return muted("no pictures");
  const fs::path& path = all[2 * (all.size() - 1) / 3];
  try {
    const Image image = read_png(path);
    const std::vector<std::uint8_t> bytes =
        encode_png(image.width > thumbnail_width ? made_smaller(image, thumbnail_width) : image);
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    return figure(PictureFormat::Png, text, fmt::format("{}, {}", name, path.filename().string()));
  } catch (const UserError&) {
    return muted("its picture cannot be read");
  }
}

Tone tone_of(BatchState state) {
  return state == BatchState::Done       ? Tone::Good
         : state == BatchState::Stopped  ? Tone::Note
         : state == BatchState::Unstable ? Tone::Limit
                                         : Tone::Bad;
}

// As JSON has it; nothing where no figures were printed, a dash where they do not know this one.
TableCell number_cell(const BatchResult& result, const std::optional<std::size_t>& number) {
  if (!result.figures) return {escaped("")};
  return {escaped(number ? std::to_string(*number) : "–")};
}

// Progress is worth less than what comes last.
std::string last_lines(const std::string& log) {
  constexpr std::size_t most = 4000; // [bytes] of the page
  if (log.size() <= most) return log;
  const std::size_t end = log.find('\n', log.size() - most);
  return "...\n" + (end == std::string::npos ? "" : log.substr(end + 1));
}

// A link to what a job has left, if it is there: its pictures, or what it said.
Html name_of_job(const BatchReport& report, const BatchJob& job) {
  const std::string there = report.runs ? "logs/" + job.name + ".log" : job.name + "/";
  std::error_code error;
  const Html name =
      fs::exists(report.folder / there, error) ? link(address_of(there), job.name) : escaped(job.name);
  return name + Html{"<br>"} + muted(job.preset);
}

std::vector<TableColumn> columns_of(const BatchReport& report) {
  std::vector<TableColumn> columns{{"job"}, {"state"}};
  if (report.runs) {
    const std::vector<TableColumn> figures = run_columns(report);
    columns.insert(columns.end(), figures.begin(), figures.end());
  } else {
    columns.insert(columns.begin(), {""});
    columns.insert(columns.end(), {number_column("frames"), number_column("kept"), number_column("tears")});
  }
  columns.insert(columns.end(), {number_column("time"), number_column("memory")});
  return columns;
}

std::vector<TableCell> row_of(const BatchReport& report, std::size_t n) {
  const BatchJob& job = report.jobs[n];
  const BatchResult& result = report.results[n];
  const PrintedFigures figures = result.figures.value_or(PrintedFigures{});
  Html words = name_of_job(report, job);
  if (!result.message.empty()) words += paragraph(escaped(result.message));
  if (!result.log.empty())
    words += details(escaped("log"), escaped_lines(last_lines(result.log)), Details::Closed);
  std::vector<TableCell> row{{words, job.name}, {badge(tone_of(result.state()), name_of(result.state()))}};
  if (report.runs) {
    const std::vector<TableCell> cells = run_cells(report, n);
    row.insert(row.end(), cells.begin(), cells.end());
  } else {
    row.insert(row.begin(), {thumbnail(report.folder / job.name, job.name), job.name});
    row.insert(row.end(), {number_cell(result, figures.pictures.made),
                           number_cell(result, figures.pictures.kept), number_cell(result, figures.tears)});
  }
  row.push_back({escaped(seconds_in_words(result.seconds)), fmt::format("{}", result.seconds)});
  row.push_back({escaped(bytes_in_words(result.peak)), fmt::format("{}", result.peak)});
  return row;
}

} // namespace

fs::path log_file(const BatchReport& report, const BatchJob& job) {
  return report.folder / "logs" / (job.name + ".log");
}

std::string csv_name(const std::string& page) {
  return (page == "index" ? "figures" : page) + ".csv";
}

std::string batch_page(const BatchReport& report, const std::string& name) {
  std::size_t done = 0, bad = 0;
  double sum = 0;
  for (const BatchResult& result : report.results) {
    done += result.done();
    bad += result.failed();
    sum += result.seconds;
  }
  const std::size_t stopped = report.results.size() - done - bad;
  Html body = tiles({{std::to_string(done), "done", Tone::Good},
                     {std::to_string(bad), "failed", bad > 0 ? Tone::Bad : Tone::Plain},
                     {std::to_string(stopped), "stopped or not begun", stopped > 0 ? Tone::Note : Tone::Plain},
                     {seconds_in_words(report.seconds), "for all of it", Tone::Plain},
                     {seconds_in_words(sum), "of all jobs together", Tone::Plain}});
  std::vector<std::size_t> order(report.jobs.size());
  for (std::size_t n = 0; n < order.size(); ++n) order[n] = n;
  std::stable_partition(order.begin(), order.end(), [&](std::size_t n) { return report.results[n].failed(); });
  Table t{.columns = columns_of(report),
          .rows = {},
          .sortable = true,
          .caption = report.runs
                         ? "Failures first; a click on a column's name sorts by it."
                         : "Failures first; a click on a column's name sorts by it. \"frames\" were made "
                           "now, \"kept\" ones were already there."};
  for (std::size_t n : order) t.rows.push_back(row_of(report, n));
  if (report.runs)
    body += paragraph(escaped("All figures of all jobs: ") + link(address_of(csv_name(name)), csv_name(name)));
  body += table(t) + heading(2, "Made on") + facts_of(provenance_of_build());
  return page("rend batch", body);
}

} // namespace rend
