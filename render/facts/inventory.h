// What a scene consists of: cells, arrays with their bytes, what limits the time step, the passes of a step,
// and what is left out. Arrays are those after the first step, since some are allocated in it.
#pragma once

#include "render/clip/figures.h"
#include "render/facts/passes.h"
#include "render/facts/rows_are.h"
#include "sim/scene/memory.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rend {

struct TimeFacts {
  std::string integrator;
  int order = 0, evaluations = 0; // evaluations: of the forces, a step
  double step = 0;                // [s]
  bool automatic = false;         // the step; else the preset says it
  std::optional<double> limit;    // [s], the largest step that is stable at rest; none: nothing limits it
  std::string cause;              // of that limit: the body, and what of it; empty: nothing limits it
  double omega = 0;               // [rad/s], of the highest frequency at rest
  double damping_rate = 0;        // [1/s], the largest of all modes
  double duration = 0, fps = 0;   // [s], [1/s]
  long steps = 0, frames = 0;
  // [s], of the clip; none: it plays in real time, and is as long as the simulation
  std::optional<double> clip_duration = {};
};

struct SlotFacts {
  Orbit orbit;
  std::size_t slots = 0, bytes = 0;
};
struct EmbeddingFacts {
  std::string name;
  Orbit orbit;
  std::size_t bytes = 0;
};
struct InteractionFacts {
  std::string name;
  RowsAre rows_are = RowsAre::Single;
  Orbit owner;
  std::size_t rows = 0, bytes = 0;
};
struct LawFacts {
  std::string criterion, what;
  double threshold = 0;
  std::string unit, change;
  std::size_t bytes = 0;
};

// [byte]
struct BytesByPart {
  std::vector<std::pair<std::string, std::size_t>> parts; // those that have some, as footprint_parts() has them
  std::size_t total = 0;
};

struct BodyFacts {
  std::string name;
  int dimension = 2; // of a sheet; 3: of a solid
  std::vector<AppliedRule> applied; // while it was constructed, in their order
  // Before the first step.
  std::size_t vertices = 0, edges = 0, elements = 0, darts = 0, fragments = 0;
  long euler = 0;             // characteristic
  std::size_t prescribed = 0; // vertices
  // After it.
  std::vector<SlotFacts> slots;
  std::vector<EmbeddingFacts> embeddings;
  std::vector<InteractionFacts> interactions;
  std::vector<LawFacts> laws;
  std::vector<MemoryEntry> arrays;
  BytesByPart bytes;
  std::vector<std::string> left_out, notes;
  std::optional<SolvingFigures> solver; // of the first step; none: the scheme does not solve
};

struct Inventory {
  std::string preset, name;
  std::optional<std::string> thesis; // where the scene stands in it
  TimeFacts time;
  std::optional<std::string> first_step; // why it could not be made; none: it was
  std::vector<MemoryEntry> arrays;       // besides those of bodies
  std::vector<BodyFacts> bodies;
  BytesByPart bytes; // of all
  std::vector<Pass> step;
  std::vector<std::string> left_out; // of all bodies together
};

Inventory inventory_of(Session& session); // makes the first step

nlohmann::ordered_json json_of(const Inventory& inventory);
std::string inventory_in_words(const Inventory& inventory); // at most 100 columns

} // namespace rend
