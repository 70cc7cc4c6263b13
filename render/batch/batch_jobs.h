// The jobs of a batch: presets, folders of them, and sweeps, crossed.
//
//   rend batch a.xml --sweep time.step=1e-3,2e-3 --sweep body.mass.total=10,20     four jobs
//
// A job renders one preset with one choice of values into a folder of its own, called after both: the same
// preset with the same values has the same name in every batch, and other values another one.
#pragma once

#include "sim/base/parameters.h"

#include <string>
#include <vector>

namespace rend {

struct Sweep {
  std::string path;
  std::vector<std::string> values;
};

// "PATH=VALUE,VALUE,...": values may hold spaces, and no comma. UserError (Usage).
Sweep parse_sweep(const std::string& text);

// What a batch's command line says of attributes.
struct BatchSettings {
  std::vector<std::string> sets; // PATH=VALUE, in all jobs
  std::vector<Sweep> sweeps;     // crossed
};

// Of its --set and --sweep. "PATH=V,V" of a --set is a sweep, too, but where the attribute is a free text,
// whose commas are its own. All is held against the table `root`, so that a slip is found before any job:
// UserError (Usage, BadInput).
BatchSettings batch_settings(const ElementType& root, const std::vector<std::string>& sets,
                             const std::vector<std::string>& sweeps);

struct BatchJob {
  std::string name;              // of its folder, below the batch's; each job has its own
  std::string preset;            // file
  std::vector<std::string> sets; // PATH=VALUE, of the sweeps
};

// One for each preset and each choice of values, the last sweep changing fastest. An input is a file, or a
// folder whose .xml files are taken, also from folders below, in the order of their names. UserError: NoInput
// where an input is not there, or a folder has none.
std::vector<BatchJob> batch_jobs(const std::vector<std::string>& inputs, const std::vector<Sweep>& sweeps);

} // namespace rend
