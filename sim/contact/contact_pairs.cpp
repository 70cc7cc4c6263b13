#include "sim/contact/contact_pairs.h"

#include "sim/base/archive.h"
#include "sim/contact/box_tree.h"
#include "sim/outside/obstacle.h"
#include "sim/topology/count.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace rend {
namespace {

using Bounds = BoxTree::Box;

// The bounding box of its motion in the step.
Bounds around(const ContactBody& body, Slot v) {
  return Bounds(body.from(v)).extend(body.position(v).vec());
}

Bounds around(const ContactBody& body, const ContactFaces::Triangle& triangle) {
  Bounds box;
  for (Slot v : triangle.vertex) box.extend(around(body, v));
  return box;
}

Bounds grown(const Bounds& box, double by) {
  return {box.min() - Vec3::Constant(by), box.max() + Vec3::Constant(by)};
}

// By how much both may move until the vertex may be as deep behind the face of a solid as it is still seen: the
// larger of two bounds. `off` [m]: from the nearest point of the face.
double clear_of_depth(const Vec3& off, const TriangleCorners& y) {
  constexpr double deepest = ContactPairs::deepest;
  const Vec3 area = (y[1] - y[0]).cross(y[2] - y[0]);
  double longest = 0;
  for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, (y[k] - y[(k + 1) % 3]).norm());
  const double by_size = (off.norm() - deepest * longest) / (1 + 2 * deepest);
  if (longest == 0 || off.dot(area) < 0) return by_size;
  return std::max(by_size, std::min(0.94 * off.norm(), area.norm() / (8 * longest)));
}

// ContactPair::clear; none: they do not meet before one of them has moved by half the skin. From their distance
// at the end of the step, and their relative motion in it.
std::optional<double> clearance(const ContactBody& body, Slot v, const ContactBody& other,
                                const ContactFaces::Triangle& triangle, double reach) {
  const Vec3 x = body.position(v), moved = x - body.from(v);
  TriangleCorners y;
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    y[k] = other.position(triangle.vertex[k]);
    most = std::max(most, (moved - (y[k] - other.from(triangle.vertex[k]))).squaredNorm());
  }
  const Weights w = nearest_in_triangle(y, x);
  const Vec3 off = x - w[0] * y[0] - w[1] * y[1] - w[2] * y[2];
  const double distance = off.norm();
  if (!(distance <= reach + std::sqrt(most))) return {};
  const double clear = distance - ContactPairs::beside * ContactPairs::thickness(body, other);
  const bool solid = other.body->map->dimension() == 3;
  return std::max(0.0, solid ? std::min(clear, clear_of_depth(off, y)) : clear);
}

bool is_corner(Slot v, const ContactFaces::Triangle& triangle) {
  return std::find(triangle.vertex.begin(), triangle.vertex.end(), v) != triangle.vertex.end();
}

// [m], distance of a vertex from a triangle of the same body at rest.
double apart_at_rest(const ContactBody& body, Slot v, const ContactFaces::Triangle& triangle) {
  const auto& rest = body.body->map->rest();
  const TriangleCorners x{rest[triangle.vertex[0]], rest[triangle.vertex[1]], rest[triangle.vertex[2]]};
  const Weights w = nearest_in_triangle(x, rest[v]);
  return (rest[v].vec() - w[0] * x[0] - w[1] * x[1] - w[2] * x[2]).norm();
}

} // namespace

