#include "sim/body/work_meter.h"

#include "sim/base/archive.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

Vec3 load_on(const MeteredBody& body, Slot v) {
  return body.system.load ? body.system.load[v].vec() : Vec3::Zero();
}

double mass_of(const MeteredBody& body, Slot v) {
  const double inverse = body.system.inverse_mass[v];
  return inverse > 0 ? 1 / inverse : 0;
}

Vec3 whole_force(const MeteredBody& body, Slot v) {
  return body.force[v].vec() + load_on(body, v) + mass_of(body, v) * body.system.gravity.vec();
}

double drag_rate(const System& system, Slot v) {
  return system.uniform_drag + (system.drag_rate ? system.drag_rate[v] : 0);
}

// 1 along the coordinates of a vertex that are prescribed at a time, 0 along the others.
Vec3 prescribed(const Constraints& constraints, Slot v, double time) {
  Vec3 axes = Vec3::Zero();
  constraints.for_each_motion(v, [&](const Motion& motion) {
    for (int a = 0; a < 3 && motion.acts(time); ++a)
      if (motion.axes[static_cast<std::size_t>(a)]) axes[a] = 1;
  });
  return axes;
}

std::vector<Slot> loaded_vertices(const Loads& loads) {
  std::vector<Slot> all;
  const auto add = [&](const std::vector<Slot>& some) { all.insert(all.end(), some.begin(), some.end()); };
  for (const Load& load : loads.loads()) add(load.vertices());
  if (loads.wind()) add(loads.wind()->vertices());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

} // namespace

FreeMotion free_motion(const MeteredBody& body, double time) {
  FreeMotion sum;
  const auto add = [&](Slot v, const Vec3& axes, double sign) {
    const Vec3 force = axes.cwiseProduct(whole_force(body, v));
    sum.power += sign * force.dot(body.velocity[v].vec());
    sum.squared_forces += sign * body.system.inverse_mass[v] * force.squaredNorm();
  };
  for (Slot v = 0; v < body.system.vertices(); ++v)
    if (body.system.inverse_mass[v] > 0) add(v, Vec3::Ones(), 1);
  for (const Slot v : body.constraints.vertices())
    if (body.system.inverse_mass[v] > 0) add(v, prescribed(body.constraints, v, time), -1);
  return sum;
}

Work& Work::operator+=(const Work& other) {
  loads += other.loads;
  drives += other.drives;
  contact += other.contact;
  changes += other.changes;
  remesh += other.remesh;
  return *this;
}

double Work::size() const {
  return std::abs(loads) + std::abs(drives) + std::abs(contact.obstacles) + std::abs(contact.impact) +
         std::abs(contact.friction);
}

void WorkMeter::list(const MeteredBody& body) {
  const auto become = [](std::vector<Entry>& entries, const std::vector<Slot>& vertices) {
    entries.assign(vertices.size(), {});
    for (std::size_t n = 0; n < vertices.size(); ++n) entries[n].vertex = vertices[n];
  };
  become(entries_.loads, loaded_vertices(body.loads));
  become(entries_.drives, body.constraints.drives() ? body.constraints.vertices() : std::vector<Slot>{});
  listed_ = true;
}

void WorkMeter::forget_vertices() {
  listed_ = false;
  for (std::vector<Entry>* each : {&entries_.loads, &entries_.drives}) each->clear();
}

void WorkMeter::settle(const MeteredBody& body) {
  settled_ = work(body);
  if (!listed_) list(body);
  for (Entry& e : entries_.loads) e = {e.vertex, Record(load_on(body, e.vertex)), {}};
  for (Entry& e : entries_.drives) e = {e.vertex, Record(whole_force(body, e.vertex)), {}};
}

void WorkMeter::measure(const MeteredBody& body, double time, const State& next) {
  for (Entry& e : entries_.loads) {
    const Vec3 half = 0.5 * (next.position[e.vertex].vec() - body.position[e.vertex].vec());
    settled_.loads += e.force.vec().dot(half);
    e.pending = Record(half);
  }
  for (Entry& e : entries_.drives) {
    const Slot i = e.vertex;
    const Vec3 axes = prescribed(body.constraints, i, time);
    const Vec3 move = axes.cwiseProduct(next.position[i].vec() - body.position[i].vec());
    const Vec3 v = axes.cwiseProduct(body.velocity[i].vec()), w = axes.cwiseProduct(next.velocity[i].vec());
    const double m = mass_of(body, i);
    settled_.drives += 0.5 * m * (w.squaredNorm() - v.squaredNorm());
    settled_.drives += m * drag_rate(body.system, i) * w.dot(move) - 0.5 * e.force.vec().dot(move);
    e.pending = Record(Vec3(-0.5 * move));
  }
}

void WorkMeter::contact(const ContactWork& work) {
  settled_.contact += work;
}

void WorkMeter::touch(std::size_t obstacle) {
  CHECK(obstacle < touched_.size());
  touched_[obstacle] = 1;
}

template <class Load, class Force> Work WorkMeter::with_pending(const Load& load, const Force& force) const {
  Work sum = settled_;
  for (const Entry& e : entries_.loads) sum.loads += load(e).dot(e.pending.vec());
  for (const Entry& e : entries_.drives) sum.drives += force(e).dot(e.pending.vec());
  return sum;
}

Work WorkMeter::work(const MeteredBody& body) const {
  return with_pending([&](const Entry& e) -> Vec3 { return load_on(body, e.vertex); },
                      [&](const Entry& e) -> Vec3 { return whole_force(body, e.vertex); });
}

Work WorkMeter::work() const {
  const auto before = [](const Entry& e) { return e.force.vec(); };
  return with_pending(before, before);
}

void WorkMeter::Entry::store(Archive& archive) {
  archive(vertex, force, pending);
}

void WorkMeter::store(Archive& archive, std::size_t most) {
  archive.unbounded(settled_.loads, settled_.drives, settled_.changes, settled_.remesh);
  settled_.contact.store(archive);
  archive.fixed(touched_, "number of obstacles");
  if (archive.reading())
    for (const std::uint8_t each : touched_) refuse_unless(each <= 1, "an obstacle is touched more than once");
  const auto all = [&](std::vector<Entry>& entries, std::size_t at_most) {
    archive.list(entries, at_most, "work is done on more vertices than the body has");
    if (!archive.reading()) return;
    for (const Entry& e : entries) refuse_unless(e.vertex < most, "work is done on a vertex that is not there");
  };
  all(entries_.loads, most);
  all(entries_.drives, most);
}

std::size_t WorkMeter::bytes() const {
  return bytes_of(entries_.loads) + bytes_of(entries_.drives) + bytes_of(touched_);
}

} // namespace rend
