// Plots: the script for gnuplot, and the pictures that gnuplot makes from it.
#include "render/report/gnuplot.h"
#include "render/report/plot.h"
#include "sim/base/check.h"
#include "sim/base/error.h"

#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

namespace rend::plot_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

Plot example() {
  Plot plot;
  plot.title = "Error against run time";
  plot.x_label = "run time [s]";
  plot.y_label = "error of position, relative";
  plot.log_x = plot.log_y = true;
  PlotSeries front{"Pareto front", {}, PlotSeries::Style::Back, 0, {}};
  for (int scheme = 0; scheme < 4; ++scheme) {
    PlotSeries series{"scheme " + std::to_string(scheme + 1), {}, PlotSeries::Style::Marked, scheme, {}};
    for (int n = 0; n < 8; ++n) {
      const double t = 1e-3 * std::pow(2, n) * (1 + scheme);
      series.points.push_back({t, std::pow(t, -1 - scheme) * 1e-6, {}, {}, 0.8 * t, 1.3 * t, n == 7});
    }
    series.out = {5e-4 * (1 + scheme)};
    front.points.push_back(series.points[2]);
    plot.series.push_back(series);
  }
  plot.series.insert(plot.series.begin(), front);
  plot.levels = {{1e-9, "error bar of the reference"}};
  plot.out_name = "failed";
  plot.hollow_name = "within the reference's error";
  return plot;
}

bool gnuplot_is_there() {
  return draw(Plot{}, PlotFormat::Svg).has_value();
}

TEST(Plot, is_drawn_as_svg_and_as_png_the_same_bytes_each_time) {
  if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  const std::string svg = *draw(example(), PlotFormat::Svg), png = *draw(example(), PlotFormat::Png);
  EXPECT_THAT(svg, StartsWith("<?xml"));
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(png, StartsWith("\x89PNG"));
  EXPECT_EQ(svg, *draw(example(), PlotFormat::Svg));
  EXPECT_EQ(png, *draw(example(), PlotFormat::Png));
  if (const char* folder = std::getenv("REND_LOOK")) { // set REND_LOOK to keep the pictures for inspection
    std::fwrite(png.data(), 1, png.size(), std::fopen((std::string(folder) + "/plot.png").c_str(), "wb"));
  }
}

TEST(Plot, takes_every_text_as_a_text) {
  Plot plot = example();
  plot.title = "it's `date` \"$(date)\" x_1^2 {a}\n; system 'false'";
  plot.series[1].name = "'; exit 3; '";
  plot.x_label = "50 % \\";
  const std::string script = script_of(plot, PlotFormat::Svg);
  EXPECT_THAT(script, HasSubstr("set title 'it’s ’date’ \"$(date)\" x_1^2 {a}\\n; system ’false’' no"));
  if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  EXPECT_THAT(*draw(plot, PlotFormat::Svg), HasSubstr("exit 3"));
}

TEST(Plot, says_every_number_to_the_last_digit_and_where_nothing_is_empty_axes) {
  Plot plot;
  plot.series = {{"one", {{0.1, 1.0 / 3, 0.25, 0.5, {}, {}, false}}, PlotSeries::Style::Points, 0, {}}};
  EXPECT_THAT(script_of(plot, PlotFormat::Svg),
              HasSubstr("0.10000000000000001 0.33333333333333331 0.25 0.5 NaN NaN"));
  plot.series.clear();
  plot.log_x = plot.log_y = true;
  EXPECT_THAT(script_of(plot, PlotFormat::Png), HasSubstr("plot NaN notitle\n"));
}

TEST(Plot, refuses_what_has_no_place_on_its_axes) {
  Plot plot = example();
  plot.series[1].points[0].y = 0;
  EXPECT_THROW(script_of(plot, PlotFormat::Svg), InternalError);
  plot.log_y = false;
  EXPECT_NO_THROW(script_of(plot, PlotFormat::Svg));
  plot.series[1].points[0].y = std::nan("");
  EXPECT_THROW(script_of(plot, PlotFormat::Svg), InternalError);
}

TEST(Plot, crosses_stand_above_all_points) {
  const std::string script = script_of(example(), PlotFormat::Svg);
  EXPECT_THAT(script, HasSubstr("title 'failed'"));
  Plot plot = example();
  for (PlotSeries& series : plot.series) series.out.clear();
  EXPECT_THAT(script_of(plot, PlotFormat::Svg), Not(HasSubstr("failed")));
}

TEST(Gnuplot, says_what_it_does_not_understand) {
  if (!gnuplot_is_there()) GTEST_SKIP() << "gnuplot is not installed";
  try {
    run_gnuplot("set terminal svg\nplot nonsense(\n");
    FAIL() << "no error";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::ReadWrite);
    EXPECT_THAT(error.what(), HasSubstr("gnuplot could not draw"));
  }
}

} // namespace
} // namespace rend::plot_test
