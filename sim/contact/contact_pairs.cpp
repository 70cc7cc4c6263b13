#include "sim/contact/contact_pairs.h"

#include "sim/contact/edge_face.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace rend {
namespace {

constexpr double beside = ContactFragments::beside, deepest = ContactFragments::deepest;

// By how much both may move until the vertex may be as deep behind the face of a solid as it is still seen: the
// largest of the bounds above. `off` [m]: from the nearest point of the face.
double clear_of_depth(const Vec3& off, const TriangleCorners& y) {
  const Vec3 area = (y[1] - y[0]).cross(y[2] - y[0]);
  double longest = 0; // [m²]
  for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, (y[k] - y[(k + 1) % 3]).squaredNorm());
  longest = std::sqrt(longest);
  const double distance = off.norm(), by_size = (distance - deepest * longest) / (1 + 2 * deepest);
  if (longest == 0 || off.dot(area) < 0) return by_size;
  const double height = area.norm() / longest;
  return std::max({by_size, std::min(0.94 * distance, height / 8), std::min(0.89 * distance, height / 6),
                   std::min(0.70 * distance, height / 4)});
}

// [m], distance of a vertex from a triangle of the same body at rest.
double apart_at_rest(const ContactBody& body, Slot v, const ContactFaces::Triangle& triangle) {
  const auto& rest = body.body->map->rest();
  const TriangleCorners x{rest[triangle.vertex[0]], rest[triangle.vertex[1]], rest[triangle.vertex[2]]};
  const Weights w = nearest_in_triangle(x, rest[v]);
  return (rest[v].vec() - w[0] * x[0] - w[1] * x[1] - w[2] * x[2]).norm();
}

} // namespace

const std::vector<ContactPair>& ContactPairs::find(const Bodies& bodies) {
  if (fragments_.update(bodies)) {
    swept_.clear();
    neighbours_.clear();
    pool_.clear();
    edge_pool_.clear();
    unused_ = unused_edges_ = 0;
  }
  pairs_.clear();
  if (!fragments_.anything(bodies)) return pairs_;
  fragments_.measure(bodies);
  if (!all_within()) sweep(bodies);
  note_near(bodies);
  renew(bodies);
  search_due(bodies);
  if (!due_.empty()) {
    found_.reserve(pairs());
    pairs_.reserve(pairs());
  }
  gather();
  if (!found_.empty()) sort();
  return pairs_;
}

void ContactPairs::search_due(const Bodies& bodies) {
  if (!due_.empty()) pack();
  for (const std::size_t n : due_) search(bodies, neighbours_[n]);
}

bool ContactPairs::all_within() const {
  if (swept_.size() != fragments_.all().size()) return false;
  for (std::size_t f = 0; f < swept_.size(); ++f)
    if (!swept_[f].contains(fragments_.all()[f].reach)) return false;
  return true;
}

void ContactPairs::sweep(const Bodies& bodies) {
  ++sweeps_;
  const std::vector<Fragment>& all = fragments_.all();
  swept_.clear();
  for (const Fragment& each : all) {
    const Vec3 way = steps_ahead * (each.end - each.start);
    const double margin = std::max(2 * bodies[each.body]->settings().thickness, 0.25 * each.longest);
    swept_.push_back(grown(each.reach.merged(each.reach.translated(way)), margin));
  }
  const BoxTree tree(swept_);
  std::vector<Neighbours> before = std::move(neighbours_);
  neighbours_.clear();
  for (std::uint32_t a = 0; a < all.size(); ++a) {
    const ContactBody& body = *bodies[all[a].body];
    const std::size_t begin = neighbours_.size();
    tree.each_in(swept_[a], [&](std::uint32_t b) {
      const bool wanted = a < b || (a == b && body.settings().self);
      if (wanted && body.meets(*bodies[all[b].body]))
        neighbours_.push_back({.a = a, .b = b, .margin = margin_});
    });
    std::sort(neighbours_.begin() + static_cast<std::ptrdiff_t>(begin), neighbours_.end(),
              [](const Neighbours& x, const Neighbours& y) { return x.b < y.b; });
  }
  keep_lists(before);
}

// Those that are neighbours still.
void ContactPairs::keep_lists(std::vector<Neighbours>& before) {
  const auto order = [](const Neighbours& x) { return std::tie(x.a, x.b); };
  auto now = neighbours_.begin();
  for (Neighbours& each : before) {
    while (now != neighbours_.end() && order(*now) < order(each)) ++now;
    if (now != neighbours_.end() && order(*now) == order(each))
      *now = each;
    else
      drop(each);
  }
}