// All faces, those of each fragment in a tree of their own, and those trees in one: most faces near a vertex
// are those of its own fragment, and are skipped as a whole.
class ContactPairs::FaceTrees {
public:
  struct Face {
    std::uint32_t body, fragment, triangle;
  };
  FaceTrees(std::vector<Face>&& faces, const Bodies& bodies, double margin) : faces_(std::move(faces)) {
    std::stable_sort(faces_.begin(), faces_.end(), [](const Face& a, const Face& b) {
      return std::tie(a.body, a.fragment) < std::tie(b.body, b.fragment);
    });
    std::vector<Bounds> boxes, whole; // of the faces of a fragment, of each fragment
    for (std::size_t begin = 0, end = 0; begin < faces_.size(); begin = end) {
      boxes.clear();
      for (; end < faces_.size() && faces_[end].body == faces_[begin].body &&
             faces_[end].fragment == faces_[begin].fragment;
           ++end) {
        const ContactBody& body = *bodies[faces_[end].body];
        boxes.push_back(grown(around(body, body.faces->triangles()[faces_[end].triangle]), margin));
      }
      first_.push_back(static_cast<std::uint32_t>(begin));
      trees_.emplace_back(boxes);
      whole.push_back(trees_.back().bounds());
    }
    fragments_ = BoxTree(whole);
  }

  // Calls f(face) for the faces whose boxes intersect this one, without the fragments for which skip(any face
  // of it) is true.
  template <class Skip, class F> void each_near(const Bounds& box, const Skip& skip, const F& f) const {
    fragments_.each_in(box, [&](std::uint32_t n) {
      if (skip(faces_[first_[n]])) return;
      trees_[n].each_in(box, [&](std::uint32_t face) { f(faces_[first_[n] + face]); });
    });
  }

private:
  std::vector<Face> faces_;          // sorted by body and fragment
  std::vector<BoxTree> trees_;       // one per fragment
  std::vector<std::uint32_t> first_; // one per fragment: its first face
  BoxTree fragments_;
};

void ContactPairs::list(const ContactBody& body, BodyEntry& of) const {
  const EmbeddedMap& map = *body.body->map;
  const std::vector<std::uint32_t> label = label_fragments(map.map());
  of.vertices.clear();
  of.vertex_fragment.clear();
  of.face_fragment.clear();
  of.several = false;
  for (const ContactFaces::Triangle& triangle : body.faces->triangles()) {
    of.vertices.insert(of.vertices.end(), triangle.vertex.begin(), triangle.vertex.end());
    of.face_fragment.push_back(label[map.cells(FaceOfVolume).first_dart(triangle.face).value]);
    of.several = of.several || of.face_fragment.back() != of.face_fragment.front();
  }
  std::sort(of.vertices.begin(), of.vertices.end());
  of.vertices.erase(std::unique(of.vertices.begin(), of.vertices.end()), of.vertices.end());
  for (Slot v : of.vertices) of.vertex_fragment.push_back(label[map.cells(Vertex).first_dart(v).value]);
}

const std::vector<ContactPair>& ContactPairs::find(const Bodies& bodies) {
  of_.resize(bodies.size());
  bool changed = !listed_;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b]->settings().fragments || (listed_ && !bodies[b]->changed)) continue;
    list(*bodies[b], of_[b]);
    changed = true;
  }
  listed_ = true;
  if (!anything(bodies)) {
    pairs_.clear();
  } else if (changed || listed_since_search() || measure_moves(bodies) > 0.25 * skin_ * skin_) {
    search(bodies);
    measure_moves(bodies);
  }
  return pairs_;
}

bool ContactPairs::anything(const Bodies& bodies) const {
  const auto asks = [&](std::size_t b) { return bodies[b]->settings().fragments; };
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!asks(b)) continue;
    if (of_[b].several || bodies[b]->settings().self) return true;
    for (std::size_t c = b + 1; c < bodies.size(); ++c)
      if (asks(c) && meet(*bodies[b], *bodies[c])) return true;
  }
  return false;
}

bool ContactPairs::listed_since_search() const {
  return std::ranges::any_of(of_, [](const BodyEntry& of) { return of.there.size() != of.vertices.size(); });
}

