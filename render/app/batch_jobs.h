// The jobs of a batch: presets, folders of them, and sweeps, crossed.
//
//   rend batch a.xml --sweep time.step=1e-3,2e-3 --sweep body.stretch.k=10,20     four jobs
//
// A job renders one preset with one choice of values into a folder of its own, called after both.
#pragma once

#include <string>
#include <vector>

namespace rend {

struct Sweep {
  std::string path;
  std::vector<std::string> values;
};

// "PATH=VALUE,VALUE,...": values may hold spaces, and no comma. UserError (Usage).
Sweep parse_sweep(const std::string& text);

struct BatchJob {
  std::string name;              // of its folder, below the batch's; each job has its own
  std::string preset;            // file
  std::vector<std::string> sets; // PATH=VALUE, of the sweeps
};

// One for each preset and each choice of values, the last sweep changing fastest. An input is a file, or a folder whose
// .xml files are taken, also from folders below, in the order of their names. UserError: NoInput where an input is not
// there, or a folder has none.
std::vector<BatchJob> batch_jobs(const std::vector<std::string>& inputs, const std::vector<Sweep>& sweeps);

} // namespace rend
