// A case of `rend check`: a scene that strains the program, what is expected of it, and what happened.
//
// A case is a preset, read by the same reader as a user's, and a function that runs it and takes measures. An
// expectation is said in words and asked in numbers: every Measure is a figure with the bounds between which it
// must lie, from an analytic answer, a law of conservation, a bound by energy, or another computation.
// Verdicts:
//
//   ok        all measures lie within their bounds
//   refused   as expected: the preset is not accepted, and the message says where and what would work
//   limit     a known limit of the model, true and stated; its measures (that it stays finite, say) hold
//   failed    a measure does not hold, or something was thrown that was not expected
//
// States that no preset can express (scrambled vertices) are set on the scene by the function, and
// `expectation` says so. Adding a family: a file with a function `CheckFamily my_family()`, and its name in
// all_families().
#pragma once

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
  bool holds() const { return got >= low && got <= high; } // NaN never does
};

struct Finding {
  Verdict verdict = Verdict::Ok;
  std::vector<Measure> measures;
  std::string what; // what happened, a sentence; may be empty: the measures say it
  std::string why;  // of a refusal: what would work; of a known limit: its reason; of a failure: where

  void within(std::string measure, double got, double low, double high);
  void at_most(std::string measure, double got, double high);
  void at_least(std::string measure, double got, double low);
  void near(std::string measure, double got, double known, double error); // |got − known| ≤ error
  void limit(std::string what_happens, std::string reason);
  bool holds() const; // all measures do
};

// A scene, and the nodes that it reads from for as long as it lives.
struct Trial {
  std::unique_ptr<PresetNode> preset;
  std::unique_ptr<Scene> scene;
  Scene* operator->() const { return scene.get(); }
  Body& body(std::size_t n = 0) const { return *scene->bodies()[n]; }
};

// What a scene does by itself, with nothing that rescues a step.
inline SceneOptions unguarded() {
  SceneOptions options;
  options.guard = false;
  return options;
}

using Sets = std::vector<std::pair<std::string, std::string>>; // as --set PATH=VALUE

struct CheckCase;
// Reads a case's preset as a user's file, or another text in its place. Throws UserError.
using ReadPreset =
    std::function<std::unique_ptr<PresetNode>(const CheckCase&, const std::string* instead, const Sets&)>;

// What a case runs with.
class Bench {
public:
  Bench(const CheckCase& which, const ReadPreset& read) : case_(&which), read_(&read) {}
  // Throws UserError for what is refused.
  Trial open(const Sets& sets = {}, SceneOptions options = {}) const;
  Trial open_text(const std::string& preset) const; // another than the case's, to compare with

private:
  const CheckCase* case_;
  const ReadPreset* read_;
};

struct CheckCase {
  std::string name;        // unique: "stiffness/chain/rk4/1e12"
  std::string expectation; // a sentence
  std::string preset;      // XML; empty: the file `path`
  std::function<void(const Bench&, Finding&)> run;
  std::string row, column;                                     // of the family's table
  bool quick = false;                                          // of the few that the tests run
  std::vector<std::pair<std::string, std::string>> files = {}; // name and content, beside the preset (meshes)
  std::string path = {};                                       // of a user's preset
};

struct CheckFamily {
  std::string name;  // "stiffness"
  std::string title; // a heading
  std::string about; // sentences: what is varied, and what it is held against
  std::vector<CheckCase> (*cases)();
};
const std::vector<CheckFamily>& all_families();

struct CheckResult {
  Finding finding;
  double seconds = 0;
};
// Runs a case; what it throws becomes a finding.
CheckResult run_case(const CheckCase& which, const ReadPreset& read);

} // namespace rend
