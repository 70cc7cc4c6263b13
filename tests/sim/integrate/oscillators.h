// A system with a known solution, and one step of a scheme on it.
#pragma once

#include "sim/integrate/integrator.h"

#include <vector>

namespace rend {

// Independent particles of 2 kg: x'' = −ω² x − 2d x', each with its own ω and d.
class Oscillators final : public System {
public:
  struct Mode {
    double omega = 0; // [rad/s]
    double d = 0;     // ξω [1/s], as damping of a spring
    double drag = 0;  // the same, as ambient viscosity
  };

  explicit Oscillators(const std::vector<Mode>& modes)
      : modes_(modes), inverse_masses_(modes.size(), 0.5), drag_rates_(modes.size()) {
    inverse_mass = inverse_masses_.data();
    for (std::size_t n = 0; n < modes.size(); ++n) drag_rates_[n] = 2 * modes[n].drag;
    drag_rate = drag_rates_.data();
    pattern_ = std::make_shared<const BlockPattern>(
        BlockPattern::of(std::vector<std::uint32_t>(modes.size() + 1, 0), {}));
    now.resize(modes.size());
    next.resize(modes.size());
  }

  std::size_t vertices() const override { return modes_.size(); }
  void forces(double, const Record* position, const Record* velocity, Record* force) override {
    ++evaluations;
    for (std::size_t n = 0; n < modes_.size(); ++n) {
      const Mode& m = modes_[n];
      force[n] = Record(-2 * (m.omega * m.omega * position[n].vec() + 2 * m.d * velocity[n].vec()));
    }
  }
  void constrain(double, Record*, Record*) override {}
  std::shared_ptr<const BlockPattern> pattern() override { return pattern_; }
  void add_stiffness(const Record*, const Record*, Tangent, double by_position, double by_velocity,
                     BlockMatrix& out) override {
    for (std::size_t n = 0; n < modes_.size(); ++n) {
      const Mode& m = modes_[n];
      out.add_diagonal(n, 2 * (by_position * m.omega * m.omega + by_velocity * 2 * m.d));
    }
  }

  void step(Integrator& integrator, double time, double size) {
    std::vector<Record> force(modes_.size());
    forces(time, now.position.data(), now.velocity.data(), force.data());
    next.probe = Double4{};
    integrator.advance(*this, time, size, now.view(), force.data(), next);
    std::swap(now, next);
  }

  State now, next;
  int evaluations = 0;

private:
  std::vector<Mode> modes_;
  std::vector<double> inverse_masses_, drag_rates_;
  std::shared_ptr<const BlockPattern> pattern_; // of single vertices
};

} // namespace rend
