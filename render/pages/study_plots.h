// The plots of a study.
#pragma once

#include "render/report/plot.h"
#include "sim/study/study.h"

namespace rend {

struct NamedPlot {
  std::string file;    // without its extension
  std::string caption; // description of the plot
  Plot plot;
};

// Error against run time, error against step size, energy; for bodies that tear, the time of the first tear and
// what has torn. One set for each group; with several groups, also all of them together against the most exact
// one.
std::vector<NamedPlot> plots_of(const StudyReport& report, const std::string& name);

} // namespace rend
