// A plot for a report: curves of points on linear or logarithmic axes, drawn by gnuplot.
//
// Data go in by standard input, the picture comes out by standard output; neither a shell nor file names are
// involved, and text of a plot is never interpreted as a command. The same plot gives the same bytes with the
// same gnuplot. Colours are those of Okabe & Ito ("Color universal design", 2008), distinguishable for
// colour-blind readers; marks and dashes distinguish curves in grey as well.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace rend {

struct PlotPoint {
  double x = 0, y = 0;                         // finite, and above 0 on a logarithmic axis (CHECK)
  std::optional<double> low = {}, high = {};   // error bar in y; both or none
  std::optional<double> left = {}, right = {}; // error bar in x; both or none
  bool hollow = false;                         // drawn as an outline: there, but not to be relied upon
};

struct PlotSeries {
  enum class Style {
    Marked, // a line with marks
    Line,   // a thin line without marks
    Points, // marks without a line
    Back,   // a broad grey line behind the others
  };
  std::string name; // in the legend; empty: not there
  std::vector<PlotPoint> points = {};
  Style style = Style::Marked;
  int style_number = 0;         // which colour, mark and dash; the same number looks the same in every plot
  std::vector<double> out = {}; // x of what has no y: crosses at the upper edge
};

// A horizontal line with a label.
struct PlotLevel {
  double y = 0;
  std::string name;
};

struct Plot {
  std::string title, x_label, y_label; // labels should contain units
  bool log_x = false, log_y = false;
  std::vector<PlotSeries> series;
  std::vector<PlotLevel> levels;
  std::string out_name;    // legend entry of the crosses
  std::string hollow_name; // legend entry of hollow marks
};

enum class PlotFormat { Svg, Png };

// The file's bytes. None if gnuplot is not installed. Throws UserError (ReadWrite) with gnuplot's message if it
// fails. A plot without points gives empty axes.
std::optional<std::string> draw(const Plot& plot, PlotFormat format);

// The gnuplot script.
std::string script_of(const Plot& plot, PlotFormat format);

} // namespace rend
