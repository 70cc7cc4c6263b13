#include "sim/guard/guard.h"

#include "sim/base/archive.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr double factor = 4; // allowed ratio of energies
constexpr long period = Rewind::longest;
constexpr long exact_period = 4096; // steps between reductions of B
// steps between tests of neighbours, unless speeds alone rule out that they pass each other
constexpr long passing_period = 32;
constexpr int most_parts = 1024;
constexpr double more = 1.25;         // growth of K before U is tested again
constexpr double least_motion = 1e-6; // rest lengths per step: slower motion is no explosion
constexpr long longest_hold = 4096;   // steps
// relative change of a growth under half the step, below which it is not caused by the step
constexpr double same = 0.1;
// relative to the budget: energy accepted after a repetition, unless still smaller substeps give the same
constexpr double close = 1.25;

bool is_part_count(int parts) {
  return parts >= 1 && parts <= most_parts && (parts & (parts - 1)) == 0;
}

} // namespace

Guard::Guard(World& world, const Rewind::Bodies& bodies, const Scheme& scheme, double step, bool on,
             Profile* profile)
    : bodies_(bodies), profile_(profile), step_(step), energy_(on && !scheme.solves && !scheme.adaptive) {
  if (!on) return;
  rewind_.emplace(world, bodies, step);
  rewind_->reserve_for_separations();
  if (!energy_) return;
  least_rest_ = std::numeric_limits<double>::infinity();
  for (const auto& body : bodies) least_rest_ = std::min(least_rest_, least_rest_length(*body));
}

int Guard::parts(long step) const {
  return redoing_ && step >= from_ && step < goal_ ? parts_ : usual(step);
}

bool Guard::asks_for_forces() const {
  return rewind_ && (!energy_ || begins_ || budget_ < 0 || !rewind_->fits());
}

void Guard::before_laws(long step) {
  const Within within(profile_, Phase::Guard);
  if (rewind_ && !rewind_->fits()) forget();
  if (energy_ && budget_ < 0) {
    begins_ = true;
    rewind_->begin(step);
    const Rewind::Account account = rewind_->account();
    const double energy = held(account).energy;
    budget_ = std::isfinite(energy) ? energy : std::numeric_limits<double>::infinity();
    heaviest_ = account.heaviest;
    lately_ = account.squared_speeds;
    settled_ = exactly_ = step;
  }
}

Trouble Guard::before_change(long step) {
  const Within within(profile_, Phase::Guard);
  if (!energy_) return Trouble::None;
  const Trouble trouble = settle(step, Look::AsNeeded);
  if (trouble == Trouble::None) begins_ = true;
  return trouble;
}

void Guard::after_laws(long step) {
  const Within within(profile_, Phase::Guard);
  if (!rewind_ || !(begins_ || !energy_)) return;
  rewind_->begin(step);
  threshold_ = std::max(factor * lately_, heaviest_ > 0 ? 2 * budget_ / heaviest_ : 0);
  lately_ = 0;
  begins_ = false;
  start_.reset();
  growth_.reset();
}

Trouble Guard::settle(long step, Look look) {
  if (settled_ == step) return Trouble::None;
  const Rewind::Account account = rewind_->account();
  if (may_pass() && passing(parts(step))) return Trouble::Passing;
  if (judge(account, look) != Trouble::None) return Trouble::Energy;
  budget_ = std::max(budget_ + account.given, 0.0);
  heaviest_ = account.heaviest;
  settled_ = step;
  if (look == Look::Exactly) exactly_ = step;
  return Trouble::None;
}

// Includes kinetic energy due to round-off.
double Guard::allowed(const Rewind::Account& account) const {
  const double slow = std::isfinite(least_rest_) ? least_motion * least_rest_ / step_ : 0;
  return std::max(budget_ + account.given, 0.0) + account.headroom + 0.5 * account.mass * slow * slow;
}

Guard::Held Guard::held(const Rewind::Account& account) {
  ++figures_.looks;
  return {account.kinetic + rewind_->elastic_energy(), factor * allowed(account), account.given};
}

Trouble Guard::judge(const Rewind::Account& account, Look look) {
  const bool high = account.kinetic > allowed(account);
  if (!high) calm_ = 0;
  if (look == Look::AsNeeded && (!high || account.kinetic <= more * calm_)) return Trouble::None;
  const Held now = held(account);
  if (!(now.energy <= now.limit)) return Trouble::Energy;
  calm_ = account.kinetic;
  if (look == Look::Exactly) budget_ = std::min(budget_, 2 * now.energy - account.given);
  return Trouble::None;
}

// Whether neighbours might pass each other, judged by speeds alone.
bool Guard::may_pass() const {
  double squares = 0;
  for (const auto& body : bodies_) squares = std::max(squares, body->next.motion());
  return 2 * std::sqrt(squares) * step_ > most_rest_lengths * least_rest_;
}

bool Guard::passing(int parts) const {
  for (const auto& body : bodies_) {
    const auto pair = fastest_neighbours(*body, body->map->velocity().values().data());
    if (pair && pair->rate * step_ > most_rest_lengths * parts) return true;
  }
  return false;
}

