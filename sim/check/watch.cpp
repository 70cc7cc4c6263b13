#include "sim/check/watch.h"

#include "sim/solve/spectrum.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>

namespace rend {

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

double size_of(const Body& body) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (std::size_t i = 0; i < body.vertices(); ++i) {
    if (body.program->inverse_mass()[i] == 0) continue;
    low = low.cwiseMin(body.map->rest().values()[i].vec());
    high = high.cwiseMax(body.map->rest().values()[i].vec());
  }
  return (high - low).maxCoeff();
}

double distortion(const Body& body) {
  const auto& x = body.map->position().values();
  const auto& rest = body.map->rest().values();
  const double* inverse = body.program->inverse_mass();
  double mass = 0;
  Vec3 here = Vec3::Zero(), there = Vec3::Zero();
  const auto each = [&](auto&& f) {
    for (std::size_t i = 0; i < body.vertices(); ++i)
      if (inverse[i] > 0) f(1 / inverse[i], x[i].vec(), rest[i].vec());
  };
  each([&](double m, const Vec3& a, const Vec3& b) {
    mass += m;
    here += m * a;
    there += m * b;
  });
  here /= mass;
  there /= mass;
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  each([&](double m, const Vec3& a, const Vec3& b) { moment += m * (a - here) * (b - there).transpose(); });
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(moment, Eigen::ComputeFullU | Eigen::ComputeFullV);
  const double sign = (svd.matrixU() * svd.matrixV().transpose()).determinant();
  const Eigen::Matrix3d turn = svd.matrixU() * Vec3(1, 1, sign).asDiagonal() * svd.matrixV().transpose();
  double sum = 0;
  each([&](double m, const Vec3& a, const Vec3& b) {
    sum += m * (a - here - turn * (b - there)).squaredNorm();
  });
  return std::sqrt(sum / mass);
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
