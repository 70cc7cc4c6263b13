#include "sim/guard/guard.h"

#include "sim/base/archive.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace rend {
namespace {

constexpr double factor = 2; // allowed ratio of energies, and of S within the last steps
constexpr long period = Rollback::longest;
constexpr long exact_period = 4096; // steps between reductions of B
// steps between tests of neighbours, unless speeds alone rule out that they pass each other
constexpr long passing_period = 32;
constexpr long memory = 8;            // steps whose motion S is compared with, and at most twice as many
constexpr double more = 1.25;         // growth of K before U is tested again
constexpr double least_motion = 1e-6; // rest lengths per step: slower motion is no explosion
constexpr long longest_hold = 4096;   // steps
// relative change of a growth under half the step, below which it is not caused by the step
constexpr double same = 0.1;
// relative to the budget: energy accepted after a repetition, unless still smaller substeps give the same
constexpr double close = 1.25;

bool is_substep_count(int substeps) {
  return substeps >= 1 && substeps <= Guard::most_substeps;
}

} // namespace

Guard::Guard(World& world, const Rollback::Bodies& bodies, const Scheme& scheme, double step, bool on,
             Profile* profile)
    : bodies_(bodies), profile_(profile), step_(step), energy_(on && !scheme.solves && !scheme.adaptive) {
  if (!on) return;
  rollback_.emplace(world, bodies, step);
  rollback_->reserve_for_separations();
  if (!energy_) return;
  least_rest_ = std::numeric_limits<double>::infinity();
  for (const auto& body : bodies) least_rest_ = std::min(least_rest_, least_rest_length(*body));
}

int Guard::substeps(long step) const {
  return redoing_ && step >= from_ && step < goal_ ? substeps_ : planned_substeps(step);
}

bool Guard::needs_forces() const {
  return rollback_ && (!energy_ || begins_ || budget_ < 0 || !rollback_->fits());
}

void Guard::before_laws(long step) {
  const PhaseScope within(profile_, Phase::Guard);
  if (rollback_ && !rollback_->fits()) discard_start();
  if (energy_ && budget_ < 0) {
    begins_ = true;
    rollback_->begin(step);
    const Rollback::Account account = rollback_->account();
    const double energy = test_energy(account).energy;
    budget_ = std::isfinite(energy) ? energy : std::numeric_limits<double>::infinity();
    heaviest_ = account.heaviest;
    watch_.lately = watch_.before = account.squared_speeds;
    settled_ = exactly_ = step;
  }
}

StepFailure Guard::before_change(long step) {
  const PhaseScope within(profile_, Phase::Guard);
  if (!energy_) return StepFailure::None;
  const StepFailure failure = update_budget(step, Look::AsNeeded);
  if (failure == StepFailure::None) begins_ = true;
  return failure;
}

void Guard::after_laws(long step) {
  const PhaseScope within(profile_, Phase::Guard);
  if (!rollback_ || !(begins_ || !energy_)) return;
  rollback_->begin(step);
  watch_.threshold = threshold();
  watch_at_start_ = watch_;
  begins_ = false;
  start_.reset();
  growth_.reset();
}

void Guard::divide_steps(int least) {
  least_substeps_ = std::min(least, most_substeps);
  figures_.most_substeps = std::max(figures_.most_substeps, least_substeps_);
}

StepFailure Guard::end_stretch(long done) {
  if (settled() || redoing_ || done == rollback_->first()) return StepFailure::None;
  const PhaseScope within(profile_, Phase::Guard);
  const StepFailure failure = update_budget(done, Look::AsNeeded);
  if (failure == StepFailure::None) begins_ = true;
  return failure;
}

StepFailure Guard::update_budget(long step, Look look) {
  if (settled_ == step) return StepFailure::None;
  const Rollback::Account account = rollback_->account();
  if (may_pass_through() && pass_through(substeps(step))) return StepFailure::PassThrough;
  if (judge(account, look) != StepFailure::None) return StepFailure::Energy;
  budget_ = std::max(budget_ + account.work, 0.0);
  heaviest_ = account.heaviest;
  settled_ = step;
  if (look == Look::Exactly) exactly_ = step;
  return StepFailure::None;
}