// Which neighbours may touch in this step, which of them are to be searched, and which fragments are to be
// renewed for that: the less they have moved when a list is made, the longer it holds.
void ContactPairs::note_near(const Bodies& bodies, bool further) {
  const std::vector<Fragment>& all = fragments_.all();
  renewal_.assign(all.size(), Renewal::Alone);
  due_.clear();
  for (Neighbours& list : neighbours_) {
    const Fragment &a = all[list.a], &b = all[list.b];
    if (list.a != list.b && !a.reach.intersects(b.reach)) {
      drop(list);
      continue;
    }
    for (const std::uint32_t f : {list.a, list.b})
      if (renewal_[f] == Renewal::Alone) renewal_[f] = Renewal::None;
    if (list.searched && (further || moved(list) <= list.skin)) continue;
    due_.push_back(static_cast<std::size_t>(&list - neighbours_.data()));
    const double faces = (a.triangles_end - a.triangles) + (b.triangles_end - b.triangles);
    // of solids half as much, for which depths are looked for as well
    const double share = bodies[a.body]->solid() || bodies[b.body]->solid() ? 0.125 : 0.25;
    list.skin = list.margin.next(
        std::max(2 * thickness(*bodies[a.body], *bodies[b.body]), share * (a.edges + b.edges) / faces));
    for (const std::uint32_t f : {list.a, list.b})
      if (all[f].moved_at_end > list.skin / 16) renewal_[f] = Renewal::Due;
  }
}

void ContactPairs::renew(const Bodies& bodies) {
  const std::vector<Fragment>& all = fragments_.all();
  const auto lost = [&](std::uint32_t f) { return renewal_[f] == Renewal::Due ? all[f].moved_at_end : 0; };
  if (!due_.empty())
    for (Neighbours& list : neighbours_) list.before += lost(list.a) + lost(list.b);
  for (std::uint32_t f = 0; f < all.size(); ++f) {
    const bool turned = renewal_[f] == Renewal::Alone && all[f].moved_at_end > 0.125 * all[f].longest;
    if (turned || renewal_[f] == Renewal::Due) fragments_.renew(bodies, f);
  }
}

void ContactPairs::drop(Neighbours& list) {
  unused_ += list.end - list.begin;
  unused_edges_ += list.edges_end - list.edges;
  list.begin = list.end = list.edges = list.edges_end = 0;
  list.searched = false;
}

// Puts the lists one after another, if half of the pools is unused.
void ContactPairs::pack() {
  if (2 * (unused_ + unused_edges_) <= pool_.size() + edge_pool_.size()) return;
  const auto pack_one = [&](auto& pool, std::size_t Neighbours::*begin, std::size_t Neighbours::*end) {
    std::remove_reference_t<decltype(pool)> packed;
    packed.reserve(pool.size());
    for (Neighbours& list : neighbours_) {
      const std::size_t first = packed.size();
      packed.insert(packed.end(), pool.begin() + static_cast<std::ptrdiff_t>(list.*begin),
                    pool.begin() + static_cast<std::ptrdiff_t>(list.*end));
      list.*begin = first;
      list.*end = packed.size();
    }
    pool = std::move(packed);
  };
  pack_one(pool_, &Neighbours::begin, &Neighbours::end);
  pack_one(edge_pool_, &Neighbours::edges, &Neighbours::edges_end);
  unused_ = unused_edges_ = 0;
}

double ContactPairs::apart(const Neighbours& list) const {
  if (list.a == list.b) return list.before;
  const Fragment &a = fragments_.all()[list.a], &b = fragments_.all()[list.b];
  const double start = (a.start - b.start - list.between).squaredNorm(),
               end = (a.end - b.end - list.between).squaredNorm();
  return list.before + std::sqrt(std::max(start, end));
}

double ContactPairs::moved(const Neighbours& list) const {
  return fragments_.all()[list.a].moved + fragments_.all()[list.b].moved + apart(list);
}

void ContactPairs::search(const Bodies& bodies, Neighbours& list) {
  ++searches_;
  drop(list);
  const Fragment &a = fragments_.all()[list.a], &b = fragments_.all()[list.b];
  list.searched = true;
  list.reach = list.skin;
  list.before = a.moved_at_end + b.moved_at_end;
  list.between = a.end - b.end;
  list.begin = pool_.size();
  search(bodies, list, a, b);
  if (list.a != list.b) search(bodies, list, b, a);
  list.end = pool_.size();
  list.edges = edge_pool_.size();
  if (edges_ && (a.body != b.body || list.a == list.b)) {
    search_edges(list, a, b);
    if (list.a != list.b) search_edges(list, b, a);
  }
  list.edges_end = edge_pool_.size();
  list.least = std::numeric_limits<double>::infinity();
  for (std::size_t n = list.begin; n < list.end; ++n) list.least = std::min(list.least, pool_[n].clear);
}

