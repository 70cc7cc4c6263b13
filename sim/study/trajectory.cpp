#include "sim/study/trajectory.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());

bool untouched(const Body& body) {
  return body.gravity.vec().isZero(0) && body.constraints.vertices().empty() && body.loads.empty() &&
         !body.drag && body.uniform_drag == 0 && !body.floor_contact;
}

std::vector<TornSide> torn_sides(const Scene& scene) {
  std::vector<TornSide> all;
  for (std::size_t b = 0; b < scene.bodies().size(); ++b) {
    const Body& body = *scene.bodies()[b];
    if (!body.border) continue;
    const GMap& map = body.map->map();
    const CellIndex& sides = body.map->cells(body.border->orbit());
    for (Slot s = 0; s < sides.slots(); ++s)
      if (sides.alive(s) && !(*body.border)[s] && map.is_free(body.map->dimension(), sides.first_dart(s)))
        all.push_back({static_cast<std::uint32_t>(b), sides.first_dart(s)});
  }
  std::sort(all.begin(), all.end());
  return all;
}

// If no step ended at its time, an answer was measured a fraction of a step later, which is no error of the
// scheme.
std::vector<AnswerError> answer_errors(const Scene& scene) {
  std::vector<AnswerError> all;
  for (const auto& body : scene.bodies()) {
    for (const Answer& answer : body->answers) {
      const double steps = answer.at / scene.step_size();
      if (!answer.asked || std::abs(steps - std::round(steps)) > 1e-6) continue;
      all.push_back(
          {fmt::format("{} {} at {:.6g} s", body->probes[answer.number].name(), answer.quantity, answer.at),
           std::abs(answer.error())});
    }
  }
  return all;
}

} // namespace

bool tears(const Scene& scene) {
  return std::any_of(scene.bodies().begin(), scene.bodies().end(),
                     [](const auto& body) { return body->tears(); });
}

bool isolated(const Scene& scene) {
  const World& world = scene.world();
  if (world.has_obstacles() || world.wind) return false;
  return std::all_of(scene.bodies().begin(), scene.bodies().end(),
                     [](const auto& body) { return untouched(*body); });
}

Sampler::Sampler(const Scene& scene) {
  trajectory_.tears = tears(scene);
  trajectory_.isolated = isolated(scene);
  for (const auto& body : scene.bodies()) {
    const EmbeddedMap& map = *body->map;
    const CellIndex &corners = map.cells(body->mass->orbit()), &vertices = map.cells(Vertex);
    std::vector<Dart> points;
    std::vector<double> mass(vertices.slots(), 0);
    for (Slot c = 0; c < corners.slots(); ++c) {
      if (!corners.alive(c)) continue;
      const Slot v = map.vertex(corners.first_dart(c));
      mass[v] += (*body->mass)[c];
      if (!body->tears()) continue;
      points.push_back(corners.first_dart(c));
      trajectory_.rest.push_back(map.rest()[v]);
      trajectory_.mass.push_back((*body->mass)[c]);
    }
    for (Slot v = 0; v < vertices.slots() && !body->tears(); ++v) {
      if (!vertices.alive(v)) continue;
      points.push_back(vertices.first_dart(v));
      trajectory_.rest.push_back(map.rest()[v]);
      trajectory_.mass.push_back(mass[v]);
    }
    points_.push_back(std::move(points));
  }
}

void Sampler::take(const Scene& scene) {
  StateSample sample;
  sample.time = scene.time();
  sample.position.reserve(trajectory_.rest.size());
  sample.velocity.reserve(trajectory_.rest.size());
  for (std::size_t b = 0; b < points_.size(); ++b) {
    const EmbeddedMap& map = *scene.bodies()[b]->map;
    for (Dart d : points_[b]) {
      const bool there = map.map().alive(d);
      sample.position.push_back(there ? map.position_of(d) : nowhere);
      sample.velocity.push_back(there ? map.velocity()[map.vertex(d)].vec() : nowhere);
    }
  }
  sample.kinetic = scene.kinetic_energy();
  sample.elastic = scene.elastic_energy();
  sample.gravity = scene.gravity_energy();
  sample.momentum = scene.momentum();
  sample.angular_momentum = scene.angular_momentum();
  trajectory_.samples.push_back(std::move(sample));
}

Trajectory Sampler::finish(const Scene& scene) {
  trajectory_.tear_count = scene.tears();
  for (const auto& body : scene.bodies())
    for (const TearEvent& event : body->events)
      trajectory_.first_tear = std::min(trajectory_.first_tear.value_or(event.time), event.time);
  trajectory_.torn = torn_sides(scene);
  trajectory_.answers = answer_errors(scene);
  return std::move(trajectory_);
}

} // namespace rend
