#include "sim/body/probe.h"

#include "sim/base/check.h"
#include "sim/base/wording.h"
#include "sim/body/body.h"
#include "sim/rows/continuum.h"

#include <algorithm>
#include <array>
#include <limits>

namespace rend {

template <> const Fields<ProbeSettings>& fields_of() {
  using S = ProbeSettings;
  static const Fields<S> fields =
      Fields<S>{
          field(&S::name,
                text("name", "letters, digits, - and _; each probe of the scene has its own").is_required())} +
      fields_of_part(&S::where);
  return fields;
}

void check_name(const ProbeSettings& probe) {
  const auto fits = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  for (const char c : probe.name)
    if (!fits(static_cast<unsigned char>(c)))
      probe.source.fail("name", "the name of a probe holds " + in_quotes(std::string(1, c)),
                        "letters, digits, - and _ do");
  if (probe.name.empty())
    probe.source.fail("name", "the name of the probe is empty", "letters, digits, - and _ do");
}

Probe::Probe(EmbeddedMap& map, std::string name, const std::vector<Slot>& vertices)
    : name_(std::move(name)), shares_(&share_equally(map, "probe " + name_, vertices)) {}

std::optional<ProbeReading> Probe::read(Body& body) const {
  const EmbeddedMap& map = *body.map;
  const CellIndex& corners = map.cells(shares_->orbit());
  ProbeReading reading;
  double whole = 0;
  for (Slot c = 0; c < corners.slots(); ++c) {
    const double share = (*shares_)[c];
    if (!corners.alive(c) || share == 0) continue;
    const Slot v = map.vertex(corners.first_dart(c));
    const Vec3 x = map.position()[v];
    reading.position += share * x;
    reading.displacement += share * (x - map.rest()[v].vec());
    whole += share;
  }
  if (whole == 0) return {};
  reading.position /= whole;
  reading.displacement /= whole;
  if (on_support(body)) reading.reaction = reaction(body);
  reading.stress = stress(body);
  return reading;
}

std::vector<Slot> Probe::vertices(const EmbeddedMap& map) const {
  std::vector<Slot> all;
  const CellIndex& corners = map.cells(shares_->orbit());
  for (Slot c = 0; c < corners.slots(); ++c)
    if (corners.alive(c) && (*shares_)[c] != 0) all.push_back(map.vertex(corners.first_dart(c)));
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

bool Probe::on_support(const Body& body) const {
  const std::vector<Slot>& held = body.constraints.vertices();
  if (held.empty()) return false;
  for (Slot v : vertices(*body.map))
    if (std::binary_search(held.begin(), held.end(), v)) return true;
  return false;
}

Vec3 Probe::reaction(Body& body) const {
  const EmbeddedMap& map = *body.map;
  const double time = body.time();
  const Record *x = map.position().values().data(), *v = map.velocity().values().data();
  std::vector<Record> force(body.vertices());
  body.program->forces(x, v, force.data());
  body.update_loads(time, x, v);
  const double *inverse_mass = body.program->inverse_mass(), *drag_rate = body.program->drag_rate();
  Vec3 sum = Vec3::Zero();
  for (Slot s : vertices(map)) {
    Vec3 prescribed = Vec3::Zero();
    std::array<bool, 3> held{};
    body.constraints.for_each_motion(s, [&](const Motion& motion) {
      if (!motion.acts(time)) return;
      const Vec3 a = motion.acceleration_at(map.rest()[s], motion.at(time));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!motion.axes[axis]) continue;
        held[axis] = true;
        prescribed[static_cast<int>(axis)] = a[static_cast<int>(axis)];
      }
    });
    const double rate = body.uniform_drag + (drag_rate ? drag_rate[s] : 0);
    const double mass = inverse_mass[s] > 0 ? 1 / inverse_mass[s] : 0;
    Vec3 r = -mass * body.gravity.vec() - force[s].vec();
    if (body.integrator->has_inertia()) r += mass * (prescribed + rate * v[s].vec());
    if (body.load) r -= body.load[s].vec();
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (held[axis]) sum[static_cast<int>(axis)] += r[static_cast<int>(axis)];
  }
  return sum;
}

bool has_stress(const Body& body) {
  return !Continuum(*body.map, body.interactions).empty();
}

std::optional<Eigen::Matrix3d> Probe::stress(const Body& body) const {
  const EmbeddedMap& map = *body.map;
  const Continuum continuum(map, body.interactions);
  if (continuum.empty()) return {};
  std::vector<bool> ours(body.vertices());
  for (Slot v : vertices(map)) ours[v] = true;
  Eigen::Matrix3d sum = Eigen::Matrix3d::Zero();
  std::size_t count = 0;
  continuum.each(map.position().values().data(), nullptr,
                 [&](const Continuum::Part& part, const CurrentUnit& e) {
                   bool is = false;
                   for (std::size_t n = 0; n < static_cast<std::size_t>(e.particles); ++n)
                     is = is || ours[e.vertex[n]];
                   if (!is) return;
                   sum += stress_of(part, e);
                   ++count;
                 });
  if (count == 0) return {};
  return Eigen::Matrix3d(sum / static_cast<double>(count));
}

const std::vector<std::string>& probe_quantities() {
  static const std::vector<std::string> all{"x",         "y",         "z",          "dx",         "dy",
                                            "dz",        "d",         "reaction-x", "reaction-y", "reaction-z",
                                            "reaction",  "stress-xx", "stress-yy",  "stress-zz",  "stress-xy",
                                            "stress-yz", "stress-xz"};
  return all;
}

double quantity_of(const ProbeReading& reading, const std::string& quantity) {
  const bool of_reaction = quantity.starts_with("reaction"), of_displacement = quantity.starts_with("d");
  if (quantity.starts_with("stress")) {
    const std::size_t n = quantity.size();
    return reading.stress ? (*reading.stress)(quantity[n - 2] - 'x', quantity[n - 1] - 'x')
                          : std::numeric_limits<double>::quiet_NaN();
  }
  if (of_reaction && !reading.reaction) return std::numeric_limits<double>::quiet_NaN();
  const Vec3 vector = of_reaction       ? *reading.reaction
                      : of_displacement ? reading.displacement
                                        : reading.position;
  if (quantity == "d" || quantity == "reaction") return vector.norm();
  const int axis = quantity.back() - 'x';
  CHECK(axis >= 0 && axis < 3);
  return vector[axis];
}

} // namespace rend
