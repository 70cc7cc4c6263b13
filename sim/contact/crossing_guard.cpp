#include "sim/contact/crossing_guard.h"

#include "sim/contact/edge_face.h"

#include <algorithm>

namespace rend {
namespace {

constexpr int impulse_rounds = 2;
constexpr double least_depth = 1e-10;     // relative to the lengths of both: what is less deep only touches
constexpr double touching_already = 1e-9; // relative to those: no direction is known
constexpr double kept_distance = 0.5;     // of that at the start of the step

const std::array<Slot, 3>& corners_of(const ContactBody& body, std::uint32_t triangle) {
  return body.faces->triangles()[triangle].vertex;
}

// A pair at the start of the step and at its end.
struct Course {
  Segment x0, x1;
  TriangleCorners y0, y1;
  double size; // [m]
  Course(const ContactBodies& bodies, const EdgeFacePair& pair) {
    const ContactBody &body = *bodies[pair.body], &other = *bodies[pair.face_body];
    const auto& corner = corners_of(other, pair.triangle);
    for (std::size_t k = 0; k < 2; ++k) {
      x0[k] = body.from(pair.edge[k]);
      x1[k] = body.position(pair.edge[k]);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      y0[k] = other.from(corner[k]);
      y1[k] = other.position(corner[k]);
    }
    size = (x1[1] - x1[0]).norm() + (y1[1] - y1[0]).norm() + (y1[2] - y1[0]).norm();
  }
  bool surely_through() const { return passes_through(x1, y1, 2 * least_depth * size); }
  bool comes_through() const { // in this step
    return passes_through(x1, y1, least_depth * size) && !passes_through(x0, y0, least_depth * size);
  }
};

struct Way {
  double share = 0; // along the edge
  Weights weight{};
  Vec3 normal = Vec3::Zero(); // from the face to the edge
  double apart = 0;           // [m]
};

// Where they are nearest, or what to keep where they touch; none: no direction is known.
std::optional<Way> way_between(const Course& course, bool solid) {
  const EdgeFaceNearest near = nearest(course.x0, course.y0);
  if (near.distance > touching_already * course.size) {
    const Vec3 between = point_at(course.x0, near.share) - point_at(course.y0, near.weight);
    return Way{near.share, near.weight, between / near.distance, kept_distance * near.distance};
  }
  if (!solid) return {};
  const Vec3 out = (course.y0[1] - course.y0[0]).cross(course.y0[2] - course.y0[0]).normalized();
  const Vec3 now = (course.y1[1] - course.y1[0]).cross(course.y1[2] - course.y1[0]);
  const double deeper_end = now.dot(course.x1[1] - course.x1[0]) < 0 ? 1 : 0;
  return Way{deeper_end, nearest_in_triangle(course.y1, point_at(course.x1, deeper_end)), out, 0};
}

} // namespace

struct CrossingGuard::Step {
  const ContactBodies& bodies;
  ContactPairs* pairs; // null: no fragments
  ObstacleContact& obstacles;
  ContactAnswer& answer;
  double step; // [s]
};

void CrossingGuard::keep_apart(const ContactBodies& bodies, ContactPairs* pairs, ObstacleContact& obstacles,
                               ContactAnswer& answer, double step) {
  acted_ = false;
  number(bodies);
  zones_.clear();
  changed_.clear();
  const Step of{bodies, pairs, obstacles, answer, step};
  acted_ = find(of);
  for (int round = 0; round < impulse_rounds && found() > 0; ++round) {
    figures_.tried += found();
    const std::vector<ContactConstraint> wanted = constraints(of);
    answer.take_back();
    for (const ContactConstraint& each : wanted) answer.require(each);
    answer.solve(step);
    find(of);
  }
  answer.account();
  if (found() == 0) return;
  figures_.joined += found();
  while (unite(of)) { // each time some zone has become larger
    move_zones(of);
    find(of);
  }
  figures_.left += found();
  account(of);
}

std::optional<ThroughEachOther> CrossingGuard::prescribed(const ContactBodies& bodies,
                                                          const ObstacleContact& obstacles) const {
  const auto prescribed = [](const ContactBody& body, std::span<const Slot> vertices) {
    return std::ranges::all_of(vertices, [&](Slot v) { return body.inverse_mass(v).isZero(0); });
  };
  for (const EdgeFacePair& pair : crossing_) {
    if (!prescribed(*bodies[pair.body], pair.edge) || !Course(bodies, pair).surely_through() ||
        !prescribed(*bodies[pair.face_body], corners_of(*bodies[pair.face_body], pair.triangle)))
      continue;
    const ContactBody &a = *bodies[pair.body], &b = *bodies[pair.face_body];
    if (!a.body) return ThroughEachOther{b.body, nullptr, a.obstacle->number};
    if (!b.body) return ThroughEachOther{a.body, nullptr, b.obstacle->number};
    return ThroughEachOther{a.body, b.body};
  }
  for (const BoxCrossing& each : in_boxes_)
    if (each.surely && prescribed(*bodies[each.body], corners_of(*bodies[each.body], each.triangle)))
      return ThroughEachOther{bodies[each.body]->body, nullptr, obstacles.number_of(each)};
  return {};
}

bool CrossingGuard::comes_through(const ContactBodies& bodies, ContactPairs* pairs, ObstacleContact& obstacles,
                                  ContactAnswer& answer) {
  number(bodies);
  return find({bodies, pairs, obstacles, answer, 0});
}

void CrossingGuard::number(const ContactBodies& bodies) {
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    index_.resize(std::max(index_.size(), bodies[b]->number + 1));
    index_[bodies[b]->number] = b;
  }
}

