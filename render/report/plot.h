// A plot for a report: curves of points on linear or logarithmic axes, drawn by gnuplot.
//
// Data go in by standard input, the picture comes out by standard output; no shell and no file name is
// involved, and no text of a plot is read as a command. The same plot gives the same bytes with the same
// gnuplot. Colours are those of Okabe & Ito ("Color universal design", 2008), which colour-blind readers tell
// apart; marks and dashes tell curves apart in grey as well.
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
    Curve,  // a line, and marks on the points
    Line,   // a thin line alone
    Points, // marks alone
    Back,   // a broad grey line behind all others
  };
  std::string name; // in the legend; empty: not there
  std::vector<PlotPoint> points = {};
  Style style = Style::Curve;
  int look = 0;                 // which colour, mark and dash; the same number looks the same in every plot
  std::vector<double> out = {}; // x of what has no y: crosses at the upper edge
};

// A horizontal line with a name beside it.
struct PlotLevel {
  double y = 0;
  std::string name;
};

struct Plot {
  std::string title, x_label, y_label; // units belong into the labels
  bool log_x = false, log_y = false;
  std::vector<PlotSeries> series;
  std::vector<PlotLevel> levels;
  std::string out_name;    // what the crosses stand for, in the legend
  std::string hollow_name; // what hollow marks stand for, in the legend
};

enum class PlotFormat { Svg, Png };

// The file's bytes. None where gnuplot is not installed. Throws UserError (ReadWrite) with gnuplot's own words
// where it fails. A plot without any point is drawn as empty axes.
std::optional<std::string> draw(const Plot& plot, PlotFormat format);

// What gnuplot is told.
std::string script_of(const Plot& plot, PlotFormat format);

} // namespace rend
