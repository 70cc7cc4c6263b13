// What can be wrong with a step, and what the guard did about it (guard.h).
#pragma once

namespace rend {

class Archive;

enum class Trouble {
  None,
  NotFinite, // a number of the state
  Energy,    // there is more than came in
  Passing,   // neighbours pass each other within a step
};

struct GuardFigures {
  long rejected = 0;   // nominal steps that were thrown away
  long redone = 0;     // parts of steps that were made in their place
  long looks = 0;      // at elastic energy
  long accepted = 0;   // growths of energy that no smaller step changes
  int most_parts = 1;  // of a step
  double smallest = 0; // [s], of these parts; 0: none

  void store(Archive& archive); // ArchiveError: no guard counts so
};

} // namespace rend
