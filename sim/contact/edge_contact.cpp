#include "sim/contact/edge_contact.h"

#include "sim/contact/box_tree.h"
#include "sim/contact/edge_face.h"
#include "sim/mechanics/winding.h"
#include "sim/topology/count.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace rend {
namespace {

constexpr double flat_edge = 0.985;  // the cosine between the normals of two faces from which an edge is none
constexpr double same_point = 1e-10; // relative to the thickness and the lengths of the edges

Segment segment_between(const Segment& a, const Segment& b, double share) {
  return {a[0] + share * (b[0] - a[0]), a[1] + share * (b[1] - a[1])};
}

// At rest, where segments may be parallel: the least distance of an end from the other segment then.
double segment_distance(const Segment& p, const Segment& q) {
  if (const auto shares = nearest_within(p, q))
    return (point_at(p, (*shares)[0]) - point_at(q, (*shares)[1])).norm();
  const auto from = [](const Vec3& x, const Segment& y) {
    const Vec3 way = y[1] - y[0];
    const double length = way.squaredNorm();
    return (x - point_at(y, length > 0 ? std::clamp(way.dot(x - y[0]) / length, 0.0, 1.0) : 0)).norm();
  };
  return std::min({from(p[0], q), from(p[1], q), from(q[0], p), from(q[1], p)});
}

BoxTree::Box span_of(const ContactBody& body, const std::array<Slot, 2>& end) {
  BoxTree::Box box;
  for (const Slot v : end) box.extend(body.position(v).vec());
  return box;
}

Segment segment_of(const ContactBody& body, const std::array<Slot, 2>& end) {
  return {body.position(end[0]).vec(), body.position(end[1]).vec()};
}

} // namespace

// The edges of each body in a tree of their own, and those trees in one, so that an edge's own body is skipped
// as a whole.
class EdgeContact::Trees {
public:
  // boxes: one per edge of each body.
  explicit Trees(const std::vector<std::vector<BoxTree::Box>>& boxes) {
    std::vector<BoxTree::Box> whole;
    for (std::uint32_t b = 0; b < boxes.size(); ++b) {
      if (boxes[b].empty()) continue;
      bodies_.push_back(b);
      trees_.emplace_back(boxes[b]);
      whole.push_back(trees_.back().bounds());
    }
    top_ = BoxTree(whole);
  }
  // Calls f(body, edge) for those whose boxes intersect this one, of the bodies for which skip(body) is false.
  template <class Skip, class F> void each_near(const BoxTree::Box& box, const Skip& skip, const F& f) const {
    top_.each_in(box, [&](std::uint32_t n) {
      if (skip(bodies_[n])) return;
      trees_[n].each_in(box, [&](std::uint32_t edge) { f(bodies_[n], edge); });
    });
  }

private:
  std::vector<std::uint32_t> bodies_; // one per tree
  std::vector<BoxTree> trees_;
  BoxTree top_;
};

bool EdgeContact::is_asked_for(const ContactPairs::Bodies& bodies, With with) {
  for (std::size_t a = 0; a < bodies.size(); ++a)
    for (std::size_t b = a; b < bodies.size(); ++b)
      if (looked_for(*bodies[a], *bodies[b], with)) return true;
  return false;
}

// The same one twice: itself.
bool EdgeContact::looked_for(const ContactBody& a, const ContactBody& b, With with) {
  if ((with == With::Bodies) != (a.body && b.body)) return false;
  return &a == &b ? a.settings().self : a.meets(b);
}

