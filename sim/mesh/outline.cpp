#include "sim/mesh/outline.h"

#include "sim/base/check.h"
#include "sim/base/math.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

constexpr double flatness = 1e-4; // of the larger side of the box

double larger_side(const Eigen::AlignedBox2d& box) {
  return box.sizes().maxCoeff();
}

// Divided evenly. A part of n lies within 6/8 · M/n² of its chord, M: the larger of the second differences of
// the control points (the second derivative is at most 6 M, and a chord departs from a curve by h²/8 of it).
void flatten(const Cubic& c, double tolerance, Contour& ring) {
  const double bend = std::max((c[0] - 2 * c[1] + c[2]).norm(), (c[1] - 2 * c[2] + c[3]).norm()) * 6.0 / 8.0;
  const bool straight = c[0] == c[1] && c[2] == c[3];
  const int parts =
      straight ? 1 : std::clamp(static_cast<int>(std::ceil(std::sqrt(bend / tolerance))), 1, 1000);
  for (int n = 1; n <= parts; ++n) {
    const double t = static_cast<double>(n) / parts, s = 1 - t;
    const Vec2 point =
        n == parts ? c[3]
                   : Vec2(s * s * s * c[0] + 3 * s * s * t * c[1] + 3 * s * t * t * c[2] + t * t * t * c[3]);
    if (ring.empty() || point != ring.back()) ring.push_back(point);
  }
}

// A star or a gear: corners at the radii in turn, evenly around from the top.
std::string path_around(int count, std::initializer_list<std::pair<double, double>> corners) { // radius, share
  std::string path;
  for (int n = 0; n < count; ++n)
    for (const auto& [radius, share] : corners) {
      const double degrees = 90 - 360 * (n + share) / count;
      path += fmt::format("{} {} {} ", path.empty() ? "M" : "L", radius * cosine_of_degrees(degrees),
                          radius * sine_of_degrees(degrees));
    }
  return path + "Z";
}

std::string path_of(OutlineName name) {
  switch (name) {
  case OutlineName::Path:
    CHECK(false);
  case OutlineName::Heart:
    return "M0,-0.95 C-0.3,-0.55 -1,-0.2 -1,0.38 C-1,0.72 -0.75,0.95 -0.47,0.95 C-0.25,0.95 -0.08,0.82 0,0.6 "
           "C0.08,0.82 0.25,0.95 0.47,0.95 C0.75,0.95 1,0.72 1,0.38 C1,-0.2 0.3,-0.55 0,-0.95 Z";
  case OutlineName::Star:
    return path_around(5, {{1, 0}, {0.45, 0.5}});
  case OutlineName::Disc:
    return "M1,0 A1,1 0 0 1 -1,0 A1,1 0 0 1 1,0 Z";
  case OutlineName::Ring:
    return "M1,0 A1,1 0 0 1 -1,0 A1,1 0 0 1 1,0 Z M0.6,0 A0.6,0.6 0 0 1 -0.6,0 A0.6,0.6 0 0 1 0.6,0 Z";
  case OutlineName::Drop:
    return "M0,1 C0.12,0.6 0.6,0.15 0.6,-0.4 A0.6,0.6 0 0 0 -0.6,-0.4 C-0.6,0.15 -0.12,0.6 0,1 Z";
  case OutlineName::Gear:
    return path_around(10, {{1, -0.18}, {1, 0.18}, {0.78, 0.28}, {0.78, 0.72}}) +
           " M0.3,0 A0.3,0.3 0 0 1 -0.3,0 A0.3,0.3 0 0 1 0.3,0 Z";
  }
  return {};
}

} // namespace

Eigen::AlignedBox2d Outline::box() const {
  Eigen::AlignedBox2d all;
  for (const Contour& ring : rings)
    for (const Vec2& point : ring) all.extend(point);
  return all;
}

bool Outline::contains(const Vec2& point) const {
  bool inside = false;
  for (const Contour& ring : rings)
    for (std::size_t n = 0; n < ring.size(); ++n) {
      const Vec2 &a = ring[n], &b = ring[(n + 1) % ring.size()];
      if ((a.y() > point.y()) == (b.y() > point.y())) continue;
      if (point.x() < a.x() + (b.x() - a.x()) * ((point.y() - a.y()) / (b.y() - a.y()))) inside = !inside;
    }
  return inside;
}

int Outline::regions() const {
  int count = 0;
  for (std::size_t n = 0; n < rings.size(); ++n) {
    std::vector<Contour> others = rings;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(n));
    if (!Outline{std::move(others)}.contains(rings[n].front())) ++count;
  }
  return count;
}

double Outline::area() const {
  constexpr int lines = 2000;
  const Eigen::AlignedBox2d all = box();
  double sum = 0;
  std::vector<double> crossings;
  for (int line = 0; line < lines; ++line) {
    const double y = all.min().y() + all.sizes().y() * (line + 0.5) / lines;
    crossings.clear();
    for (const Contour& ring : rings)
      for (std::size_t n = 0; n < ring.size(); ++n) {
        const Vec2 &a = ring[n], &b = ring[(n + 1) % ring.size()];
        if ((a.y() > y) != (b.y() > y))
          crossings.push_back(a.x() + (b.x() - a.x()) * ((y - a.y()) / (b.y() - a.y())));
      }
    std::ranges::sort(crossings);
    for (std::size_t n = 1; n < crossings.size(); n += 2) sum += crossings[n] - crossings[n - 1];
  }
  return sum * all.sizes().y() / lines;
}

Outline flattened(const std::vector<Curve>& curves) {
  Eigen::AlignedBox2d box;
  for (const Curve& curve : curves)
    for (const Cubic& cubic : curve)
      for (const Vec2& point : cubic) box.extend(point);
  Outline outline;
  for (const Curve& curve : curves) {
    Contour ring;
    for (const Cubic& cubic : curve) flatten(cubic, flatness * larger_side(box), ring);
    while (ring.size() > 1 && ring.back() == ring.front()) ring.pop_back();
    if (ring.size() >= 3) outline.rings.push_back(std::move(ring));
  }
  return outline;
}

Outline outline_of_path(std::string_view path) {
  const std::vector<Curve> curves = curves_of_path(path);
  if (curves.empty()) throw PathFault(0, "the path encloses nothing");
  Outline outline = flattened(curves);
  if (outline.rings.empty()) throw PathFault(0, "the path encloses nothing");
  return outline;
}

Outline named_outline(OutlineName name) {
  return outline_of_path(path_of(name));
}

Outline fitted(Outline outline, double size) {
  const Eigen::AlignedBox2d box = outline.box();
  const double scale = size / larger_side(box);
  const Vec2 middle = box.center();
  for (Contour& ring : outline.rings)
    for (Vec2& point : ring) point = (point - middle) * scale;
  return outline;
}

} // namespace rend
