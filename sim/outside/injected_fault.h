// Faults on purpose, for the check suite: a number that is not finite where a stage of a step has written its
// own.
//
// What a guard is worth shows only where something goes wrong. A fault puts a NaN into what a stage produced
// for the first live vertex of the first body that has such a value (loads: of the first body with loads). It
// happens once, at the first try of its step, or is lasting: at every try of it, however small. Without one, a
// stage pays a branch.
#pragma once

#include "sim/base/record.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace rend {

// Of Scene::step(), in this order.
enum class StepStage { Forces, Loads, Integration, Contact };
const char* name_of(StepStage stage); // "forces"

struct Fault {
  StepStage stage = StepStage::Forces;
  long step = 0; // steps done before the step that goes wrong
  bool lasting = false;
};

// What a body asks after each of its stages.
class FaultySpot {
public:
  void arm(const Fault& fault) { armed_ = fault; }
  void disarm() { armed_.reset(); }
  bool armed(StepStage stage) const { return armed_ && armed_->stage == stage; }

  // Spoils the first live record, and is disarmed unless lasting. `inverse_mass` [1/kg], `values`: one per
  // vertex slot.
  void spoil(const double* inverse_mass, std::size_t count, Record* values);

  // Of loads [N], which others keep: the spoilt ones are a copy.
  const Record* spoil_copy(const double* inverse_mass, std::size_t count, const Record* values);

private:
  std::optional<Fault> armed_;
  std::vector<Record> copy_;
};

} // namespace rend
