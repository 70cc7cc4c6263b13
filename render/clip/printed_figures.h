// What `rend batch` takes from the figures that `rend render --json` or `rend run --json` printed in another
// process (figures.h). A run has no pictures: made and kept are 0.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace rend {

// Pictures of a run that makes some.
struct PictureFigures {
  long made = 0, kept = 0;
};

// `steps` to `hash`: none where nothing was simulated.
struct PrintedFigures {
  PictureFigures pictures;
  std::optional<long> steps;
  std::optional<double> time; // [s]
  std::optional<std::size_t> tears;
  std::optional<std::string> hash; // 16 hexadecimal digits
};
std::optional<PrintedFigures> read_figures(const std::string& text); // none: these are no such figures

} // namespace rend