bool CrossingGuard::find(const Step& of) {
  crossing_.clear();
  in_boxes_.clear();
  if (of.pairs) find_pairs(of);
  if (of.obstacles.near() || !of.answer.empty() || !changed_.empty())
    of.obstacles.find_crossing(of.bodies, in_boxes_);
  return found() > 0;
}

// Those that come through in this step.
void CrossingGuard::find_pairs(const Step& of) {
  const ContactFragments& fragments = of.pairs->fragments();
  pushed_.assign(fragments.all().size(), 0);
  const auto push = [&](std::size_t body, Slot vertex, const Vec3& change) {
    if (const auto f = fragments.fragment_of(body, vertex))
      pushed_[*f] = std::max(pushed_[*f], of.step * change.norm());
  };
  of.answer.each_change([&](const ContactBody& body, Slot vertex, const Vec3& change) {
    const auto zone = changed_.find({index_[body.number], vertex});
    push(index_[body.number], vertex, zone == changed_.end() ? change : Vec3(change + zone->second.velocity));
  });
  for (const auto& [part, change] : changed_) push(part.body, part.number, change.velocity);
  for (const EdgeFacePair& pair : of.pairs->crossing(of.bodies, pushed_))
    if (Course(of.bodies, pair).comes_through()) crossing_.push_back(pair);
  std::sort(crossing_.begin(), crossing_.end());
}

std::vector<ContactConstraint> CrossingGuard::constraints(const Step& of) const {
  std::vector<ContactConstraint> wanted;
  for (const EdgeFacePair& pair : crossing_) {
    const ContactBody &body = *of.bodies[pair.body], &other = *of.bodies[pair.face_body];
    const auto way = way_between(Course(of.bodies, pair), other.solid());
    if (!way) continue;
    const auto& [p, q] = pair.edge;
    const ContactPoint a{&body, {p, q, q}, {1 - way->share, way->share, 0}},
        b{&other, corners_of(other, pair.triangle), way->weight};
    wanted.push_back(contact_between(a, b, way->normal, way->apart));
    wanted.back().restitution = 0;
  }
  for (const BoxCrossing& each : in_boxes_) of.obstacles.keep_out(of.bodies, each, wanted);
  return wanted;
}