// Finds the edges of faces.
class EdgeContact::Finder {
public:
  // `normal`: of the face at rest.
  void add(std::span<const Slot> ring, const Vec3& normal, std::uint32_t fragment) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Slot a = ring[k], b = ring[(k + 1) % ring.size()], beyond = ring[(k + 2) % ring.size()];
      const auto [at, added] = found_.try_emplace({std::min(a, b), std::max(a, b)});
      Found& known = at->second;
      if (added) {
        known.edge = {{a, b}, {beyond, beyond}, fragment};
        known.normal = normal;
        continue;
      }
      known.edge.beyond[1] = beyond;
      known.sharp = known.again || known.normal.dot(normal) < flat_edge;
      known.again = true;
    }
  }
  // Sorted by their ends.
  void list(bool solid, std::vector<Edge>& edges) const {
    edges.clear();
    for (const auto& [ends, known] : found_)
      if (!solid || known.sharp) edges.push_back(known.edge);
  }

private:
  struct Found {
    Edge edge;
    Vec3 normal;
    bool again = false, sharp = true;
  };
  std::map<std::array<Slot, 2>, Found> found_;
};

void EdgeContact::list(const ContactBody& body, Listed& of) {
  Finder finder;
  if (body.body) {
    const EmbeddedMap& map = *body.body->map;
    const std::vector<std::uint32_t> label = label_fragments(map.map());
    body.body->boundary().for_each_face([&](const BoundaryFaces::Face& face, std::span<const Slot> ring) {
      const Dart start = face.turned ? map.map().alpha(1, face.first) : face.first; // outward
      finder.add(ring, rest_area_vector(map, start).normalized(), label[face.first.value]);
    });
  } else {
    for (const ContactFaces::Triangle& triangle : body.faces->triangles()) {
      const auto x = [&](std::size_t k) { return body.obstacle->start(triangle.vertex[k]); };
      finder.add(triangle.vertex, (x(1) - x(0)).cross(x(2) - x(0)).normalized(), 0);
    }
  }
  finder.list(body.solid(), of.edges);
  of.ends.clear();
  for (const Edge& edge : of.edges) of.ends.insert(of.ends.end(), edge.end.begin(), edge.end.end());
  std::sort(of.ends.begin(), of.ends.end());
  of.ends.erase(std::unique(of.ends.begin(), of.ends.end()), of.ends.end());
  of.there.resize(of.ends.size());
  of.moved.resize(of.edges.size());
}

// How far edges have moved since the last search.
void EdgeContact::measure(const ContactPairs::Bodies& bodies) {
  Move mean;
  std::size_t count = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    count += of_[b].ends.size();
    for (std::size_t n = 0; n < of_[b].ends.size() && !bodies[b]->fixed(); ++n) {
      mean.start += bodies[b]->from(of_[b].ends[n]) - of_[b].there[n];
      mean.end += bodies[b]->position(of_[b].ends[n]).vec() - of_[b].there[n];
    }
  }
  moved_ = 0;
  if (count == 0) return;
  mean.start /= static_cast<double>(count);
  mean.end /= static_cast<double>(count);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    Listed& of = of_[b];
    if (of.edges.empty()) continue;
    measure_moves(*bodies[b], mean, of);
    for (std::size_t n = 0; n < of.edges.size(); ++n) {
      of.moved[n] = std::max(of.moves[of.edges[n].end[0]], of.moves[of.edges[n].end[1]]);
      moved_ = std::max(moved_, of.moved[n]);
    }
  }
}

void EdgeContact::measure_moves(const ContactBody& body, const Move& mean, Listed& of) {
  of.moves.resize(body.vertices());
  for (std::size_t n = 0; n < of.ends.size(); ++n) {
    const Slot v = of.ends[n];
    const bool fixed = body.fixed();
    const Vec3 start = (fixed ? Vec3(Vec3::Zero()) : Vec3(body.from(v) - of.there[n])) - mean.start,
               end = (fixed ? Vec3(Vec3::Zero()) : Vec3(body.position(v).vec() - of.there[n])) - mean.end;
    of.moves[v] = std::sqrt(std::max(start.squaredNorm(), end.squaredNorm()));
  }
}