// Relative to the mean of all, at the start of the step and at its end. The largest square at the end [m²].
double ContactPairs::measure_moves(const Bodies& bodies) {
  Vec3 mean_start = Vec3::Zero(), mean_end = Vec3::Zero();
  std::size_t count = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const BodyEntry& of = of_[b];
    for (std::size_t n = 0; n < of.vertices.size(); ++n) {
      mean_start += bodies[b]->from(of.vertices[n]) - of.there[n];
      mean_end += bodies[b]->position(of.vertices[n]).vec() - of.there[n];
    }
    count += of.vertices.size();
  }
  if (count > 0) mean_start /= static_cast<double>(count);
  if (count > 0) mean_end /= static_cast<double>(count);
  double most = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    BodyEntry& of = of_[b];
    if (of.vertices.empty()) continue;
    of.moved.resize(bodies[b]->vertices());
    for (std::size_t n = 0; n < of.vertices.size(); ++n) {
      const Slot v = of.vertices[n];
      const double start = (bodies[b]->from(v) - of.there[n] - mean_start).squaredNorm(),
                   end = (bodies[b]->position(v).vec() - of.there[n] - mean_end).squaredNorm();
      of.moved[v] = std::sqrt(std::max(start, end));
      most = std::max(most, end);
    }
  }
  return most;
}

void ContactPairs::search(const Bodies& bodies) {
  ++searches_;
  std::vector<FaceTrees::Face> faces;
  double thickness = 0, sizes = 0;
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b]->settings().fragments) continue;
    thickness = std::max(thickness, bodies[b]->settings().thickness);
    const auto& triangles = bodies[b]->faces->triangles();
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      faces.push_back({b, of_[b].face_fragment[t], t});
      sizes += around(*bodies[b], triangles[t]).diagonal().norm();
    }
  }
  pairs_.clear();
  if (faces.empty()) return;
  skin_ = std::max(2 * thickness, 0.25 * sizes / static_cast<double>(faces.size()));
  const FaceTrees trees(std::move(faces), bodies, skin_ + thickness);
  for (std::uint32_t b = 0; b < bodies.size(); ++b) search_for(bodies, b, trees, skin_ + thickness);
}

void ContactPairs::search_for(const Bodies& bodies, std::uint32_t b, const FaceTrees& trees, double reach) {
  BodyEntry& of = of_[b];
  of.there.clear();
  for (std::size_t n = 0; n < of.vertices.size(); ++n) {
    const Slot v = of.vertices[n];
    of.there.push_back(bodies[b]->position(v));
    const std::size_t begin = pairs_.size();
    const auto passes = [&](const FaceTrees::Face& face) {
      const bool own = face.body == b && face.fragment == of.vertex_fragment[n] && !bodies[b]->settings().self;
      return own || !meet(*bodies[b], *bodies[face.body]);
    };
    trees.each_near(around(*bodies[b], v), passes, [&](const FaceTrees::Face& face) {
      ContactPair pair{b, v, face.body, face.triangle};
      const ContactFaces::Triangle& triangle = bodies[face.body]->faces->triangles()[face.triangle];
      if (!allowed(bodies, n, pair)) return;
      const auto clear = clearance(*bodies[b], v, *bodies[face.body], triangle, reach);
      if (!clear || joined(bodies, n, pair)) return;
      pair.clear = *clear;
      pairs_.push_back(pair);
    });
    std::sort(pairs_.begin() + static_cast<std::ptrdiff_t>(begin), pairs_.end(),
              [](const ContactPair& a, const ContactPair& other) {
                return std::tie(a.face_body, a.triangle) < std::tie(other.face_body, other.triangle);
              });
  }
}

bool ContactPairs::same_fragment(std::size_t entry, const ContactPair& pair) const {
  const BodyEntry& of = of_[pair.body];
  return pair.body == pair.face_body && of.vertex_fragment[entry] == of.face_fragment[pair.triangle];
}

bool ContactPairs::allowed(const Bodies& bodies, std::size_t entry, const ContactPair& pair) const {
  if (!same_fragment(entry, pair)) return true;
  const ContactBody& body = *bodies[pair.body];
  return body.settings().self && !is_corner(pair.vertex, body.faces->triangles()[pair.triangle]);
}

