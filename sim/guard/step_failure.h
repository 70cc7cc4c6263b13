// What can be wrong with a step, and statistics of the guard (guard.h).
#pragma once

namespace rend {

class Archive;

enum class StepFailure {
  None,
  NotFinite,   // a number of the state
  Energy,      // more energy than the work done allows
  PassThrough, // neighbours pass through each other within a step
};

struct GuardFigures {
  long rejected = 0;     // nominal steps that were discarded
  long redone = 0;       // substeps made instead
  long energy_tests = 0; // evaluations of elastic energy
  long accepted = 0;     // growths of energy that smaller steps do not change
  int most_substeps = 1; // substeps of a step
  double smallest = 0;   // [s], substep; 0: none

  void store(Archive& archive); // ArchiveError: impossible values
};

} // namespace rend
