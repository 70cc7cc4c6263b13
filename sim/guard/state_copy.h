// Copies of the state of a scene within one topology, and of what is measured up to it: for a stretch of steps
// that may be repeated (rollback.h), and for states that are shown once it is certain that they are of the run
// (sim/scene/kept_state.h).
#pragma once

#include "sim/body/body.h"
#include "sim/outside/world.h"

#include <memory>
#include <optional>
#include <vector>

namespace rend {

struct BodyCopy {
  State state;
  double time = 0, last_step = 0;       // [s]; the step that led to it
  std::optional<WorkMeter> meter;       // none: nothing does work on the body
  std::vector<Reached> reached;         // one per law
  void copy_measures(const Body& body); // the time, the meter, and what laws have reached
  void restore_measures(Body& body) const;
  void copy(const Body& body); // of a state that is shown: all of it
  void exchange(Body& body);   // the body has what the copy had, and the reverse
  std::size_t bytes() const { return state.bytes() + (meter ? meter->bytes() : 0); }
  void store(Archive& archive, std::size_t most); // of at most `most` vertices
};

struct SphereCopy {
  Vec3 centre, velocity; // [m], [m/s]
  ContactWork contact_work;
  double gravity_work = 0; // [J]
  void copy(const Sphere& sphere);
  void restore(Sphere& sphere) const;
  void store(Archive& archive);
};

// Of all bodies and spheres.
struct StateCopy {
  using Bodies = std::vector<std::unique_ptr<Body>>;
  std::vector<BodyCopy> bodies;
  std::vector<SphereCopy> spheres;
  void copy(const World& world, const Bodies& bodies);
  void exchange(World& world, const Bodies& bodies);
  std::size_t bytes() const;
};

} // namespace rend
