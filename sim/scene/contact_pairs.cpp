#include "sim/scene/contact_pairs.h"

#include "sim/base/archive.h"
#include "sim/scene/obstacle.h"
#include "sim/topology/count.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <unsupported/Eigen/BVH>

namespace rend {
namespace {

using Bounds = Eigen::AlignedBox3d;

struct Leaf {
  std::uint32_t body, triangle;
};
using Tree = Eigen::KdBVH<double, 3, Leaf>;

// Where it is in the step.
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

// Faces whose boxes meet one box.
struct Query {
  Bounds box;
  std::vector<Leaf>& found;
  bool intersectVolume(const Bounds& volume) const { return volume.intersects(box); }
  bool intersectObject(const Leaf& face) const {
    found.push_back(face);
    return false; // go on
  }
};

// Whether they may come as near as `thickness` before one of them has moved by half the skin: by how far they
// are apart at the end of the step, and how far they moved against each other in it.
bool may_meet(const ContactBody& body, Slot v, const ContactBody& other, const ContactFaces::Triangle& triangle,
              double reach) {
  const Vec3 x = body.position(v), moved = x - body.from(v);
  TriangleCorners y;
  double most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    y[k] = other.position(triangle.vertex[k]);
    most = std::max(most, (moved - (y[k] - other.from(triangle.vertex[k]))).squaredNorm());
  }
  const Weights w = nearest_in_triangle(y, x);
  return (x - w[0] * y[0] - w[1] * y[1] - w[2] * y[2]).norm() <= reach + std::sqrt(most);
}

bool is_corner(Slot v, const ContactFaces::Triangle& triangle) {
  return std::find(triangle.vertex.begin(), triangle.vertex.end(), v) != triangle.vertex.end();
}

// [m], of a vertex from a triangle of the same body.
double apart_at_rest(const ContactBody& body, Slot v, const ContactFaces::Triangle& triangle) {
  const auto& rest = body.body->map->rest();
  const TriangleCorners x{rest[triangle.vertex[0]], rest[triangle.vertex[1]], rest[triangle.vertex[2]]};
  const Weights w = nearest_in_triangle(x, rest[v]);
  return (rest[v].vec() - w[0] * x[0] - w[1] * x[1] - w[2] * x[2]).norm();
}

} // namespace

void ContactPairs::list(const ContactBody& body, Of& of) const {
  const EmbeddedMap& map = *body.body->map;
  const std::vector<std::uint32_t> label = label_fragments(map.map());
  of.vertices.clear();
  of.vertex_fragment.clear();
  of.face_fragment.clear();
  of.several = false;
  for (const ContactFaces::Triangle& triangle : body.faces.triangles()) {
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
  if (!anything(bodies))
    pairs_.clear();
  else if (changed || stale(bodies))
    search(bodies);
  return pairs_;
}

bool ContactPairs::anything(const Bodies& bodies) const {
  std::size_t asking = 0;
  bool several = false;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b]->settings().fragments) continue;
    ++asking;
    several = several || of_[b].several || bodies[b]->settings().self;
  }
  return several || asking > 1;
}

// Whether something moved by half the skin since the last search. What all do together brings nothing nearer.
bool ContactPairs::stale(const Bodies& bodies) const {
  Vec3 mean = Vec3::Zero();
  std::size_t count = 0;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const Of& of = of_[b];
    if (of.there.size() != of.vertices.size()) return true;
    for (std::size_t n = 0; n < of.vertices.size(); ++n)
      mean += bodies[b]->position(of.vertices[n]).vec() - of.there[n];
    count += of.vertices.size();
  }
  if (count > 0) mean /= static_cast<double>(count);
  const double most = 0.25 * skin_ * skin_;
  for (std::size_t b = 0; b < bodies.size(); ++b)
    for (std::size_t n = 0; n < of_[b].vertices.size(); ++n)
      if ((bodies[b]->position(of_[b].vertices[n]).vec() - of_[b].there[n] - mean).squaredNorm() > most)
        return true;
  return false;
}

