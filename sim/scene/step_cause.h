// What limits the step of a scene, and what would make it longer: the body whose largest stable step is the
// least, and of that body the first of these without which its step would be at least twice as long:
//
//   the scheme         explicit Euler and midpoint need drag to be stable, others do not
//   one damping        of one kind of springs, or the elements' damping-stiffness β: the step 2/(√(ω²+d²)+d)
//                      with d = βω²/2 falls with the square of the cells' size, 2/ω with the size itself
//   all of them
//   drag               viscosity, damping-mass, wind
//   a few elements     a hundredth at most: thin ones (slivers), light ones, stiff ones
//
// and otherwise the stiffness of the interaction that adds most to it: a quarter of it doubles the step. All is
// found by computing the bounds of frequency.h again without the one thing.
#pragma once

#include "sim/scene/element_steps.h"

#include <limits>

namespace rend {

class Scene;

struct StepCause {
  enum class Of { Nothing, Scheme, Damping, Drag, FewElements, Stiffness };
  Of of = Of::Nothing;
  double limit = std::numeric_limits<double>::infinity(); // [s], the largest stable step of the scene
  double gain = 1;   // how many times as long the body's step becomes by the change that `words` states
  std::string words; // "body 'ring': `damping-stiffness` of 0.002 s limits the step; with ..."; empty: Nothing
};

StepCause cause_of_step(const std::vector<ElementSteps>& bodies, const Scheme& scheme);
// Of a scene as it is now, with the damping of its wind; of an adaptive scheme, for symplectic steps.
StepCause cause_of_step(const Scene& scene);

// The first, but Nothing where it is stiffness alone: this costs little then.
StepCause unusual_cause_of_step(const std::vector<ElementSteps>& bodies, const Scheme& scheme);

} // namespace rend