// Calls look(item, triangle) for items from `begin` to `end` of one fragment and triangles of the other whose
// boxes meet: around(item), and wide(box of the triangle).
template <class Wide, class Around, class Look>
void ContactPairs::each_near(Neighbours& list, const Fragment& of, const Fragment& with, std::uint32_t begin,
                             std::uint32_t end, const Wide& wide, const Around& around, const Look& look) {
  near_.clear();
  boxes_.clear();
  Box all;
  for (std::uint32_t t = with.triangles; t < with.triangles_end; ++t) {
    const Box box = wide(fragments_.around(fragments_.triangle(t)));
    if (!box.intersects(of.box)) continue;
    near_.push_back(t);
    boxes_.push_back(box);
    all.extend(box);
  }
  if (near_.empty()) return;
  const bool many = near_.size() > 24; // so that a tree is quicker
  const BoxTree tree(many ? boxes_ : std::vector<Box>{});
  std::size_t looks = near_.size();
  for (std::uint32_t item = begin; item < end; ++item) {
    const Box box = around(item);
    if (!all.intersects(box)) continue;
    ++looks;
    const auto look_at = [&](std::uint32_t n) { look(item, near_[n]), ++looks; };
    if (many) {
      tree.each_in(box, look_at);
      continue;
    }
    for (std::uint32_t n = 0; n < near_.size(); ++n)
      if (boxes_[n].intersects(box)) look_at(n);
  }
  list.margin.searched(looks);
}

// For the vertices of one and the triangles of the other.
void ContactPairs::search(const Bodies& bodies, Neighbours& list, const Fragment& of, const Fragment& with) {
  const double reach = list.skin + beside * thickness(*bodies[of.body], *bodies[with.body]);
  const bool solid = bodies[with.body]->solid();
  const auto wide = [&](const Box& box) {
    const double depth = (1 + 2 * deepest) * list.skin + deepest * box.diagonal().norm();
    return grown(box, solid ? std::max(reach, depth) : reach);
  };
  each_near(
      list, of, with, of.vertices, of.vertices_end, wide, [&](std::uint32_t v) { return fragments_.around(v); },
      [&](std::uint32_t v, std::uint32_t t) {
        try_one(*bodies[of.body], *bodies[with.body], list, {v, t});
      });
}

// Adds the two to the pool, unless they do not touch before they have moved by the skin, or in this step.
void ContactPairs::try_one(const ContactBody& body, const ContactBody& other, const Neighbours& list,
                           Candidate found) {
  const ContactFragments::Triangle& triangle = fragments_.triangle(found.triangle);
  const auto& corner = triangle.corner;
  const bool self = list.a == list.b;
  if (self && std::find(corner.begin(), corner.end(), found.vertex) != corner.end()) return;
  const Vec3& x = fragments_.at(found.vertex);
  const TriangleCorners y{fragments_.at(corner[0]), fragments_.at(corner[1]), fragments_.at(corner[2])};
  const Weights w = nearest_in_triangle(y, x);
  const Vec3 off = x - w[0] * y[0] - w[1] * y[1] - w[2] * y[2];
  found.clear = off.norm() - beside * thickness(body, other);
  if (other.solid()) found.clear = std::min(found.clear, clear_of_depth(off, y));
  const double moved = apart(list) + fragments_.moved(found.vertex) + fragments_.moved(triangle);
  if (found.clear > std::max(list.skin, moved)) return;
  if (&body == &other) {
    const Slot v = fragments_.slot(found.vertex);
    const double at_rest = apart_at_rest(body, v, body.faces->triangles()[triangle.number]);
    found.neighbours = at_rest <= body.settings().thickness;
    if (self && at_rest <= 2 * body.settings().thickness) return; // the material joins them
  }
  pool_.push_back(found);
}

void ContactPairs::gather() {
  found_.clear();
  const auto& all = fragments_.all();
  for (Neighbours& list : neighbours_) {
    if (!list.searched || list.begin == list.end || list.least > moved(list)) continue;
    list.margin.passed(list.end - list.begin);
    const double moved_apart = apart(list);
    const Fragment &a = all[list.a], &b = all[list.b];
    for (std::size_t n = list.begin; n < list.end; ++n) {
      const Candidate& each = pool_[n];
      const ContactFragments::Triangle& triangle = fragments_.triangle(each.triangle);
      if (each.clear > moved_apart + fragments_.moved(each.vertex) + fragments_.moved(triangle)) continue;
      const bool of_a = each.vertex >= a.vertices && each.vertex < a.vertices_end;
      found_.push_back({fragments_.rank(each.vertex),
                        {.body = of_a ? a.body : b.body,
                         .vertex = fragments_.slot(each.vertex),
                         .face_body = of_a ? b.body : a.body,
                         .triangle = triangle.number,
                         .neighbours = each.neighbours}});
    }
  }
}