void ContactPairs::search(const Bodies& bodies) {
  ++searches_;
  std::vector<Leaf> faces;
  std::vector<Bounds> boxes;
  double thickness = 0, sizes = 0;
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b]->settings().fragments) continue;
    thickness = std::max(thickness, bodies[b]->settings().thickness);
    const auto& triangles = bodies[b]->faces.triangles();
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      faces.push_back({b, t});
      boxes.push_back(around(*bodies[b], triangles[t]));
      sizes += boxes.back().diagonal().norm();
    }
  }
  pairs_.clear();
  if (faces.empty()) return;
  skin_ = std::max(2 * thickness, 0.25 * sizes / static_cast<double>(faces.size()));
  for (Bounds& box : boxes) box = grown(box, skin_ + thickness);
  const Tree tree(faces.begin(), faces.end(), boxes.begin(), boxes.end());
  std::vector<Leaf> found;
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    Of& of = of_[b];
    of.there.clear();
    for (std::size_t n = 0; n < of.vertices.size(); ++n) {
      const Slot v = of.vertices[n];
      of.there.push_back(bodies[b]->position(v));
      found.clear();
      Query query{around(*bodies[b], v), found};
      Eigen::BVIntersect(tree, query);
      for (const Leaf& face : found) {
        ContactPair pair{b, v, face.body, face.triangle};
        const ContactFaces::Triangle& triangle = bodies[face.body]->faces.triangles()[face.triangle];
        if (allowed(bodies, n, pair) &&
            may_meet(*bodies[b], v, *bodies[face.body], triangle, skin_ + thickness) &&
            !joined(bodies, n, pair))
          pairs_.push_back(pair);
      }
    }
  }
  std::sort(pairs_.begin(), pairs_.end(), [](const ContactPair& a, const ContactPair& b) {
    return std::tie(a.body, a.vertex, a.face_body, a.triangle) <
           std::tie(b.body, b.vertex, b.face_body, b.triangle);
  });
}

bool ContactPairs::same_fragment(std::size_t entry, const ContactPair& pair) const {
  const Of& of = of_[pair.body];
  return pair.body == pair.face_body && of.vertex_fragment[entry] == of.face_fragment[pair.triangle];
}

bool ContactPairs::allowed(const Bodies& bodies, std::size_t entry, const ContactPair& pair) const {
  if (!same_fragment(entry, pair)) return true;
  const ContactBody& body = *bodies[pair.body];
  return body.settings().self && !is_corner(pair.vertex, body.faces.triangles()[pair.triangle]);
}

// Whether what joins them holds them apart; finds out whether they are neighbours.
bool ContactPairs::joined(const Bodies& bodies, std::size_t entry, ContactPair& pair) const {
  if (pair.body != pair.face_body) return false;
  const ContactBody& body = *bodies[pair.body];
  const double apart = apart_at_rest(body, pair.vertex, body.faces.triangles()[pair.triangle]);
  pair.neighbours = apart <= body.settings().thickness;
  return same_fragment(entry, pair) && apart <= 2 * body.settings().thickness;
}

void ContactPair::store(Archive& archive) {
  archive(body, vertex, face_body, triangle, neighbours);
}

void ContactPairs::Of::store(Archive& archive) {
  archive(vertices, vertex_fragment, face_fragment, there, several);
}

void ContactPairs::store(Archive& archive) {
  archive(of_, pairs_, skin_, listed_, searches_);
}

std::size_t ContactPairs::bytes() const {
  std::size_t sum = bytes_of(pairs_);
  for (const Of& of : of_)
    sum +=
        bytes_of(of.vertices) + bytes_of(of.vertex_fragment) + bytes_of(of.face_fragment) + bytes_of(of.there);
  return sum;
}

} // namespace rend
