#include "sim/study/minimal_loop.h"

#include "sim/base/check.h"

namespace rend {

// A body for a time scheme.
struct MinimalLoop::MinimalBody final : System {
  Body* body;
  std::unique_ptr<Integrator> integrator;
  std::vector<Record> force; // [N], one per vertex slot
  State next;

  MinimalBody(Body& of, const Scheme& scheme) : body(&of), integrator(scheme.make({})) {
    const Program& program = *of.program;
    inverse_mass = program.inverse_mass();
    drag_rate = program.drag_rate();
    uniform_drag = of.uniform_drag;
    gravity = of.gravity;
    force.resize(vertices());
  }
  std::size_t vertices() const override { return body->program->vertices(); }
  int parts() const override { return body->program->parts(); }
  void forces(double, const Record* position, const Record* velocity, Record* out) override {
    body->program->forces(position, velocity, out);
  }
  void constrain(double time, Record* position, Record* velocity) override {
    if (!body->constraints.vertices().empty()) body->constraints.apply(*body->map, time, position, velocity);
  }

  void step(double time, double size) {
    auto &position = body->map->position().values(), &velocity = body->map->velocity().values();
    forces(time, position.data(), velocity.data(), force.data());
    next.resize(vertices());
    next.probe = Double4{};
    integrator->advance(*this, time, size, {position.data(), velocity.data()}, force.data(), next);
    position.swap(next.position);
    velocity.swap(next.velocity);
  }
};

std::string beyond_minimal(const Scene& scene) {
  if (scene.scheme().solves) return "a scheme that solves";
  if (scene.scheme().adaptive) return "an adaptive scheme";
  if (scene.contacts()) return "contact";
  for (const auto& body : scene.bodies()) {
    if (body->tears()) return "a law";
    if (!body->loads.empty()) return "a load";
    if (body->floor_contact) return "contact";
    if (!body->answers.empty()) return "an answer";
  }
  return {};
}

MinimalLoop::MinimalLoop(Scene& scene) : scene_(&scene), steps_(scene.steps_done()) {
  CHECK(beyond_minimal(scene).empty());
  for (const auto& body : scene.bodies())
    bodies_.push_back(std::make_unique<MinimalBody>(*body, scene.scheme()));
}

MinimalLoop::~MinimalLoop() = default;

void MinimalLoop::step() {
  const double size = scene_->step_size(), time = static_cast<double>(steps_) * size;
  for (auto& body : bodies_) body->step(time, size);
  ++steps_;
}

} // namespace rend