// By counting: each vertex has few.
void ContactPairs::sort() {
  begin_.assign(fragments_.vertices() + 2, 0);
  for (const Found& each : found_) ++begin_[each.rank + 2];
  for (std::size_t n = 2; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
  pairs_.resize(found_.size());
  for (const Found& each : found_) pairs_[begin_[each.rank + 1]++] = each.pair;
  for (std::size_t n = 0; n + 1 < begin_.size(); ++n) {
    const auto at = [&](std::size_t k) { return pairs_.begin() + static_cast<std::ptrdiff_t>(begin_[k]); };
    if (begin_[n + 1] - begin_[n] < 2) continue;
    std::sort(at(n), at(n + 1), [](const ContactPair& x, const ContactPair& y) {
      return x.face_body != y.face_body ? x.face_body < y.face_body : x.triangle < y.triangle;
    });
  }
}

// For the edges of one and the triangles of the other: those that are nearer than the skin.
void ContactPairs::search_edges(Neighbours& list, const Fragment& of, const Fragment& with) {
  const double reach = list.skin;
  each_near(
      list, of, with, of.sides, of.sides_end, [&](const Box& box) { return grown(box, reach); },
      [&](std::uint32_t s) { return fragments_.around(fragments_.side(s)); },
      [&](std::uint32_t s, std::uint32_t t) {
        try_edge(list, {s, t});
      });
}

void ContactPairs::try_edge(const Neighbours& list, EdgeCandidate found) {
  const ContactFragments::Side& side = fragments_.side(found.side);
  const ContactFragments::Triangle& triangle = fragments_.triangle(found.triangle);
  const auto& corner = triangle.corner;
  for (const std::uint32_t end : side)
    if (std::find(corner.begin(), corner.end(), end) != corner.end()) return;
  const Segment x{fragments_.at(side[0]), fragments_.at(side[1])};
  const TriangleCorners y{fragments_.at(corner[0]), fragments_.at(corner[1]), fragments_.at(corner[2])};
  if (apart_by_planes(x, y, list.skin)) return;
  // nearest() is above the distance of edges that are nearly parallel, by this share of them at most.
  const double slack =
      nearly_parallel * std::min((x[1] - x[0]).norm(), (y[1] - y[0]).norm() + (y[2] - y[0]).norm());
  found.apart = passes_through(x, y, 0) ? 0 : nearest(x, y).distance - slack;
  if (found.apart <= list.skin) edge_pool_.push_back(found);
}

// What was not searched, or not far enough, before vertices were pushed.
void ContactPairs::search_further(const Bodies& bodies, const std::vector<double>& pushed) {
  if (std::ranges::all_of(pushed, [](double by) { return by == 0; })) return;
  for (std::uint32_t f = 0; f < pushed.size(); ++f) fragments_.reach_further(f, pushed[f]);
  if (!all_within()) sweep(bodies);
  note_near(bodies, true);
  renew(bodies);
  search_due(bodies);
  for (Neighbours& list : neighbours_) {
    const double most = moved(list) + pushed[list.a] + pushed[list.b];
    if (!list.searched || most <= list.reach) continue;
    const double skin = std::exchange(list.skin, most);
    search(bodies, list);
    list.skin = skin;
  }
}

const std::vector<EdgeFacePair>& ContactPairs::crossing(const Bodies& bodies,
                                                        const std::vector<double>& pushed) {
  crossing_.clear();
  if (!fragments_.anything(bodies)) return crossing_;
  search_further(bodies, pushed);
  const auto& all = fragments_.all();
  for (Neighbours& list : neighbours_) {
    if (list.edges == list.edges_end) continue;
    list.margin.passed(list.edges_end - list.edges);
    const double by = apart(list) + pushed[list.a] + pushed[list.b];
    const Fragment &a = all[list.a], &b = all[list.b];
    for (std::size_t n = list.edges; n < list.edges_end; ++n) {
      const EdgeCandidate& each = edge_pool_[n];
      const ContactFragments::Side& side = fragments_.side(each.side);
      const ContactFragments::Triangle& triangle = fragments_.triangle(each.triangle);
      if (each.apart > by + fragments_.moved(side) + fragments_.moved(triangle)) continue;
      const bool of_a = each.side >= a.sides && each.side < a.sides_end;
      crossing_.push_back({.body = of_a ? a.body : b.body,
                           .edge = {fragments_.slot(side[0]), fragments_.slot(side[1])},
                           .face_body = of_a ? b.body : a.body,
                           .triangle = triangle.number});
    }
  }
  return crossing_;
}

std::size_t ContactPairs::bytes() const {
  return fragments_.bytes() + bytes_of(swept_) + bytes_of(neighbours_) + bytes_of(pool_) +
         bytes_of(edge_pool_) + bytes_of(crossing_) + bytes_of(due_) + bytes_of(renewal_) + bytes_of(boxes_) +
         bytes_of(near_) + bytes_of(found_) + bytes_of(begin_) + bytes_of(pairs_);
}

} // namespace rend
