// The plots of a study.
#pragma once

#include "render/report/plot.h"
#include "sim/study/study.h"

namespace rend {

struct NamedPlot {
  std::string file;    // without its ending
  std::string caption; // what is to be seen
  Plot plot;
};

// Error against run time, error against step, energy; of what tears, its first tear and what is torn. One set
// for each group, and where there are several, all of them together against the most exact one.
std::vector<NamedPlot> plots_of(const StudyReport& report, const std::string& name);

} // namespace rend
