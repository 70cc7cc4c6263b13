// A case of `rend check`: a scene that stresses the program, the expected behaviour, and the result.
//
// A case is a preset, read like a user's, and a function that runs it and takes measures. An expectation is
// stated in words and tested by numbers: every Measure is a value with bounds, from an analytic solution, a
// conservation law, an energy bound, or another computation. Verdicts:
//
//   ok        all measures are within their bounds
//   refused   as expected: the preset is not accepted, and the message has a place and a hint
//   limit     a known limitation of the model, documented; its measures (it stays finite, say) are in bounds
//   failed    a measure is out of bounds, or an unexpected exception was thrown
//
// States that no preset can express (scrambled vertices) are set on the scene by the function, as stated in
// `expectation`. To add a family: a file with a function `CheckFamily my_family()`, and its name in
// all_families().
#pragma once

#include "sim/build/build_scene.h"
#include "sim/scene/scene.h"

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rend {

enum class Verdict { Ok, Refused, Limit, Failed };
const char* name_of(Verdict verdict); // "ok", "refused", "known limit", "failed"

struct Measure {
  std::string what; // with its unit
  double got = 0;
  double low = -std::numeric_limits<double>::infinity(), high = std::numeric_limits<double>::infinity();
  bool holds() const { return got >= low && got <= high; } // false for NaN
};

struct Finding {
  Verdict verdict = Verdict::Ok;
  std::vector<Measure> measures;
  std::string what; // a sentence on what happened; may be empty if the measures say it
  std::string why;  // of a refusal: the hint; of a known limitation: its reason; of a failure: where

  void within(std::string measure, double got, double low, double high);
  void at_most(std::string measure, double got, double high);
  void at_least(std::string measure, double got, double low);
  void near(std::string measure, double got, double known, double error); // |got − known| ≤ error
  void limit(std::string what_happens, std::string reason);
  bool holds() const; // all measures do
};

// A scene with the preset that it refers to.
struct Trial {
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
  Scene* operator->() const { return scene.get(); }
  Body& body(std::size_t n = 0) const { return *scene->bodies()[n]; }
};

// Without a guard that redoes steps.
inline SceneOptions unguarded() {
  SceneOptions options;
  options.guard = false;
  return options;
}

using Sets = std::vector<std::pair<std::string, std::string>>; // as --set PATH=VALUE

struct CheckCase;
// Reads the preset of a case as a user's file, or `instead`, another text. Throws UserError.
using ReadPreset =
    std::function<std::unique_ptr<PresetNode>(const CheckCase&, const std::string* instead, const Sets&)>;

// Opens the scenes of a case.
class Bench {
public:
  Bench(const CheckCase& which, const ReadPreset& read, const ScenePictures& pictures)
      : case_(&which), read_(&read), pictures_(&pictures) {}
  // Throws UserError if the preset is refused.
  Trial open(const Sets& sets = {}, SceneOptions options = {}) const;
  Trial open_text(const std::string& preset) const; // another preset than the case's, for comparison

private:
  const CheckCase* case_;
  const ReadPreset* read_;
  const ScenePictures* pictures_;
};

struct CheckCase {
  std::string name;        // unique: "stiffness/chain/rk4/1e12"
  std::string expectation; // a sentence
  std::string preset;      // XML; empty: in the file `path`
  std::function<void(const Bench&, Finding&)> run;
  std::string row, column;                                     // of the family's table
  bool quick = false;                                          // part of the selection that the tests run
  std::vector<std::pair<std::string, std::string>> files = {}; // name and content, beside the preset (meshes)
  std::string path = {};                                       // of a user's preset
};

struct CheckFamily {
  std::string name;  // "stiffness"
  std::string title; // a heading
  std::string about; // sentences: what is varied, and what it is compared with
  std::vector<CheckCase> (*cases)();
};
const std::vector<CheckFamily>& all_families();

struct CheckResult {
  Finding finding;
  double seconds = 0;
};
// Runs a case; an exception becomes a finding.
CheckResult run_case(const CheckCase& which, const ReadPreset& read, const ScenePictures& pictures = {});

} // namespace rend