double EdgeContact::widest_margin(const ContactPairs::Bodies& bodies) const {
  double thickness = 0, lengths = 0;
  std::size_t count = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    thickness = std::max(thickness, bodies[b]->settings().thickness);
    for (const Edge& edge : of_[b].edges)
      lengths += (bodies[b]->position(edge.end[0]).vec() - bodies[b]->position(edge.end[1]).vec()).norm();
    count += of_[b].edges.size();
  }
  return count > 0 ? std::max(2 * thickness, 0.25 * lengths / static_cast<double>(count)) : 0;
}

void EdgeContact::search(const ContactPairs::Bodies& bodies) {
  ++searches_;
  searched_ = true;
  pairs_.clear();
  skin_ = margin_.next(widest_margin(bodies));
  double thickness = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    for (std::size_t n = 0; n < of_[b].ends.size(); ++n) of_[b].there[n] = bodies[b]->position(of_[b].ends[n]);
    if (!of_[b].edges.empty()) thickness = std::max(thickness, bodies[b]->settings().thickness);
  }
  measure(bodies); // of this step alone
  const double reach = std::max(skin_, 2 * moved_) + ContactFragments::beside * thickness;
  std::vector<std::vector<BoxTree::Box>> boxes(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (const Edge& edge : of_[b].edges) boxes[b].push_back(grown(span_of(*bodies[b], edge.end), reach));
  const Trees trees(boxes);
  for (std::uint32_t b = 0; b < bodies.size(); ++b) add_pairs(bodies, b, trees);
}

// Each pair once: the smaller body and edge first.
void EdgeContact::add_pairs(const ContactPairs::Bodies& bodies, std::uint32_t body, const Trees& trees) {
  const ContactBody& own = *bodies[body];
  const auto passes = [&](std::uint32_t other) {
    return other < body || !looked_for(own, *bodies[other], with_);
  };
  std::size_t looks = 0;
  for (std::uint32_t n = 0; n < of_[body].edges.size(); ++n) {
    const Edge& edge = of_[body].edges[n];
    const Segment ends = segment_of(own, edge.end);
    const std::size_t begin = pairs_.size();
    ++looks;
    trees.each_near(span_of(own, edge.end), passes, [&](std::uint32_t other_body, std::uint32_t other) {
      if (other_body == body && other <= n) return;
      ++looks;
      const Edge& there = of_[other_body].edges[other];
      const ContactBody& with = *bodies[other_body];
      const double touching = ContactFragments::beside * ContactPairs::thickness(own, with);
      const double clear = least_distance(ends, segment_of(with, there.end)) - touching;
      if (clear > std::max(skin_, of_[body].moved[n] + of_[other_body].moved[other])) return;
      if (other_body == body && joined(own, edge, there)) return;
      pairs_.push_back({body, n, other_body, other, clear});
    });
    std::sort(pairs_.begin() + static_cast<std::ptrdiff_t>(begin), pairs_.end(),
              [](const Pair& a, const Pair& b) {
                return std::tie(a.other_body, a.other_edge) < std::tie(b.other_body, b.other_edge);
              });
  }
  margin_.searched(looks);
}

// Whether the material connects two edges of a body, or has torn between them.
bool EdgeContact::joined(const ContactBody& body, const Edge& a, const Edge& b) {
  if (a.fragment != b.fragment) return true;
  for (const Slot v : a.end)
    if (v == b.end[0] || v == b.end[1]) return true;
  const auto& rest = body.body->map->rest();
  return segment_distance({rest[a.end[0]], rest[a.end[1]]}, {rest[b.end[0]], rest[b.end[1]]}) <=
         2 * body.settings().thickness;
}

namespace {

// The contact normal of two edges, towards the first, and the gap.
struct EdgeFacing {
  std::array<double, 2> share{};
  Vec3 normal = Vec3::Zero();
  double gap = 0; // [m]
};

} // namespace

