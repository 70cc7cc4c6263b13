#include "sim/scene/mass_scaling.h"

#include "sim/scene/element_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr double heaviest = 1e12;   // the largest factor
constexpr double least_gain = 1.05; // of the step: below, nothing is changed
constexpr int rounds = 16;          // springs share masses with their neighbours: bounds are found again

// The least factor of an element's mass for which its step is at least `target` [s], to 1e-9 above it: between
// the ratio of the steps, if damping limits its step, and the square of that, if its frequency does.
double factor_for(const ElementSteps& steps, Slot element, const Scheme& scheme, double target) {
  if (steps.mass(element) <= 0) return 1;
  const double step = steps.step(scheme, element);
  if (step >= target) return 1;
  double low = target / step, high = low * low;
  while (high < heaviest && steps.step(scheme, element, high) < target)
    high *= 2; // damping of its surroundings
  if (high >= heaviest) return heaviest;
  while (high > (1 + 1e-9) * low) {
    const double middle = std::sqrt(low * high);
    (steps.step(scheme, element, middle) >= target ? high : low) = middle;
  }
  return high;
}

// Whether a body's elements reach the target with at most so much more mass [kg].
bool affordable(const ElementSteps& steps, const Scheme& scheme, double target, double most) {
  double added = 0;
  for (Slot e = 0; e < steps.count() && added <= most; ++e)
    added += (factor_for(steps, e, scheme, target) - 1) * steps.mass(e);
  return added <= most;
}

double mass_of(const ElementSteps& steps) {
  double sum = 0;
  for (Slot e = 0; e < steps.count(); ++e) sum += steps.mass(e);
  return sum;
}

// Makes elements heavier up to the target, or until the body has `most` [kg] more than `before`; returns their
// number.
std::size_t make_heavier(Body& body, ElementSteps& steps, const Scheme& scheme, double target, double most) {
  const double before = mass_of(steps);
  std::vector<char> scaled(steps.count(), 0);
  for (int round = 0; round < rounds; ++round) {
    if (round > 0 && !affordable(steps, scheme, target, most - (mass_of(steps) - before))) break;
    bool any = false;
    for (Slot e = 0; e < steps.count(); ++e) {
      const double factor = factor_for(steps, e, scheme, target);
      if (factor == 1) continue;
      steps.for_each_corner(e, [&](Slot corner) { body.mass->values()[corner] *= factor; });
      any = true;
      scaled[e] = 1;
    }
    if (!any) break;
    steps.update();
  }
  body.added_mass = mass_of(steps) - before;
  return static_cast<std::size_t>(std::count(scaled.begin(), scaled.end(), 1));
}

} // namespace

bool scale_masses(const std::vector<std::unique_ptr<Body>>& bodies, const Scheme& scheme, double most,
                  std::optional<double> wanted) {
  std::vector<ElementSteps> all;
  double limit = std::numeric_limits<double>::infinity();
  for (const auto& body : bodies) limit = std::min(limit, all.emplace_back(*body).least(scheme));
  if (!(limit > 0) || std::isinf(limit) || (wanted && *wanted <= limit)) return false;
  const auto fits = [&](double target) {
    return std::all_of(all.begin(), all.end(), [&](const ElementSteps& steps) {
      return affordable(steps, scheme, target, most * mass_of(steps));
    });
  };
  double low = limit, high = limit;
  while (high < 1e9 * limit && fits(2 * high)) high *= 2;
  low = high;
  high *= 2;
  for (int n = 0; n < 24; ++n) {
    const double middle = std::sqrt(low * high);
    (fits(middle) ? low : high) = middle;
  }
  const double target = wanted ? std::min(low, *wanted) : low;
  if (!wanted && target < least_gain * limit) return false;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const double before = mass_of(all[b]), was = all[b].least(scheme);
    const std::size_t changed = make_heavier(*bodies[b], all[b], scheme, target, most * before);
    if (changed == 0) continue;
    bodies[b]->notes.push_back(fmt::format(
        "mass scaling: {} elements are heavier, and the body by {:.4g} kg ({:.3g} % of {:.4g} kg): its largest "
        "stable step is {:.3g} s, and was {:.3g} s",
        changed, bodies[b]->added_mass, 100 * bodies[b]->added_mass / before, before, all[b].least(scheme),
        was));
  }
  return true;
}

} // namespace rend
