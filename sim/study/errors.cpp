#include "sim/study/errors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>

namespace rend {
namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>; // indices of corresponding points

double extent_of(const std::vector<Vec3>& points) {
  if (points.empty()) return 0;
  Vec3 low = points.front(), high = low;
  for (const Vec3& p : points) {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  return (high - low).norm();
}

// Points whose rest positions agree to a millionth of the size. Points with the same rest position (two bodies,
// the corners of a vertex) cannot be told apart and are left out.
Pairs common_points(const Trajectory& a, const Trajectory& b) {
  Pairs pairs;
  if (a.rest == b.rest) {
    for (std::size_t n = 0; n < a.rest.size(); ++n) pairs.emplace_back(n, n);
    return pairs;
  }
  using Key = std::array<long long, 3>;
  const double cell = 1e-6 * std::max(extent_of(a.rest), extent_of(b.rest));
  if (cell == 0) return pairs;
  const auto key =
      [&](const Vec3& x) { // shifted by half a cell, so that round numbers are not on the border of a cell
        return Key{std::llround(x.x() / cell + 0.3), std::llround(x.y() / cell + 0.3),
                   std::llround(x.z() / cell + 0.3)};
      };
  std::map<Key, std::vector<std::size_t>> there, here;
  for (std::size_t n = 0; n < b.rest.size(); ++n) there[key(b.rest[n])].push_back(n);
  for (std::size_t n = 0; n < a.rest.size(); ++n) here[key(a.rest[n])].push_back(n);
  for (const auto& [place, ours] : here) {
    const auto found = there.find(place);
    if (ours.size() == 1 && found != there.end() && found->second.size() == 1)
      pairs.emplace_back(ours.front(), found->second.front());
  }
  return pairs;
}

struct Distance {
  double square = 0, mass = 0, largest = 0;
  void add(const Vec3& difference, double m) {
    const double d = difference.squaredNorm();
    if (std::isnan(d)) return; // deleted in one of them
    square += m * d;
    mass += m;
    largest = std::max(largest, std::sqrt(d));
  }
  double mean() const { return mass > 0 ? std::sqrt(square / mass) : 0; }
};

// Adds one sample to norms whose over_time is a sum of squares until the end.
void add(const Distance& d, Norms& norms) {
  norms.over_time += d.mean() * d.mean();
  norms.over_time_max = std::max(norms.over_time_max, d.largest);
  norms.final = d.mean();
  norms.final_max = d.largest;
}

const StateSample* at(const Trajectory& trajectory, double time, double slack) {
  for (const StateSample& sample : trajectory.samples)
    if (std::abs(sample.time - time) <= slack) return &sample;
  return nullptr;
}

void add_drifts(const StateSample& run, const StateSample& run_start, const StateSample& other,
                const StateSample& other_start, StateErrors& errors) {
  const double drift = (run.energy() - run_start.energy()) - (other.energy() - other_start.energy());
  errors.energy = std::max(errors.energy, std::abs(drift));
  if (!errors.momentum) return;
  errors.momentum = std::max(*errors.momentum, (run.momentum - run_start.momentum).norm());
  errors.angular = std::max(*errors.angular, (run.angular_momentum - run_start.angular_momentum).norm());
}

} // namespace

Scales scales_of(const Trajectory& reference) {
  Scales scales;
  double length = 0, speed = 0, energy = 0;
  scales.mass = std::accumulate(reference.mass.begin(), reference.mass.end(), 0.0);
  for (const StateSample& sample : reference.samples) {
    Distance moved, moving;
    for (std::size_t n = 0; n < reference.rest.size(); ++n) {
      moved.add(sample.position[n] - reference.samples.front().position[n], reference.mass[n]);
      moving.add(sample.velocity[n], reference.mass[n]);
    }
    length = std::max(length, moved.mean());
    speed = std::max(speed, moving.mean());
    energy = std::max(energy, sample.kinetic);
  }
  if (length > 0) scales.length = length;
  if (speed > 0) scales.speed = speed;
  if (energy > 0) scales.energy = energy;
  return scales;
}

std::optional<StateErrors> compare(const Trajectory& run, const Trajectory& reference, double until) {
  const Pairs pairs = common_points(run, reference);
  if (pairs.empty() || run.samples.empty() || reference.samples.empty()) return {};
  StateErrors errors;
  if (reference.isolated) errors.momentum = errors.angular = 0.0;
  const double slack = 1e-9 * std::max(run.samples.back().time, reference.samples.back().time);
  for (std::size_t n = 1; n < run.samples.size(); ++n) {
    const StateSample& sample = run.samples[n];
    const StateSample* other = at(reference, sample.time, slack);
    if (!other || sample.time > until + slack) continue;
    Distance position, velocity;
    for (const auto& [i, j] : pairs) {
      position.add(sample.position[i] - other->position[j], run.mass[i]);
      velocity.add(sample.velocity[i] - other->velocity[j], run.mass[i]);
    }
    add(position, errors.position);
    add(velocity, errors.velocity);
    add_drifts(sample, run.samples.front(), *other, reference.samples.front(), errors);
    ++errors.samples;
  }
  if (errors.samples == 0) return {};
  for (Norms* norms : {&errors.position, &errors.velocity})
    norms->over_time = std::sqrt(norms->over_time / static_cast<double>(errors.samples));
  return errors;
}

double overlap(const std::vector<TornSide>& a, const std::vector<TornSide>& b) {
  std::vector<TornSide> both;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(both));
  const std::size_t all = a.size() + b.size() - both.size();
  return all == 0 ? 1 : static_cast<double>(both.size()) / static_cast<double>(all);
}

} // namespace rend