std::optional<ContactConstraint> EdgeContact::touch(const ContactPairs::Bodies& bodies,
                                                    const Pair& pair) const {
  const ContactBody &body = *bodies[pair.body], &other = *bodies[pair.other_body];
  const Edge &a = of_[pair.body].edges[pair.edge], &b = of_[pair.other_body].edges[pair.other_edge];
  const double thickness = ContactPairs::thickness(body, other);
  const bool solid = body.solid() && other.solid();
  const Segment p0{body.from(a.end[0]), body.from(a.end[1])}, q0{other.from(b.end[0]), other.from(b.end[1])};
  const Segment p1{body.position(a.end[0]), body.position(a.end[1])},
      q1{other.position(b.end[0]), other.position(b.end[1])};
  // Out of a solid at its edge, as it is at the start of the step.
  const auto out_of = [](const ContactBody& of, const Edge& edge, const Segment& x) -> Vec3 {
    const Vec3 way = x[1] - x[0];
    return way.cross(of.from(edge.beyond[0]) - x[0]).normalized() -
           way.cross(of.from(edge.beyond[1]) - x[1]).normalized();
  };
  const auto facing = [&](const Segment& p, const Segment& q) -> std::optional<EdgeFacing> {
    const auto share = nearest_within(p, q);
    if (!share) return {};
    const Vec3 way = point_at(p, (*share)[0]) - point_at(q, (*share)[1]);
    const double gap = way.norm(), size = (p[1] - p[0]).norm() + (q[1] - q[0]).norm();
    if (!(gap > same_point * (thickness + size))) return {};
    EdgeFacing found{*share, way / gap, gap};
    const bool outside =
        found.normal.dot(out_of(other, b, q0)) > 0 && found.normal.dot(out_of(body, a, p0)) < 0;
    return !solid || outside ? std::optional(found) : std::nullopt;
  };
  auto start = facing(p0, q0);
  if (!start) return {};
  const double before = start->gap,
               after = start->normal.dot(point_at(p1, start->share[0]) - point_at(q1, start->share[1]));
  if (after >= thickness) return {};
  if (before > thickness) { // on their way they may still miss each other
    const double share = (before - thickness) / (before - after);
    const Vec3 side = start->normal;
    start = facing(segment_between(p0, p1, share), segment_between(q0, q1, share));
    if (!start || start->gap > ContactFragments::beside * thickness || start->normal.dot(side) <= 0) return {};
  }
  const auto point = [](const ContactBody& of, const Edge& edge, double share) {
    return ContactPoint{&of, {edge.end[0], edge.end[1], edge.end[1]}, {1 - share, share, 0}};
  };
  const ContactPoint own = point(body, a, start->share[0]), there = point(other, b, start->share[1]);
  return contact_between(own, there, start->normal, thickness);
}

void EdgeContact::detect(const ContactPairs::Bodies& bodies, ContactAnswer& answer) {
  bool changed = of_.size() != bodies.size();
  of_.resize(bodies.size());
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const ContactBody& body = *bodies[b];
    const bool wanted = with_ == With::Bodies ? body.settings().fragments : !body.body || body.meets_obstacles;
    if (!wanted || (searched_ && !body.changed)) continue;
    list(*bodies[b], of_[b]);
    changed = true;
  }
  if (!changed) measure(bodies);
  if (changed || 2 * moved_ > skin_) search(bodies);
  margin_.passed(pairs_.size());
  for (const Pair& pair : pairs_) {
    if (pair.clear > of_[pair.body].moved[pair.edge] + of_[pair.other_body].moved[pair.other_edge]) continue;
    if (const auto found = touch(bodies, pair)) answer.add(*found);
  }
}

std::size_t EdgeContact::bytes() const {
  std::size_t sum = bytes_of(pairs_);
  for (const Listed& of : of_)
    sum +=
        bytes_of(of.edges) + bytes_of(of.ends) + bytes_of(of.there) + bytes_of(of.moves) + bytes_of(of.moved);
  return sum;
}

} // namespace rend
