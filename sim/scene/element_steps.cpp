#include "sim/scene/element_steps.h"

#include "sim/mechanics/element_quality.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace rend {
namespace {

constexpr double thin = 5;  // the aspect ratio from which an element is called a sliver
constexpr double light = 4; // an element is called light, if the median has so many times its mass

const char* shape_name(int dimension, std::size_t corners) {
  if (dimension == 2) return corners == 3 ? "triangle" : corners == 4 ? "quad" : "face";
  switch (corners) {
  case 4:
    return "tetrahedron";
  case 5:
    return "pyramid";
  case 6:
    return "prism";
  case 8:
    return "hexahedron";
  default:
    return "cell";
  }
}

} // namespace

ElementSteps::ElementSteps(const Body& body)
    : body_(&body), elements_(body.map->map(), element_orbit(body.map->dimension())) {
  const CellIndex& corners = body.map->cells(body.mass->orbit());
  std::vector<std::vector<Slot>> of(elements_.slots());
  for (Slot c = 0; c < corners.slots(); ++c)
    if (corners.alive(c)) of[elements_.slot(corners.first_dart(c))].push_back(c);
  first_.push_back(0);
  for (const std::vector<Slot>& each : of) {
    corners_.insert(corners_.end(), each.begin(), each.end());
    first_.push_back(corners_.size());
  }
  update();
}

void ElementSteps::update() {
  const MassColumn& mass = *body_->mass;
  const DragColumn* drag = body_->drag;
  const CornerBounds sums = corner_bounds(*body_->map, body_->interactions, mass);
  whole_ = frequency_bounds(sums, *body_->map, mass, drag);
  bounds_.assign(elements_.slots(), {0, 0, 1e300});
  mass_.assign(elements_.slots(), 0);
  for (Slot e = 0; e < count(); ++e) {
    FrequencyBounds& b = bounds_[e];
    for_each_corner(e, [&](Slot c) {
      const double m = mass[c], own = drag ? (*drag)[c] : 0;
      if (m <= 0) return;
      mass_[e] += m;
      b.omega_squared = std::max(b.omega_squared, sums.stiffness[c] / m);
      b.damping_rate = std::max(b.damping_rate, (sums.damping[c] + own) / m);
      b.least_drag_rate = std::min(b.least_drag_rate, own / m);
    });
  }
}

double ElementSteps::step(const Scheme& scheme, Slot element, double heavier) const {
  const FrequencyBounds& b = bounds_[element];
  return scheme.limit({b.omega_squared / heavier,
                       b.damping_rate / heavier + more_damping_ + body_->uniform_drag,
                       b.least_drag_rate / heavier + body_->uniform_drag});
}

double ElementSteps::least(const Scheme& scheme) const {
  return step(scheme, whole_);
}

double ElementSteps::least_undamped(const Scheme& scheme) const {
  return scheme.limit({whole_.omega_squared, 0, 0});
}

double ElementSteps::step(const Scheme& scheme, const FrequencyBounds& bounds) const {
  return scheme.limit({bounds.omega_squared, bounds.damping_rate + more_damping_ + body_->uniform_drag,
                       bounds.least_drag_rate + body_->uniform_drag});
}

std::string ElementSteps::name(Slot element) const {
  const EmbeddedMap& map = *body_->map;
  std::vector<Slot> vertices;
  for_each_corner(
      element, [&](Slot c) { vertices.push_back(map.vertex(map.cells(body_->mass->orbit()).first_dart(c))); });
  Vec3 middle = Vec3::Zero();
  for (Slot v : vertices) middle += map.rest()[v].vec() / static_cast<double>(vertices.size());
  return fmt::format("the {} {} near ({:.4g}, {:.4g}, {:.4g}) m", shape_name(map.dimension(), vertices.size()),
                     element, middle.x(), middle.y(), middle.z());
}

std::string ElementSteps::shape(Slot element) const {
  const EmbeddedMap& map = *body_->map;
  const ElementQuality q = quality_of(map, elements_.first_dart(element));
  return fmt::format("{} from {:.3g} to {:.3g} degrees, aspect ratio {:.3g}",
                     map.dimension() == 3 ? "dihedral angles" : "angles", q.least_angle, q.greatest_angle,
                     q.aspect);
}

double ElementSteps::aspect(Slot element) const {
  return quality_of(*body_->map, elements_.first_dart(element)).aspect;
}

namespace {

std::string what_is_wrong(const ElementSteps& body, Slot element) {
  if (body.aspect(element) >= thin) return "a sliver: " + body.shape(element);
  std::vector<double> masses;
  for (Slot e = 0; e < body.count(); ++e)
    if (body.mass(e) > 0) masses.push_back(body.mass(e));
  const auto middle = masses.begin() + static_cast<std::ptrdiff_t>(masses.size() / 2);
  std::nth_element(masses.begin(), middle, masses.end());
  if (light * body.mass(element) <= *middle)
    return fmt::format("light: {:.3g} kg, and the median of all {:.3g} kg", body.mass(element), *middle);
  return "stiff for its mass, " + body.shape(element);
}

} // namespace

FewElements few_that_limit(const ElementSteps& body, const Scheme& scheme, double limit) {
  std::vector<std::pair<double, Slot>> all; // [s]
  for (Slot e = 0; e < body.count(); ++e)
    if (body.mass(e) > 0) all.emplace_back(body.step(scheme, e), e);
  const std::size_t thousandth = (all.size() + 999) / 1000, hundredth = (all.size() + 99) / 100;
  if (all.size() <= hundredth) return {};
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(hundredth), all.end());
  const double gain = all[hundredth].first / limit;
  if (std::isinf(gain)) return {};
  std::sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(hundredth));
  const Slot worst = all.front().second;
  return {gain, fmt::format("{} ({}) limits the step; without the worst {} of {} elements it is {:.2g} times "
                            "longer, without the worst {} {:.2g} times: mend the mesh there, or allow "
                            "<time mass-scaling=\"0.01\">",
                            body.name(worst), what_is_wrong(body, worst), thousandth, all.size(),
                            all[thousandth].first / limit, hundredth, gain)};
}

} // namespace rend
