#include "render/report/plot.h"

#include "render/report/gnuplot.h"
#include "sim/base/check.h"
#include "sim/base/printable.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace rend {
namespace {

struct Look {
  const char* colour;
  int mark, hollow; // gnuplot's point types
  const char* dash;
};
constexpr std::array<Look, 8> looks{{{"#0072b2", 7, 6, "solid"},
                                     {"#d55e00", 5, 4, "(14,5)"},
                                     {"#009e73", 9, 8, "(4,4)"},
                                     {"#cc79a7", 13, 12, "(14,5,3,5)"},
                                     {"#e69f00", 11, 10, "(8,3)"},
                                     {"#333333", 15, 14, "(2,4)"},
                                     {"#56b4e9", 7, 6, "(14,5,3,5,3,5)"},
                                     {"#8c6d31", 5, 4, "(6,6)"}}};

const Look& look_of(const PlotSeries& series) {
  return looks[static_cast<std::size_t>(series.style_number) % looks.size()];
}

// A gnuplot string. Within single quotes only the quote itself is special (doubling it is not supported
// everywhere), and in some versions the backquote: both are replaced by typographic apostrophes.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : printable(text)) out += c == '\'' || c == '`' ? "\u2019" : std::string(1, c);
  return out + "'";
}

struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void take(double value, bool logarithmic) {
    CHECK(std::isfinite(value) && (!logarithmic || value > 0));
    low = std::min(low, value);
    high = std::max(high, value);
  }
};

// Adds a margin around the data.
std::string range_text(Range r, bool logarithmic) {
  if (r.low > r.high) return logarithmic ? "[0.1:1]" : "[0:1]";
  if (logarithmic) {
    const double air = std::max(1.25, std::pow(r.high / r.low, 0.04));
    return fmt::format("[{:.17g}:{:.17g}]", r.low / air, r.high * air);
  }
  const double air = r.high > r.low ? 0.05 * (r.high - r.low) : std::max(0.5 * std::abs(r.high), 1e-300);
  return fmt::format("[{:.17g}:{:.17g}]", r.low - air, r.high + air);
}

// Tics at every decade, or every few decades on a long axis; below 1.2 decades gnuplot's own tics, as plain
// numbers.
std::string axis_text(const char* axis, Range r, bool logarithmic) {
  std::string out = fmt::format("set {}range {}\n", axis, range_text(r, logarithmic));
  if (!logarithmic) return out;
  const double decades = r.low <= r.high ? std::log10(r.high / r.low) : 1;
  out += fmt::format("set logscale {}\n", axis);
  if (decades < 1.2) return out + fmt::format("set format {} '%.2g'\n", axis);
  const int every = std::max(1, static_cast<int>(std::ceil(decades / 9)));
  out += fmt::format("set format {} '10^{{%L}}'\nset {}tics 1e{}\n", axis, axis, every);
  return out + (every > 1 ? fmt::format("unset m{}tics\n", axis) : "");
}

std::string number(std::optional<double> value) {
  return value ? fmt::format("{:.17g}", *value) : "NaN";
}

std::string data_block(const std::string& name, const std::vector<PlotPoint>& points) {
  std::string out = "$" + name + " << END_OF_DATA\n";
  for (const PlotPoint& p : points)
    out += fmt::format("{:.17g} {:.17g} {} {} {} {}\n", p.x, p.y, number(p.low), number(p.high), number(p.left),
                       number(p.right));
  return out + "END_OF_DATA\n";
}

// Collects gnuplot's data blocks and the clauses of its single plot command.
class Writer {
public:
  std::string data;
  std::vector<std::string> parts;

  void add(const PlotSeries& series, double edge) {
    const Look& look = look_of(series);
    std::vector<PlotPoint> full, hollow, out, bars, flat;
    for (const PlotPoint& p : series.points) (p.hollow ? hollow : full).push_back(p);
    for (const PlotPoint& p : series.points) {
      if (p.low && p.high) bars.push_back(p);
      if (p.left && p.right) flat.push_back(p);
    }
    for (double x : series.out) out.push_back({.x = x, .y = edge});
    const std::string paint = fmt::format("lc rgb '{}'", look.colour);
    const bool curve = series.style == PlotSeries::Style::Marked;
    if (series.style == PlotSeries::Style::Back)
      return put(series.points, "w lines lw 9 lc rgb '#d9d9d9'", series.name);
    if (series.style == PlotSeries::Style::Line)
      return put(series.points, fmt::format("w lines lw 1.4 dt {} {}", look.dash, paint), series.name);
    if (!bars.empty()) put(bars, "u 1:2:3:4 w yerrorbars ps 0 lw 1.2 dt solid " + paint, "");
    if (!flat.empty()) put(flat, "u 1:2:5:6 w xerrorbars ps 0 lw 1.2 dt solid " + paint, "");
    if (curve && !series.points.empty())
      put(series.points, fmt::format("w lines lw 2 dt {} {}", look.dash, paint), "");
    if (!full.empty()) put(full, fmt::format("w points pt {} ps mark {}", look.mark, paint), "");
    if (!hollow.empty()) {
      put(hollow, fmt::format("w points pt {} ps mark lc rgb '#ffffff'", look.mark), "");
      put(hollow, fmt::format("w points pt {} ps mark lw 1.5 {}", look.hollow, paint), "");
    }
    if (!out.empty()) put(out, "w points pt 2 ps mark lw 2 " + paint, "");
    if (series.name.empty()) return;
    parts.push_back(fmt::format("keyentry w {} lw 2 dt {} pt {} ps mark {} title {}",
                                curve ? "linespoints" : "points", look.dash, look.mark, paint,
                                quoted(series.name)));
  }

