#include "sim/integrate/newton_scheme.h"

#include <algorithm>

namespace rend {

void NewtonScheme::keep_state(std::vector<double>& numbers) const {
  const LinearSolver::SavedState from = linear_.saved_state();
  numbers = {static_cast<double>(newton_), static_cast<double>(from.hard), static_cast<double>(from.iterations),
             static_cast<double>(from.factorisations)};
}

bool NewtonScheme::restore_state(std::span<const double> numbers) {
  numbers = numbers.first(saved_numbers);
  if (!std::all_of(numbers.begin(), numbers.end(), is_whole_count) || numbers[1] > LinearSolver::direct_streak)
    return false;
  const auto whole = [&](std::size_t n) { return static_cast<long>(numbers[n]); };
  newton_ = whole(0);
  linear_.restore_state({static_cast<int>(whole(1)), whole(2), whole(3)});
  return true;
}

void NewtonScheme::hold(System& system, double time, std::vector<std::uint8_t>& axes) {
  axes.assign(system.vertices(), 0);
  system.mark_prescribed(time, axes.data());
}

std::size_t NewtonScheme::bytes_with(std::initializer_list<const Records*> arrays) const {
  std::size_t sum = load_tangent_.bytes();
  for (const Records* one : arrays) sum += bytes_of(*one);
  return sum;
}

} // namespace rend
