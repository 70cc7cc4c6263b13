// Fault injection, for the check suite: a NaN in the output of one stage of a step.
//
// A guard can only be tested when something goes wrong. A fault puts a NaN into the output of a stage, for the
// first live vertex of the first body that has such a value (loads: of the first body with loads). It occurs
// once, at the first attempt of its step, or is lasting: at every attempt, however small. Without a fault, a
// stage costs one branch.
#pragma once

#include "sim/base/record.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace rend {

// The stages of Scene::step(), in order.
enum class StepStage { Forces, Loads, Integration, Contact };
const char* name_of(StepStage stage); // "forces"

struct Fault {
  StepStage stage = StepStage::Forces;
  long step = 0; // number of steps before the one with the fault
  bool lasting = false;
};

// The fault state of a body, tested after each of its stages.
class FaultInjector {
public:
  void arm(const Fault& fault) { armed_ = fault; }
  void disarm() { armed_.reset(); }
  bool armed(StepStage stage) const { return armed_ && armed_->stage == stage; }

  // Puts a NaN into the first live record, and is disarmed unless lasting. `inverse_mass` [1/kg], `values`: one
  // per vertex slot.
  void inject(const double* inverse_mass, std::size_t count, Record* values);

  // For loads [N], which are owned by others: returns a copy with the NaN.
  const Record* inject_copy(const double* inverse_mass, std::size_t count, const Record* values);

private:
  std::optional<Fault> armed_;
  std::vector<Record> copy_;
};

} // namespace rend
