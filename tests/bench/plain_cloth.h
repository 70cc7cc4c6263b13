// The lower bound for springs: the same springs in hand-written code, with plain arrays and one scalar loop,
// symplectic Euler, without map, tearing or guard.
#pragma once

#include "sim/body/body.h"

#include <cmath>
#include <vector>

namespace rend {

struct PlainCloth {
  struct P {
    double x, y, z;
  };
  std::vector<P> x, v, f;
  std::vector<double> inverse_mass, k, rest;
  std::vector<int> i, j;
  std::vector<int> fixed;
  double drag = 0;

  explicit PlainCloth(const Body& body) : drag(body.uniform_drag) {
    for (const Record& r : body.map->position().values()) x.push_back({r.x, r.y, r.z});
    v.resize(x.size(), {0, 0, 0});
    f.resize(x.size());
    inverse_mass.assign(body.program->inverse_mass(), body.program->inverse_mass() + x.size());
    for (const Binder& binder : body.program->folded())
      binder.rows().for_each([&](std::size_t, std::size_t row) {
        i.push_back(static_cast<int>(binder.rows().index(0)[row]));
        j.push_back(static_cast<int>(binder.rows().index(1)[row]));
        k.push_back(binder.rows().value(0, row));
        rest.push_back(binder.rows().value(2, row));
      });
    for (Slot s : body.constraints.vertices()) fixed.push_back(static_cast<int>(s));
  }

  void step(double dt) {
    for (P& p : f) p = {0, 0, 0};
    for (std::size_t s = 0; s < k.size(); ++s) {
      const P &a = x[static_cast<std::size_t>(i[s])], &b = x[static_cast<std::size_t>(j[s])];
      const double dx = b.x - a.x, dy = b.y - a.y, dz = b.z - a.z;
      const double length = std::sqrt(dx * dx + dy * dy + dz * dz);
      const double c = k[s] * (length - rest[s]) / length;
      P &fa = f[static_cast<std::size_t>(i[s])], &fb = f[static_cast<std::size_t>(j[s])];
      fa.x += c * dx, fa.y += c * dy, fa.z += c * dz;
      fb.x -= c * dx, fb.y -= c * dy, fb.z -= c * dz;
    }
    for (std::size_t n = 0; n < x.size(); ++n) {
      const double w = inverse_mass[n];
      v[n].x += dt * (w * f[n].x - drag * v[n].x);
      v[n].y += dt * (w * f[n].y - drag * v[n].y);
      v[n].z += dt * (w * f[n].z - 9.81 - drag * v[n].z);
    }
    for (int n : fixed) v[static_cast<std::size_t>(n)] = {0, 0, 0};
    for (std::size_t n = 0; n < x.size(); ++n) {
      x[n].x += dt * v[n].x;
      x[n].y += dt * v[n].y;
      x[n].z += dt * v[n].z;
    }
  }
};

} // namespace rend
