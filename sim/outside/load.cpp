#include "sim/outside/load.h"

#include "sim/base/check.h"
#include "sim/mechanics/mass.h"
#include "sim/mechanics/rotation.h"
#include "sim/topology/walk.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

void add_to(Record& sum, const Vec3& force) {
  sum = Record(sum.vec() + force);
}

} // namespace

template <> const Fields<LoadSettings>& fields_of() {
  using S = LoadSettings;
  static const Fields<S> fields =
      fields_of_part(&S::where) +
      Fields<S>{
          field(&S::force, numbers("force", 3, "N", "total force")),
          field(&S::moment,
                numbers("moment", 3, "N m",
                        "total moment about the middle of the selected boundary; the total force is zero")),
          field(&S::pressure, number("pressure", "Pa",
                                     "pressure on the selected faces, inwards; on a sheet it acts on the side "
                                     "from which the cells run counterclockwise, which is +z before <place>")),
          field(&S::follows,
                word("follows", {"world", "body"},
                     "world: force and moment keep their direction; body: they turn with the boundary")),
          field(&S::from, number("from", "s", "start time; no load before it").at_least(0)),
          field(&S::until, number("until", "s",
                                  "the load grows linearly between `from` and this time; default: it acts in "
                                  "full from `from` on")
                               .at_least(0)),
          field(&S::over,
                number("over", "s", "instead of until: the load grows linearly during this time after `from`")
                    .at_least(0))};
  return fields;
}

void check_load(const LoadSettings& load) {
  const int given = load.force.has_value() + load.moment.has_value() + load.pressure.has_value();
  if (given != 1)
    load.source.fail("",
                     given == 0 ? "<load> needs one of force, moment, pressure"
                                : "<load> has several of force, moment, pressure: one of them",
                     given == 0 ? "force=\"0 0 -1\"" : "write a <load> for each");
  if (load.pressure && load.source.given("follows"))
    load.source.fail("follows", "a pressure always acts along the normals of the body's faces", "leave it out");
  if (load.over && !std::isinf(load.until))
    load.source.fail("over", "<load> has both until and over: either says when it is whole", "leave one out");
  if (load.until < load.from && !std::isinf(load.until))
    load.source.fail("until", "the load has grown before it starts: until is less than from");
}

double LoadSettings::share(double time) const {
  if (time < from) return 0;
  if (over) return ramp(time - from, *over);
  return until > from ? std::min(1.0, (time - from) / (until - from)) : 1;
}

// The centre of the patch, and its second moments about it: Σ (x − c) × (θ × (x − c)) = J θ.
struct Load::Section {
  using Solver = Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix3d>;
  Vec3 centre = Vec3::Zero();                        // [m]
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero(); // [m²]

  // The minimum-norm solution θ; moments of inertia below `least` times the largest count as 0.
  Solver solver(double least = 1e-10) const {
    Solver s;
    s.setThreshold(least);
    s.compute(inertia);
    return s;
  }
};

Load::Load(const EmbeddedMap& map, const LoadSettings& settings, Patch patch)
    : settings_(settings), patch_(std::move(patch)) {
  CHECK(patch_.cells().size() > 0);
  CHECK(settings.force || settings.moment || settings.pressure);
  if (settings_.kind() != LoadSettings::Kind::Pressure)
    for (double measure : patch_.measures(map)) whole_ += measure;
  share_out(map);
  if (settings_.kind() == LoadSettings::Kind::Moment)
    line_ = section(map.rest().values().data()).solver().rank() < 3;
}

void Load::rebind(const EmbeddedMap& map) {
  patch_.rebind(map);
  share_out(map);
}

void Load::share_out(const EmbeddedMap& map) {
  if (settings_.kind() == LoadSettings::Kind::Pressure) return;
  part_ = patch_.measures(map);
  for (double& part : part_) part /= whole_;
  frame_.clear();
  if (!settings_.with_body()) return;
  if (patch_.of() == Patch::Kind::Faces) {
    frame_ = vertices();
    return;
  }
  std::vector<Dart> darts;
  for (Dart d : patch_.darts()) collect(map.map(), element_orbit(map.dimension()), d, darts);
  for (Dart d : darts) frame_.push_back(map.vertex(d));
}

Load::Section Load::section(const Record* position) const {
  Section s;
  double whole = 0;
  for (std::size_t i = 0; i < part_.size(); ++i) {
    s.centre += part_[i] * position[vertices()[i]].vec();
    whole += part_[i];
  }
  if (whole > 0) s.centre /= whole;
  for (std::size_t i = 0; i < part_.size(); ++i) {
    const Vec3 r = position[vertices()[i]].vec() - s.centre;
    s.inertia += part_[i] * (r.squaredNorm() * Eigen::Matrix3d::Identity() - r * r.transpose());
  }
  return s;
}

