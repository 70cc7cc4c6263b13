#include "sim/check/watch.h"

#include "sim/solve/spectrum.h"

#include <Eigen/LU>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace rend {

std::vector<Scheme> explicit_schemes(bool drag) {
  std::vector<Scheme> all;
  for (const Scheme& scheme : all_schemes())
    if (!scheme.solves && scheme.limit({1, drag ? 0.1 : 0, drag ? 0.1 : 0}) > 0) all.push_back(scheme);
  return all;
}

double energy(const Scene& scene) {
  return scene.kinetic_energy() + scene.elastic_energy() + scene.gravity_energy();
}

void shake(Body& body, double speed, std::uint64_t seed) {
  const double* inverse_mass = body.program->inverse_mass();
  std::vector<std::uint8_t> held(body.vertices(), 0);
  body.constraints.mark(body.time(), held.data());
  const Records push = scattered(body.vertices(), inverse_mass, held, seed);
  std::vector<Record>& velocity = body.map->velocity().values();
  for (std::size_t i = 0; i < push.size(); ++i)
    store(velocity[i], load(velocity[i]) + splat(speed) * load(push[i]));
}

void put(Body& body, const std::function<Vec3(const Vec3& rest, std::size_t slot)>& place) {
  for (std::size_t i = 0; i < body.vertices(); ++i)
    if (body.program->inverse_mass()[i] > 0)
      body.map->position().values()[i] = Record(place(body.map->rest().values()[i].vec(), i));
}

namespace {

// Calls f(mass [kg], position, rest position, velocity) for every vertex.
template <class F> void each_vertex(const Body& body, F&& f) {
  const double* inverse = body.program->inverse_mass();
  for (std::size_t i = 0; i < body.vertices(); ++i)
    if (inverse[i] > 0)
      f(1 / inverse[i], body.map->position().values()[i].vec(), body.map->rest().values()[i].vec(),
        body.map->velocity().values()[i].vec());
}

Vec3 sides(const Body& body) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  each_vertex(body, [&](double, const Vec3&, const Vec3& rest, const Vec3&) {
    low = low.cwiseMin(rest);
    high = high.cwiseMax(rest);
  });
  return high - low;
}

} // namespace

double size_of(const Body& body) {
  return sides(body).maxCoeff();
}

double least_side(const Body& body) {
  double least = size_of(body);
  for (const double side : sides(body))
    if (side > 0) least = std::min(least, side);
  return least;
}

void stop_as_a_whole(Body& body) {
  double mass = 0;
  Vec3 centre = Vec3::Zero(), drift = Vec3::Zero(), turn = Vec3::Zero();
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
  each_vertex(body, [&](double m, const Vec3& x, const Vec3&, const Vec3& v) {
    mass += m;
    centre += m * x;
    drift += m * v;
  });
  centre /= mass;
  each_vertex(body, [&](double m, const Vec3& x, const Vec3&, const Vec3& v) {
    const Vec3 arm = x - centre;
    turn += m * arm.cross(v - drift / mass);
    inertia += m * (arm.squaredNorm() * Eigen::Matrix3d::Identity() - arm * arm.transpose());
  });
  const Vec3 spin = inertia.inverse() * turn;
  for (std::size_t i = 0; i < body.vertices(); ++i)
    if (body.program->inverse_mass()[i] > 0) {
      Record& v = body.map->velocity().values()[i];
      v = Record(Vec3(v.vec() - drift / mass - spin.cross(body.map->position().values()[i].vec() - centre)));
    }
}

double distortion(const Body& body) {
  double mass = 0;
  Vec3 here = Vec3::Zero(), there = Vec3::Zero();
  each_vertex(body, [&](double m, const Vec3& x, const Vec3& rest, const Vec3&) {
    mass += m;
    here += m * x;
    there += m * rest;
  });
  here /= mass;
  there /= mass;
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  each_vertex(body, [&](double m, const Vec3& x, const Vec3& rest, const Vec3&) {
    moment += m * (x - here) * (rest - there).transpose();
  });
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  const Eigen::Matrix3d turn = svd.matrixU() * Vec3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  double sum = 0;
  each_vertex(body, [&](double m, const Vec3& x, const Vec3& rest, const Vec3&) {
    sum += m * (x - here - turn * (rest - there)).squaredNorm();
  });
  return std::sqrt(sum / mass);
}

Vec3 mean_velocity(const Body& body) {
  double mass = 0;
  Vec3 sum = Vec3::Zero();
  each_vertex(body, [&](double m, const Vec3&, const Vec3&, const Vec3& v) {
    mass += m;
    sum += m * v;
  });
  return sum / mass;
}

Vec3 mean_way(const Body& body) {
  double mass = 0;
  Vec3 sum = Vec3::Zero();
  each_vertex(body, [&](double m, const Vec3& x, const Vec3& rest, const Vec3&) {
    mass += m;
    sum += m * (x - rest);
  });
  return sum / mass;
}

double rms_speed(const Scene& scene) {
  return std::sqrt(2 * scene.kinetic_energy() / scene.mass());
}

Course run(Scene& scene, long steps, long every) {
  Course course;
  course.first_energy = course.least_energy = course.most_energy = energy(scene);
  try {
    for (; course.steps < steps; ++course.steps) {
      scene.step();
      if ((course.steps + 1) % every != 0) continue;
      const double now = energy(scene);
      course.least_energy = std::min(course.least_energy, now);
      course.most_energy = std::isfinite(now) ? std::max(course.most_energy, now) : now;
    }
  } catch (const Unstable& error) {
    course.stopped = true;
    course.why = error.what();
  }
  return course;
}

void go_to(Scene& scene, double time) {
  while (scene.time() < time - 1e-9) scene.step();
}

bool is_finite(const Scene& scene) {
  for (const auto& body : scene.bodies())
    for (std::size_t i = 0; i < body->vertices(); ++i) {
      if (body->program->inverse_mass()[i] == 0) continue;
      for (const Record& r : {body->map->position().values()[i], body->map->velocity().values()[i]})
        if (!r.vec().allFinite()) return false;
    }
  return true;
}

} // namespace rend