Trouble Guard::after_step(long done) {
  const Within within(profile_, Phase::Guard);
  if (!energy_) {
    if (redoing_ && done == goal_) go_on(done, budget_, Finer::Helps);
    return Trouble::None;
  }
  if (!redoing_ && done <= hold_until_) figures_.redone += hold_parts_;
  double motion = 0;
  for (const auto& body : bodies_) motion += body->next.motion();
  lately_ = std::max(lately_, motion);
  const bool above = motion > threshold_;
  if ((above || done % passing_period == 0) && may_pass() && passing(parts(done - 1))) return Trouble::Passing;
  if (redoing_) return done == goal_ ? end_redo(done) : Trouble::None;
  if (done - rewind_->first() >= period) {
    const Trouble trouble = settle(done, done - exactly_ >= exact_period ? Look::Exactly : Look::AsNeeded);
    if (trouble == Trouble::None) begins_ = true;
    return trouble;
  }
  if (!above) return Trouble::None;
  const Rewind::Account account = rewind_->account();
  const Trouble trouble = judge(account, Look::AsNeeded);
  if (trouble == Trouble::None) threshold_ = factor * motion;
  return trouble;
}

// The repetition has reached its last step: is it accepted?
Trouble Guard::end_redo(long done) {
  const Rewind::Account account = rewind_->account();
  const Held now = held(account);
  const double growth = now.energy - start_.value_or(0) - now.given;
  const bool fits = now.energy <= now.limit, last = 2 * parts_ > most_parts;
  const bool converged =
      growth_ && std::isfinite(*growth_) && std::abs(growth - *growth_) <= same * std::abs(*growth_);
  if (!converged && !(fits && (last || now.energy <= close / factor * now.limit))) {
    growth_ = growth;
    return Trouble::Energy;
  }
  figures_.accepted += !fits;
  go_on(done, fits ? std::max(budget_ + account.given, 0.0) : now.energy, fits ? Finer::Helps : Finer::DoesNot);
  return Trouble::None;
}

void Guard::go_on(long done, double budget, Finer finer) {
  redoing_ = false;
  figures_.redone += (done - from_) * parts_;
  figures_.most_parts = std::max(figures_.most_parts, parts_);
  const double part = step_ / parts_;
  figures_.smallest = figures_.smallest > 0 ? std::min(figures_.smallest, part) : part;
  budget_ = budget;
  settled_ = done;
  begins_ = true;
  const bool soon = from_ - hold_until_ < 2 * period && hold_until_ > 0;
  hold_length_ = finer == Finer::DoesNot ? 0 : soon ? std::clamp(2 * hold_length_, period, longest_hold) : 0;
  hold_until_ = done + hold_length_;
  hold_parts_ = parts_;
}

std::optional<long> Guard::again(Trouble trouble, long done) {
  if (!rewind_) return {};
  if (!redoing_) {
    from_ = trouble == Trouble::NotFinite ? done : rewind_->first();
    goal_ = trouble == Trouble::NotFinite ? done + 1 : done;
    parts_ = usual(from_);
    figures_.rejected += goal_ - from_;
    growth_.reset();
    if (trouble == Trouble::Energy) {
      const Rewind::Account account = rewind_->account();
      growth_ = held(account).energy - account.given;
    }
  }
  const bool first = !redoing_;
  redoing_ = true;
  parts_ *= 2;
  if (parts_ > most_parts) {
    if (from_ <= rewind_->first()) return {};
    figures_.rejected += from_ - rewind_->first();
    from_ = rewind_->first();
    parts_ = 2;
  }
  from_ = std::max(from_, rewind_->first());
  rewind_->restore();
  if (energy_ && !start_) start_ = rewind_->account().kinetic + rewind_->elastic_energy();
  if (first && growth_) *growth_ -= *start_;
  settled_ = rewind_->first();
  return rewind_->first();
}

long Guard::go_back() {
  redoing_ = begins_ = false;
  rewind_->restore();
  settled_ = rewind_->first();
  return rewind_->first();
}

void GuardFigures::store(Archive& archive) {
  archive(rejected, redone, looks, accepted, most_parts, smallest);
  if (!archive.reading()) return;
  for (const long figure : {rejected, redone, looks, accepted})
    refuse_unless(is_count(figure), "steps were redone less often than never");
  refuse_unless(is_part_count(most_parts) && smallest >= 0, "steps were redone in no parts");
}

void Guard::store(Archive& archive, long done) {
  archive.mark("guard");
  archive.same(on() ? 1 : 0, "whether steps are guarded");
  if (rewind_) rewind_->store(archive, done);
  double least_rest = least_rest_;
  archive(figures_);
  archive.unbounded(budget_, threshold_, lately_, heaviest_, calm_, least_rest);
  archive(begins_, settled_, exactly_, redoing_, from_, goal_, parts_);
  archive.unbounded(start_, growth_);
  archive(hold_until_, hold_length_, hold_parts_);
  refuse_unless(least_rest == least_rest_, "neighbours are nearer at rest");
  if (archive.reading() && rewind_) check_read(done);
}

// Between steps no repetition is in progress, and no step number lies in the future except the end of kept
// substeps.
void Guard::check_read(long done) const {
  const auto gone = [&](long step) { return step >= -1 && step <= done; };
  refuse_unless(gone(settled_) && gone(exactly_) && gone(from_) && gone(goal_),
                "a stretch ends later than now");
  refuse_unless(!redoing_, "a stretch is being redone");
  refuse_unless(done > 0 || (begins_ && budget_ < 0), "energy is known before the first step");
  refuse_unless(hold_length_ >= 0 && hold_length_ <= longest_hold && hold_until_ >= 0 &&
                    hold_until_ <= done + longest_hold,
                "parts of steps stay for longer than they would");
  refuse_unless(is_part_count(hold_parts_) && parts_ >= 1 && parts_ <= 2 * most_parts,
                "a step has no such parts");
}

void Guard::forget() {
  budget_ = -1;
  redoing_ = false;
}

} // namespace rend