bool Load::possible(const EmbeddedMap& map) const {
  const Section s = section(map.rest().values().data());
  const Vec3& wanted = *settings_.moment;
  const Vec3 had = s.inertia * s.solver().solve(wanted);
  return (had - wanted).norm() <= 1e-6 * wanted.norm();
}

void Load::add_moment(const Vec3& moment, const Record* position, Record* force) const {
  const Section s = section(position);
  // a line that is slightly bent carries no moment about itself either
  const double least = line_ ? 1e-3 : 1e-12;
  const Vec3 turn = s.solver(least).solve(moment);
  for (std::size_t i = 0; i < part_.size(); ++i)
    add_to(force[vertices()[i]], part_[i] * turn.cross(position[vertices()[i]].vec() - s.centre));
}

void Load::add_pressure(double pressure, const Record* position, Record* force) const {
  std::vector<Vec3> x, area;
  for (std::size_t c = 0; c < patch_.cells().size(); ++c) {
    const std::span<const Slot> face = patch_.cells()[c];
    x.clear();
    for (Slot v : face) x.push_back(position[v].vec());
    area.resize(x.size());
    corner_areas(x, area);
    for (std::size_t i = 0; i < face.size(); ++i) add_to(force[face[i]], -pressure * area[i]);
  }
}

Eigen::Matrix3d Load::rotation(const EmbeddedMap& map, const Record* position) const {
  const double n = static_cast<double>(std::max<std::size_t>(frame_.size(), 1));
  Vec3 here = Vec3::Zero(), rest = Vec3::Zero();
  for (Slot v : frame_) {
    here += position[v].vec() / n;
    rest += map.rest()[v].vec() / n;
  }
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (Slot v : frame_) covariance += (position[v].vec() - here) * (map.rest()[v].vec() - rest).transpose();
  return closest_rotation(covariance);
}

void Load::add(const EmbeddedMap& map, double time, const Record* position, Record* force) const {
  const double share = settings_.share(time);
  if (share == 0) return;
  if (settings_.kind() == LoadSettings::Kind::Pressure)
    return add_pressure(share * *settings_.pressure, position, force);
  Vec3 amount = share * (settings_.moment ? *settings_.moment : *settings_.force);
  if (settings_.with_body()) amount = rotation(map, position) * amount;
  if (settings_.kind() == LoadSettings::Kind::Moment) return add_moment(amount, position, force);
  for (std::size_t i = 0; i < part_.size(); ++i) add_to(force[vertices()[i]], part_[i] * amount);
}

void Loads::add(Load load) {
  loads_.push_back(std::move(load));
  share_.push_back(0);
  known_ = false;
}

void Loads::set(WindLoad wind) {
  wind_ = std::move(wind);
  known_ = false;
}

void Loads::rebind(const EmbeddedMap& map) {
  for (Load& load : loads_) load.rebind(map);
  if (wind_) wind_->rebind(map);
  known_ = false;
}

void Loads::reserve_for_separations(const EmbeddedMap& map) {
  if (!empty()) sum_.reserve(map.slots_when_separated(Vertex));
}

std::size_t Loads::bytes() const {
  std::size_t sum = bytes_of(sum_) + (wind_ ? wind_->bytes() : 0);
  for (const Load& load : loads_) sum += load.bytes();
  return sum;
}

bool Loads::constant() const {
  return !wind_ && std::all_of(loads_.begin(), loads_.end(), [](const Load& load) { return load.constant(); });
}

bool Loads::up_to_date(double time) const {
  if (!known_ || wind_) return false;
  for (std::size_t n = 0; n < loads_.size(); ++n)
    if (!loads_[n].constant() || loads_[n].settings().share(time) != share_[n]) return false;
  return true;
}

const Record* Loads::evaluate(const EmbeddedMap& map, double time, const Record* position,
                              const Record* velocity) {
  if (empty()) return nullptr;
  if (up_to_date(time)) return sum_.data();
  if (!known_) sum_.assign(map.cells(Vertex).slots(), Record{});
  for (const Load& load : loads_) // other vertices are 0 already
    for (Slot v : load.vertices()) sum_[v] = Record{};
  if (wind_)
    for (Slot v : wind_->vertices()) sum_[v] = Record{};
  for (std::size_t n = 0; n < loads_.size(); ++n) {
    loads_[n].add(map, time, position, sum_.data());
    share_[n] = loads_[n].settings().share(time);
  }
  if (wind_) wind_->add(position, velocity, sum_.data());
  known_ = true;
  return sum_.data();
}

} // namespace rend