// Whether the pair is excluded because the material connects it; determines whether they are neighbours.
bool ContactPairs::joined(const Bodies& bodies, std::size_t entry, ContactPair& pair) const {
  if (pair.body != pair.face_body) return false;
  const ContactBody& body = *bodies[pair.body];
  const double apart = apart_at_rest(body, pair.vertex, body.faces->triangles()[pair.triangle]);
  pair.neighbours = apart <= body.settings().thickness;
  return same_fragment(entry, pair) && apart <= 2 * body.settings().thickness;
}

void ContactPair::store(Archive& archive) {
  archive(body, vertex, face_body, triangle, neighbours, clear);
}

void ContactPairs::BodyEntry::store(Archive& archive, std::size_t most) {
  constexpr const char* what = "contact is of more vertices or faces than the body has";
  archive.list(vertices, most, what);
  archive.list(vertex_fragment, most, what);
  archive.list(face_fragment, most, what);
  archive.list(there, most, what);
  archive(several);
}

bool ContactPairs::BodyEntry::same_lists(const BodyEntry& other) const {
  return vertices == other.vertices && vertex_fragment == other.vertex_fragment &&
         face_fragment == other.face_fragment && several == other.several;
}

void ContactPairs::store(Archive& archive, const Bodies& bodies) {
  std::uint64_t lists = of_.size(), pairs = pairs_.size();
  archive(lists);
  refuse_unless(lists == 0 || lists == bodies.size(), "contact is of more or fewer bodies");
  of_.resize(lists);
  for (std::size_t b = 0; b < of_.size(); ++b) {
    of_[b].store(archive, bodies[b]->body->map->map().capacity());
    if (!archive.reading()) continue;
    BodyEntry now; // from the current map
    if (bodies[b]->settings().fragments) list(*bodies[b], now);
    refuse_unless(of_[b].same_lists(now), "contact is of other vertices or faces than the body has");
  }
  archive(pairs);
  if (archive.reading()) pairs_.clear();
  for (std::size_t n = 0; n < pairs; ++n) {
    archive(archive.reading() ? pairs_.emplace_back() : pairs_[n]);
    if (archive.reading()) check_pair(bodies, n);
  }
  archive(skin_, listed_, searches_);
  if (!archive.reading()) return;
  refuse_unless(skin_ >= 0 && is_count(searches_), "contact was looked for nowhere, or less often than never");
  refuse_unless(listed_ == !of_.empty(), "contact knows nothing of its bodies");
}

// Pairs are sorted, and their vertices and triangles exist.
void ContactPairs::check_pair(const Bodies& bodies, std::size_t number) const {
  const ContactPair& pair = pairs_[number];
  refuse_unless(pair.body < of_.size() && pair.face_body < of_.size(),
                "contact is between bodies that are not there");
  const std::vector<Slot>& vertices = of_[pair.body].vertices;
  refuse_unless(std::binary_search(vertices.begin(), vertices.end(), pair.vertex),
                "contact is of a vertex that is not there");
  refuse_unless(pair.triangle < bodies[pair.face_body]->faces->triangles().size(),
                "contact is with a face that is not there");
  refuse_unless(pair.clear >= 0 && std::isfinite(pair.clear),
                "contact is of a vertex and a face at no possible distance");
  const auto order = [](const ContactPair& p) { return std::tie(p.body, p.vertex, p.face_body, p.triangle); };
  refuse_unless(number == 0 || order(pairs_[number - 1]) < order(pair),
                "contact is listed in disorder, or twice");
}

std::size_t ContactPairs::bytes() const {
  std::size_t sum = bytes_of(pairs_);
  for (const BodyEntry& of : of_)
    sum += bytes_of(of.vertices) + bytes_of(of.vertex_fragment) + bytes_of(of.face_fragment) +
           bytes_of(of.there) + bytes_of(of.moved);
  return sum;
}

} // namespace rend