// Includes kinetic energy due to round-off.
double Guard::allowed(const Rollback::Account& account) const {
  const double slow = std::isfinite(least_rest_) ? least_motion * least_rest_ / step_ : 0;
  return std::max(budget_ + account.work, 0.0) + account.headroom + 0.5 * account.mass * slow * slow;
}

Guard::EnergyTest Guard::test_energy(Rollback::Account account) {
  ++figures_.energy_tests;
  account.work += rollback_->pending_work();
  return {account.kinetic + rollback_->elastic_energy(), factor * allowed(account), account.work};
}

StepFailure Guard::judge(const Rollback::Account& account, Look look) {
  const bool high = account.kinetic > allowed(account);
  if (!high) watch_.calm = 0;
  if (look == Look::AsNeeded && (!high || account.kinetic <= more * watch_.calm)) return StepFailure::None;
  const EnergyTest now = test_energy(account);
  if (!(now.energy <= now.limit)) return StepFailure::Energy;
  watch_.calm = account.kinetic;
  if (look == Look::Exactly) budget_ = std::min(budget_, 2 * now.energy - now.work);
  return StepFailure::None;
}

// Whether neighbours might pass each other, judged by speeds alone.
bool Guard::may_pass_through() const {
  double squares = 0;
  for (const auto& body : bodies_) squares = std::max(squares, body->next.motion());
  return 2 * std::sqrt(squares) * step_ > most_rest_lengths * least_rest_;
}

bool Guard::pass_through(int substeps) const {
  for (const auto& body : bodies_) {
    const auto pair = fastest_neighbours(*body, body->map->velocity().values().data());
    if (pair && pair->rate * step_ > most_rest_lengths * substeps) return true;
  }
  return false;
}

double Guard::threshold() const {
  return std::max(factor * std::max(watch_.lately, watch_.before), heaviest_ > 0 ? 2 * budget_ / heaviest_ : 0);
}

// The threshold sinks with the motion, and rises only when the energy was tested.
void Guard::follow(double motion, long done) {
  watch_.lately = std::max(watch_.lately, motion);
  if (done % memory != 0) return;
  watch_.threshold = std::min(watch_.threshold, threshold());
  watch_.before = std::exchange(watch_.lately, 0.0);
}

StepFailure Guard::after_step(long done) {
  const PhaseScope within(profile_, Phase::Guard);
  if (!energy_) {
    if (redoing_ && done == goal_) end_rollback(done, budget_, Finer::Helps);
    return StepFailure::None;
  }
  if (!redoing_ && done <= hold_until_) figures_.redone += hold_substeps_;
  double motion = 0;
  for (const auto& body : bodies_) motion += body->next.motion();
  const bool above = motion > watch_.threshold;
  follow(motion, done);
  if ((above || done % passing_period == 0) && may_pass_through() && pass_through(substeps(done - 1)))
    return StepFailure::PassThrough;
  if (redoing_) return done == goal_ ? end_redo(done) : StepFailure::None;
  if (done - rollback_->first() >= period) {
    const StepFailure failure =
        update_budget(done, done - exactly_ >= exact_period ? Look::Exactly : Look::AsNeeded);
    if (failure == StepFailure::None) begins_ = true;
    return failure;
  }
  if (!above) return StepFailure::None;
  const StepFailure failure = judge(rollback_->account(), Look::AsNeeded);
  if (failure == StepFailure::None) watch_.threshold = factor * motion;
  return failure;
}

// The repetition has reached its last step: is it accepted?
StepFailure Guard::end_redo(long done) {
  const Rollback::Account account = rollback_->account();
  const EnergyTest now = test_energy(account);
  const double growth = now.energy - start_.value_or(0) - now.work;
  const bool fits = now.energy <= now.limit, last = substeps_ == most_substeps;
  const bool converged =
      growth_ && std::isfinite(*growth_) && std::abs(growth - *growth_) <= same * std::abs(*growth_);
  if (!converged && !(fits && (last || now.energy <= close / factor * now.limit))) {
    growth_ = growth;
    return StepFailure::Energy;
  }
  figures_.accepted += !fits;
  end_rollback(done, fits ? std::max(budget_ + now.work, 0.0) : now.energy,
               fits ? Finer::Helps : Finer::DoesNot);
  return StepFailure::None;
}

