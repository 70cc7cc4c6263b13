// The page of a study: its findings as generated sentences; plots, tables, provenance.
#pragma once

#include "render/pages/provenance.h"
#include "sim/study/study.h"

#include <string>
#include <vector>

namespace rend {

// A plot as it goes into the page.
struct DrawnPlot {
  std::string svg; // content of an SVG file; empty: it could not be drawn
  std::string caption;
};

// Sentences, the most important first: which scheme reaches a target error fastest, orders of convergence,
// failures, the reference.
std::vector<std::string> findings_of(const StudyReport& report);

std::string page_of(const StudyReport& report, const std::string& name, const std::vector<DrawnPlot>& plots,
                    const Provenance& provenance);

} // namespace rend