// Whether any zone has grown.
bool CrossingGuard::unite(const Step& of) {
  bool grew = false;
  // An obstacle is one part as a whole.
  const auto part = [&](std::uint32_t body, Slot vertex) {
    return ZonePart{body, of.bodies[body]->body ? vertex : 0};
  };
  const auto corners = [&](std::uint32_t body, std::uint32_t triangle) {
    const auto& corner = corners_of(*of.bodies[body], triangle);
    return std::array<ZonePart, 3>{{part(body, corner[0]), part(body, corner[1]), part(body, corner[2])}};
  };
  for (const EdgeFacePair& pair : crossing_) {
    const auto [a, b, c] = corners(pair.face_body, pair.triangle);
    const ZonePart p = part(pair.body, pair.edge[0]), q = part(pair.body, pair.edge[1]);
    grew = zones_.unite(std::array{p, q, a, b, c}) || grew;
  }
  for (const BoxCrossing& each : in_boxes_) {
    const auto [a, b, c] = corners(each.body, each.triangle);
    grew = zones_.unite(std::array{a, b, c, ZonePart{ZonePart::box, each.box}}) || grew;
  }
  return grew;
}

// As an obstacle moves that is in it, the first of several; or as its members do on average.
CrossingGuard::Motion CrossingGuard::motion_of(const Step& of, std::span<const ZonePart> zone) {
  std::vector<ZoneMember> members;
  bool led = false;
  for (const ZonePart& part : zone) {
    if (part.is_box())
      return {[&of, part](const Vec3& from) { return of.obstacles.carried(part.number, from); }, true};
    const ContactBody& body = *of.bodies[part.body];
    if (!body.body) return {[&body](const Vec3& from) { return body.obstacle->carried(from); }, true};
    if (!body.alive(part.number)) continue;
    const bool prescribed = body.inverse_mass(part.number).isZero(0);
    led = led || prescribed;
    members.push_back({.mass = 1 / body.body->inverse_mass[part.number],
                       .prescribed = prescribed,
                       .from = body.from(part.number),
                       .to = body.position(part.number)});
  }
  return {nearest_rigid_motion(members), led};
}

void CrossingGuard::move_zones(const Step& of) {
  for (const std::vector<ZonePart>& zone : zones_.all()) {
    const Motion motion = motion_of(of, zone);
    for (const ZonePart& part : zone) {
      if (part.is_box() || !of.bodies[part.body]->alive(part.number)) continue;
      const ContactBody& body = *of.bodies[part.body];
      Record &x = body.position(part.number), &u = body.velocity(part.number);
      const Vec3 free = (body.inverse_mass(part.number).array() != 0).cast<double>();
      const Vec3 from = body.from(part.number), to = motion.to(from);
      const Vec3 by = free.cwiseProduct(to - x.vec());
      x = Record(x.vec() + by);
      u = Record(u.vec() + by / of.step);
      Change& change = changed_[part];
      change.velocity += by / of.step;
      if (motion.led)
        change.work += by.dot(to - from) / (body.body->inverse_mass[part.number] * of.step * of.step);
    }
  }
}

// What a second impulse m Δ₂ adds to the energy after a first one, m Δ₁, from the velocity u⁻ before to u:
// ½ m Δ₂·(u⁻ + u + Δ₁). What leads a zone does work on it.
void CrossingGuard::account(const Step& of) const {
  std::map<ZonePart, Vec3> answered; // [m/s], Δ₁
  of.answer.each_change([&](const ContactBody& body, Slot vertex, const Vec3& change) {
    answered[{index_[body.number], vertex}] = change;
  });
  for (const auto& [part, change] : changed_) {
    ContactWork work{.obstacles = change.work, .touched = true};
    const ContactBody& body = *of.bodies[part.body];
    const auto first = answered.find(part);
    const Vec3 before = first == answered.end() ? Vec3(Vec3::Zero()) : first->second;
    const Vec3 sum =
        body.velocity_before(part.number, before + change.velocity) + body.velocity(part.number).vec() + before;
    work.impact = change.work - 0.5 / body.body->inverse_mass[part.number] * change.velocity.dot(sum);
    if (WorkMeter* meter = body.body->work_meter.get()) meter->contact(work);
  }
}

} // namespace rend