void Guard::end_rollback(long done, double budget, Finer finer) {
  redoing_ = false;
  figures_.redone += (done - from_) * substeps_;
  figures_.most_substeps = std::max(figures_.most_substeps, substeps_);
  const double part = step_ / substeps_;
  figures_.smallest = figures_.smallest > 0 ? std::min(figures_.smallest, part) : part;
  budget_ = budget;
  settled_ = done;
  begins_ = true;
  const bool soon = from_ - hold_until_ < 2 * period && hold_until_ > 0;
  hold_length_ = finer == Finer::DoesNot ? 0 : soon ? std::clamp(2 * hold_length_, period, longest_hold) : 0;
  hold_until_ = done + hold_length_;
  hold_substeps_ = substeps_;
}

std::optional<long> Guard::roll_back(StepFailure failure, long done) {
  if (!rollback_) return {};
  if (!redoing_) {
    from_ = failure == StepFailure::NotFinite ? done : rollback_->first();
    goal_ = failure == StepFailure::NotFinite ? done + 1 : done;
    substeps_ = planned_substeps(from_);
    figures_.rejected += goal_ - from_;
    growth_.reset();
    if (failure == StepFailure::Energy) {
      const EnergyTest now = test_energy(rollback_->account());
      growth_ = now.energy - now.work;
    }
  }
  const bool first = !redoing_;
  redoing_ = true;
  substeps_ = substeps_ < most_substeps ? std::min(2 * substeps_, most_substeps) : most_substeps + 1;
  if (substeps_ > most_substeps) {
    if (from_ <= rollback_->first()) return {};
    figures_.rejected += from_ - rollback_->first();
    from_ = rollback_->first();
    substeps_ = std::min(std::max(2 * least_substeps_, planned_substeps(from_)), most_substeps);
  }
  from_ = std::max(from_, rollback_->first());
  rollback_->restore();
  watch_ = watch_at_start_;
  if (energy_ && !start_) start_ = rollback_->account().kinetic + rollback_->elastic_energy();
  if (first && growth_) *growth_ -= *start_;
  settled_ = rollback_->first();
  return rollback_->first();
}

long Guard::restore_start() {
  redoing_ = begins_ = false;
  from_ = goal_ = rollback_->first();
  watch_ = watch_at_start_;
  rollback_->restore();
  settled_ = rollback_->first();
  return rollback_->first();
}

void GuardFigures::store(Archive& archive) {
  archive(rejected, redone, energy_tests, accepted, most_substeps, smallest);
  if (!archive.reading()) return;
  for (const long figure : {rejected, redone, energy_tests, accepted})
    refuse_unless(is_count(figure), "steps were redone less often than never");
  refuse_unless(is_substep_count(most_substeps) && smallest >= 0, "steps were redone in no parts");
}

void Guard::Watch::store(Archive& archive) {
  archive.unbounded(threshold, lately, before, calm);
}

void Guard::store(Archive& archive, long done) {
  archive.mark("guard");
  archive.same(on() ? 1 : 0, "whether steps are guarded");
  if (rollback_) rollback_->store(archive, done);
  double least_rest = least_rest_;
  archive(figures_);
  archive.unbounded(budget_, heaviest_, least_rest);
  watch_.store(archive);
  watch_at_start_.store(archive);
  archive(begins_, settled_, exactly_, redoing_, from_, goal_, substeps_);
  archive.unbounded(start_, growth_);
  archive(hold_until_, hold_length_, hold_substeps_, least_substeps_);
  refuse_unless(least_rest == least_rest_, "neighbours are nearer at rest");
  if (archive.reading() && rollback_) check_read(done);
}

// Between steps no repetition is in progress, and no step number lies in the future except the end of kept
// substeps.
void Guard::check_read(long done) const {
  const auto gone = [&](long step) { return step >= -1 && step <= done; };
  refuse_unless(gone(settled_) && gone(exactly_) && gone(from_) && gone(goal_),
                "a stretch ends later than now");
  refuse_unless(!redoing_, "a stretch is being redone");
  refuse_unless(hold_length_ >= 0 && hold_length_ <= longest_hold && hold_until_ >= 0 &&
                    hold_until_ <= done + longest_hold,
                "parts of steps stay for longer than they would");
  refuse_unless(is_substep_count(hold_substeps_) && is_substep_count(least_substeps_) && substeps_ >= 1 &&
                    substeps_ <= most_substeps + 1,
                "a step has no such parts");
}

void Guard::discard_start() {
  budget_ = -1;
  redoing_ = false;
}

} // namespace rend
