#include "sim/scene/energy_account.h"

#include "sim/base/archive.h"

#include <algorithm>

namespace rend {

void EnergyAccount::Tally::add(const EnergyState& state) {
  const double balance = state.balance();
  if (step < 0) first = least = balance;
  gained = std::max(gained, balance - least);
  least = std::min(least, balance);
  scale = std::max(scale, state.scale());
}

void EnergyAccount::add(long step, const EnergyState& state) {
  before_ = last_;
  last_.add(state);
  last_.step = step;
}

void EnergyAccount::roll_back(long step) {
  if (step < last_.step) last_ = before_;
}

EnergyFigures EnergyAccount::figures(const EnergyState& now) const {
  Tally tally = last_;
  tally.add(now);
  return {.now = now,
          .dissipated = tally.first - tally.least,
          .balance = now.balance() - tally.least,
          .gained = tally.gained,
          .scale = tally.scale};
}

void EnergyAccount::Tally::store(Archive& archive, long done) {
  archive(step);
  archive.unbounded(first, least, gained, scale);
  refuse_unless(step >= -1 && step <= done, "the energy account was sampled at a later step");
  refuse_unless(least <= first && gained >= 0 && scale >= 0, "an account of energy contradicts itself");
}

void EnergyAccount::store(Archive& archive, long done) {
  archive.mark("energy");
  last_.store(archive, done);
  before_.store(archive, done);
}

} // namespace rend