  void put(const std::vector<PlotPoint>& points, const std::string& with, const std::string& name) {
    const std::string block = fmt::format("data{}", count_++);
    data += data_block(block, points);
    parts.push_back(fmt::format("${} {} {}", block, with, name.empty() ? "notitle" : "title " + quoted(name)));
  }

private:
  int count_ = 0;
};

// The upper edge, where points without a y value are marked.
double upper_edge(Range y, bool logarithmic) {
  if (y.low > y.high) return 1;
  return logarithmic ? y.high * std::max(2.5, std::pow(y.high / y.low, 0.07))
                     : y.high + 0.08 * (y.high - y.low);
}

std::string head_of(const Plot& plot, PlotFormat format) {
  const char* fonts = format == PlotFormat::Svg
                          ? "svg size 1000,600 dynamic font 'DejaVu Sans,Arial,sans-serif,15'"
                          : "pngcairo size 1500,900 font 'DejaVu Sans,11' fontscale 1.5";
  std::string out =
      fmt::format("set encoding utf8\nset terminal {} background rgb '#ffffff' linewidth {} enhanced\n", fonts,
                  format == PlotFormat::Svg ? "1" : "1.5");
  // the same size in both formats
  out += fmt::format("mark = {}\n", format == PlotFormat::Svg ? "0.85" : "1.35");
  if (!plot.title.empty()) out += "set title " + quoted(plot.title) + " noenhanced\n";
  out +=
      "set xlabel " + quoted(plot.x_label) + " noenhanced\nset ylabel " + quoted(plot.y_label) +
      " noenhanced\nset border 3 lw 1 lc rgb '#444444'\nset tics nomirror out scale 0.8,0.4 tc rgb '#222222'\n"
      "set grid xtics ytics lt 1 lw 0.7 lc rgb '#e4e4e4'\nset bars 0.6\n"
      "set key outside right top Left reverse noenhanced samplen 2.8 spacing 1.25\n";
  return out;
}

} // namespace

std::string script_of(const Plot& plot, PlotFormat format) {
  Range x, y;
  bool out = false, hollow = false;
  for (const PlotSeries& series : plot.series) {
    for (const PlotPoint& p : series.points) {
      x.take(p.x, plot.log_x);
      y.take(p.y, plot.log_y);
      hollow = hollow || p.hollow;
    }
    for (double at : series.out) x.take(at, plot.log_x);
    out = out || !series.out.empty();
  }
  for (const PlotLevel& level : plot.levels) y.take(level.y, plot.log_y);
  const double edge = upper_edge(y, plot.log_y);
  if (out) y.take(edge, plot.log_y);

  Writer writer;
  for (const PlotSeries& series : plot.series) writer.add(series, edge);
  if (out && !plot.out_name.empty())
    writer.parts.emplace_back("keyentry w points pt 2 ps mark lw 2 lc rgb '#555555' title " +
                              quoted(plot.out_name));
  if (hollow && !plot.hollow_name.empty())
    writer.parts.emplace_back("keyentry w points pt 6 ps mark lw 1.5 lc rgb '#555555' title " +
                              quoted(plot.hollow_name));
  for (const PlotLevel& level : plot.levels)
    writer.parts.push_back(
        fmt::format("{:.17g} w lines lw 1.2 dt (3,3) lc rgb '#777777' title {}", level.y, quoted(level.name)));
  if (writer.parts.empty()) writer.parts.emplace_back("NaN notitle");
  std::string script = head_of(plot, format) + axis_text("x", x, plot.log_x) + axis_text("y", y, plot.log_y) +
                       writer.data + "plot ";
  for (std::size_t n = 0; n < writer.parts.size(); ++n) script += (n == 0 ? "" : ", \\\n  ") + writer.parts[n];
  return script + "\n";
}

std::optional<std::string> draw(const Plot& plot, PlotFormat format) {
  return run_gnuplot(script_of(plot, format));
}

} // namespace rend
