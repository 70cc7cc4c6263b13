// Generalised-α (Chung and Hulbert, "A time integration algorithm for structural dynamics with improved
// numerical dissipation", 1993): Newmark's method, with the equation of motion of weighted means,
//
//   (1 − α_m) a' + α_m a = (1 − α_f) A(x', v') + α_f A(x, v)            A: acceleration by the forces
//   x' = x + h v + h² ((½ − β) a + β a'),      v' = v + h ((1 − γ) a + γ a')
//
//   α_m = (2ρ − 1)/(ρ + 1),   α_f = ρ/(ρ + 1),   γ = ½ − α_m + α_f,   β = ¼ (1 − α_m + α_f)²
//
// Order 2. The parameter ρ (rho-infinity) is what a step leaves of motion that is too fast for it: 1 keeps the
// energy of linear systems, 0 damps such motion in a step or two. Slow motion is damped as little as such a
// method can. That no step is too large is proved for linear forces only (Erlicher, Bonaventura and Bursi, "The
// analysis of the generalized-α method for non-linear dynamic problems", 2002): slack cloth of 20 × 20 crossed
// cells, in steps of 10 ms, gains energy in its wrinkles with ρ = 0.8, and none with 0.5, the default.
//
// Forces are weighted at both ends of the step, and not evaluated in between, so that those that the laws of
// fracture have looked at serve.
//
// The scheme hands on an acceleration a, which is not that of the forces: it follows them with a delay. It is
// an embedding of vertices (VertexAcceleration), is part of checkpoints, and goes back with the guard. Where
// there is none (at the start, around a change of the map), and along coordinates that were prescribed, it is
// that of the forces, A(x, v). Contact changes velocities after the step, and leaves it as it is.
//
// One stage (stage_scheme.h): eliminating a' gives p = βh/γ, q = (1 − α_f) γh/(1 − α_m), and
//
//   y = x + h v + h² (½ − β) a − p (v + h (1 − γ) a),
//   w = v + h (1 − γ) a + γh/(1 − α_m) (α_f A(x, v) − α_m a)
#include "sim/integrate/stage_scheme.h"

namespace rend {
namespace {

struct AlphaWeights {
  double m, f, gamma, beta;
  explicit AlphaWeights(double rho) {
    m = (2 * rho - 1) / (rho + 1);
    f = rho / (rho + 1);
    gamma = 0.5 - m + f;
    beta = 0.25 * (1 - m + f) * (1 - m + f);
  }
};

class GeneralisedAlpha final : public StageScheme {
public:
  explicit GeneralisedAlpha(const SchemeSettings& settings)
      : StageScheme(second_order_rules), weights_(settings.rho_infinity) {}

  void advance(System& system, double time, double step, const StateView& now, const Record* force,
               State& next) override {
    const std::size_t count = system.vertices();
    acceleration_.assign(count, Record{});
    if (now.acceleration) acceleration_.assign(now.acceleration, now.acceleration + count);
    StageScheme::advance(system, time, step, now, force, next);
    next.accelerates = true;
    next.acceleration = acceleration_;
  }
  std::size_t bytes() const override {
    return StageScheme::bytes() + bytes_of(held_at_start_) +
           bytes_with({&base_position_, &base_velocity_, &acceleration_});
  }

private:
  bool begins_with_forces() const override { return true; }
  void begin_acceleration(const Part& part);
  void make_part(const Part& part) override;

  AlphaWeights weights_;

  // One per vertex slot.
  Records base_position_, base_velocity_;   // [m], [m/s]: y and w
  Records acceleration_;                    // [m/s²], a at the start of the part
  std::vector<std::uint8_t> held_at_start_; // axes
};

// Where a is not known, or was that of a prescribed coordinate, it is A.
void GeneralisedAlpha::begin_acceleration(const Part& part) {
  hold(part.system, part.start, held_at_start_);
  for (std::size_t i = 0; i < acceleration_.size(); ++i) {
    const Record& a = acceleration_[i];
    const bool known = a.x != 0 || a.y != 0 || a.z != 0;
    const Double4 kept = known ? free_axes(held_at_start_[i]) : Double4{};
    const Double4 made = Double4{1, 1, 1, 0} - kept;
    store(acceleration_[i], kept * load(a) + made * load(start_acceleration_[i]));
  }
}

void GeneralisedAlpha::make_part(const Part& part) {
  const auto [m, f, gamma, beta] = weights_;
  const double h = part.size, p = beta * h / gamma, share = gamma * h / (1 - m);
  const std::size_t count = part.system.vertices();
  begin_acceleration(part);
  base_position_.resize(count);
  base_velocity_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Double4 x = load(part.from.position[i]), v = load(part.from.velocity[i]);
    const Double4 a = load(acceleration_[i]), by_forces = load(start_acceleration_[i]);
    const Double4 ahead = v + splat(h * (1 - gamma)) * a;
    store(base_position_[i], x + splat(h) * v + splat(h * h * (0.5 - beta)) * a - splat(p) * ahead);
    store(base_velocity_[i], ahead + splat(share) * (splat(f) * by_forces - splat(m) * a));
  }
  solve({part.system, part.end, p, share * (1 - f), base_position_.data(), base_velocity_.data()});
  for (std::size_t i = 0; i < count; ++i) {
    const Double4 ahead = load(part.from.velocity[i]) + splat(h * (1 - gamma)) * load(acceleration_[i]);
    const bool there = part.system.inverse_mass[i] != 0;
    store(acceleration_[i], there ? splat(1 / (gamma * h)) * (load(velocity_[i]) - ahead) : Double4{});
  }
}

} // namespace

Scheme generalised_alpha() {
  return {.name = "alpha",
          .what = "generalised-alpha (Chung and Hulbert), one implicit stage: order 2, stable with every step; "
                  "rho-infinity chooses how much of what is too fast for the step goes",
          .order = 2,
          .evaluations = 2,
          .limit = &no_limit,
          .make = [](const SchemeSettings& settings) -> std::unique_ptr<Integrator> {
            return std::make_unique<GeneralisedAlpha>(settings);
          },
          .solves = true,
          .hands_on_acceleration = true,
          .takes_rho_infinity = true};
}

} // namespace rend
