// The jobs of a batch: presets, folders of them, and sweeps, combined as a Cartesian product.
//
//   rend batch a.xml --sweep time.step=1e-3,2e-3 --sweep body.mass.total=10,20     four jobs
//
// A job renders one preset with one choice of values into a folder of its own, named after both: the same
// preset with the same values has the same name in every batch, and other values give another name.
#pragma once

#include "sim/base/parameters.h"

#include <string>
#include <vector>

namespace rend {

struct Sweep {
  std::string path;
  std::vector<std::string> values;
};

// "PATH=VALUE,VALUE,...": values may hold spaces, and no comma; FROM:TO and FROM:TO:STEP are ranges of numbers.
// UserError (Usage).
Sweep parse_sweep(const std::string& text, std::string_view option = "--set");

// The attributes that a batch's command line sets.
struct BatchSettings {
  std::vector<std::string> sets; // PATH=VALUE, in all jobs
  std::vector<Sweep> sweeps;     // combined as a Cartesian product
};

// From --set and --sweep. "PATH=V,V" of a --set is a sweep as well, unless the attribute is free text, which
// may contain commas. Everything is checked against the parameter table `root`, so that a mistake is found
// before any job starts: UserError (Usage, BadInput).
BatchSettings batch_settings(const ElementType& root, const std::vector<std::string>& sets,
                             const std::vector<std::string>& sweeps);

struct BatchJob {
  std::string name;              // of its folder below the batch's; unique
  std::string preset;            // path of its file
  std::vector<std::string> sets; // PATH=VALUE, one for each sweep
};

// One job for each preset and each choice of values; the last sweep varies fastest. An input is a file or a
// folder whose .xml files are taken recursively, sorted by name. UserError (NoInput) where an input does not
// exist, or a folder contains no preset.
std::vector<BatchJob> batch_jobs(const std::vector<std::string>& inputs, const std::vector<Sweep>& sweeps);

} // namespace rend
