// The options of `rend study`, and the plan made from them.
#pragma once

#include "render/clip/session.h"
#include "sim/study/study.h"

namespace rend {

struct StudyOptions {
  SessionOptions session;          // the preset, --set, --allow-path, --quiet
  std::string folder;              // empty: out/NAME-study
  std::string integrators;         // "a,b"; empty: all
  std::string refine;              // "1,2,4"; empty: the preset's mesh alone
  std::vector<std::string> sweeps; // "PATH=a,b,c"
  int steps = 7;                   // per scheme
  std::optional<double> duration;  // [s]
  int reruns = 7;
  bool quick = false, json = false;
  bool lean = false;                // measure the cost of features instead of errors
  std::vector<std::string> further; // more presets, for `lean`
};
void declare_study(const CommandLine& app, StudyOptions& options);

struct StudyTask {
  std::string name; // of the scene
  std::string text; // of the preset, as it is studied
  StudyPlan plan;
  MakeScene make;
};

// Reads the preset with each group's overrides, so that errors are reported before anything runs. UserError.
StudyTask study_task(const StudyOptions& options);

} // namespace rend
