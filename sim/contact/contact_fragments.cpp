#include "sim/contact/contact_fragments.h"

#include "sim/topology/count.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace rend {

void ContactFragments::list(const ContactBody& body, BodyEntry& of) {
  const EmbeddedMap& map = *body.body->map;
  const std::vector<std::uint32_t> label = label_fragments(map.map());
  constexpr std::uint32_t none = ~std::uint32_t{0};
  of = {};
  std::vector<std::uint8_t> of_a_face(body.vertices(), 0); // one per vertex slot
  for (const ContactFaces::Triangle& triangle : body.faces->triangles())
    for (Slot v : triangle.vertex) of_a_face[v] = 1;
  std::vector<std::uint32_t> number(label.size(), none); // one per label, of which there are no more than darts
  for (Slot v = 0; v < of_a_face.size(); ++v) {
    if (of_a_face[v] == 0) continue;
    std::uint32_t& fragment = number[label[map.cells(Vertex).first_dart(v).value]];
    if (fragment == none) fragment = of.fragments++;
    of.vertices.push_back(v);
    of.vertex_fragment.push_back(fragment);
  }
  for (const ContactFaces::Triangle& triangle : body.faces->triangles())
    of.face_fragment.push_back(number[label[map.cells(FaceOfVolume).first_dart(triangle.face).value]]);
}

// A mesh obstacle is one fragment, of whatever parts it consists.
void ContactFragments::list_obstacle(const ContactBody& body, BodyEntry& of) {
  of = {};
  of.vertices.resize(body.vertices());
  std::iota(of.vertices.begin(), of.vertices.end(), Slot{0});
  of.vertex_fragment.resize(body.vertices(), 0);
  of.face_fragment.resize(body.faces->triangles().size(), 0);
  of.fragments = 1;
}

bool ContactFragments::update(const ContactBodies& bodies) {
  of_.resize(bodies.size());
  bool changed = !listed_;
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b]->meets_faces() || (listed_ && !bodies[b]->changed)) continue;
    (bodies[b]->body ? list : list_obstacle)(*bodies[b], of_[b]);
    changed = true;
  }
  if (changed) arrange(bodies);
  listed_ = true;
  return changed;
}

bool ContactFragments::anything(const ContactBodies& bodies) const {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const ContactSettings& settings = bodies[b]->settings();
    if (settings.self || (settings.fragments && of_[b].fragments > 1)) return true;
    for (std::size_t c = b + 1; c < bodies.size(); ++c)
      if (bodies[b]->meets(*bodies[c])) return true;
  }
  return false;
}

void ContactFragments::arrange(const ContactBodies& bodies) {
  std::size_t vertices = 0, triangles = 0;
  for (const BodyEntry& of : of_) {
    vertices += of.vertices.size();
    triangles += of.face_fragment.size();
  }
  CHECK(vertices <= ~std::uint32_t{0} && triangles <= ~std::uint32_t{0});
  fragments_.clear();
  slots_.resize(vertices);
  rank_.resize(vertices);
  triangles_.resize(triangles);
  std::uint32_t first_vertex = 0, first_triangle = 0;
  for (std::uint32_t b = 0; b < bodies.size(); ++b) {
    const std::size_t first = fragments_.size();
    of_[b].first = static_cast<std::uint32_t>(first);
    fragments_.resize(first + of_[b].fragments);
    for (const std::uint32_t f : of_[b].vertex_fragment) ++fragments_[first + f].vertices_end;
    for (const std::uint32_t f : of_[b].face_fragment) ++fragments_[first + f].triangles_end;
    for (std::size_t f = first; f < fragments_.size(); ++f) {
      Fragment& fragment = fragments_[f];
      fragment.body = b;
      fragment.vertices = first_vertex;
      fragment.triangles = first_triangle;
      first_vertex += std::exchange(fragment.vertices_end, first_vertex);
      first_triangle += std::exchange(fragment.triangles_end, first_triangle);
    }
    place(*bodies[b], of_[b], first);
  }
  for (std::vector<Vec3>* each : {&from_, &at_, &there_}) each->resize(vertices);
  moved_.assign(vertices, 0);
  if (with_sides_) list_sides();
  fresh_ = true;
}

void ContactFragments::list_sides() {
  sides_.clear();
  for (Fragment& fragment : fragments_) {
    fragment.sides = static_cast<std::uint32_t>(sides_.size());
    for (std::uint32_t t = fragment.triangles; t < fragment.triangles_end; ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t a = triangles_[t].corner[k], b = triangles_[t].corner[(k + 1) % 3];
        sides_.push_back({std::min(a, b), std::max(a, b)});
      }
    const auto begin = sides_.begin() + fragment.sides;
    std::sort(begin, sides_.end());
    sides_.erase(std::unique(begin, sides_.end()), sides_.end());
    fragment.sides_end = static_cast<std::uint32_t>(sides_.size());
  }
}

std::optional<std::uint32_t> ContactFragments::fragment_of(std::size_t body, Slot vertex) const {
  const BodyEntry& of = of_[body];
  const auto at = std::lower_bound(of.vertices.begin(), of.vertices.end(), vertex);
  if (at == of.vertices.end() || *at != vertex) return {};
  return of.first + of.vertex_fragment[static_cast<std::size_t>(at - of.vertices.begin())];
}

// Puts a body's vertices and triangles where its fragments have room for them, whose ends are their beginnings.
void ContactFragments::place(const ContactBody& body, const BodyEntry& of, std::size_t first) {
  number_.resize(std::max(number_.size(), body.vertices()));
  const std::uint32_t before = of.vertices.empty() ? 0 : fragments_[first].vertices; // vertices of other bodies
  for (std::uint32_t n = 0; n < of.vertices.size(); ++n) {
    const std::uint32_t number = fragments_[first + of.vertex_fragment[n]].vertices_end++;
    slots_[number] = of.vertices[n];
    rank_[number] = before + n;
    number_[of.vertices[n]] = number;
  }
  for (std::uint32_t t = 0; t < of.face_fragment.size(); ++t) {
    const auto& corner = body.faces->triangles()[t].vertex;
    triangles_[fragments_[first + of.face_fragment[t]].triangles_end++] = {
        {number_[corner[0]], number_[corner[1]], number_[corner[2]]}, t};
  }
}

void ContactFragments::measure(const ContactBodies& bodies) {
  for (std::uint32_t f = 0; f < fragments_.size(); ++f) {
    if (!fresh_ && bodies[fragments_[f].body]->fixed()) continue; // as it was measured
    gather(*bodies[fragments_[f].body], fragments_[f]);
    if (fresh_)
      renew(bodies, f);
    else
      measure_moves(*bodies[fragments_[f].body], fragments_[f]);
  }
  fresh_ = false;
}

// Its positions of this step.
void ContactFragments::gather(const ContactBody& body, Fragment& fragment) {
  Vec3 start = Vec3::Zero(), end = Vec3::Zero();
  Box box;
  for (std::uint32_t n = fragment.vertices; n < fragment.vertices_end; ++n) {
    from_[n] = body.from(slots_[n]);
    at_[n] = body.position(slots_[n]).vec();
    start += from_[n];
    end += at_[n];
    box.extend(from_[n]).extend(at_[n]);
  }
  const double count = fragment.vertices_end - fragment.vertices;
  fragment.start = start / count;
  fragment.end = end / count;
  fragment.box = box;
}

void ContactFragments::measure_moves(const ContactBody& body, Fragment& fragment) {
  double most = 0, most_at_end = 0; // [m²]
  for (std::uint32_t n = fragment.vertices; n < fragment.vertices_end; ++n) {
    const double start = (from_[n] - fragment.start - there_[n]).squaredNorm(),
                 end = (at_[n] - fragment.end - there_[n]).squaredNorm();
    moved_[n] = std::sqrt(std::max(start, end));
    most = std::max({most, start, end});
    most_at_end = std::max(most_at_end, end);
  }
  fragment.moved = std::sqrt(most);
  fragment.moved_at_end = std::sqrt(most_at_end);
  const double edge = body.solid() ? fragment.longest + 2 * fragment.moved : 0;
  const double reach = std::max(0.5 * beside * body.settings().thickness, deepest * edge);
  fragment.reach = grown(fragment.box, reach);
}

void ContactFragments::renew(const ContactBodies& bodies, std::uint32_t f) {
  Fragment& fragment = fragments_[f];
  for (std::uint32_t n = fragment.vertices; n < fragment.vertices_end; ++n) there_[n] = at_[n] - fragment.end;
  fragment.longest = fragment.edges = 0;
  for (std::uint32_t t = fragment.triangles; t < fragment.triangles_end; ++t) {
    double longest = 0; // [m²]
    for (std::size_t k = 0; k < 3; ++k)
      longest = std::max(longest,
                         (at_[triangles_[t].corner[k]] - at_[triangles_[t].corner[(k + 1) % 3]]).squaredNorm());
    fragment.edges += std::sqrt(longest);
    fragment.longest = std::max(fragment.longest, longest);
  }
  fragment.longest = std::sqrt(fragment.longest);
  measure_moves(*bodies[fragment.body], fragment);
}

std::size_t ContactFragments::bytes() const {
  std::size_t sum = bytes_of(fragments_) + bytes_of(slots_) + bytes_of(rank_) + bytes_of(from_) +
                    bytes_of(at_) + bytes_of(there_) + bytes_of(moved_) + bytes_of(triangles_) +
                    bytes_of(sides_) + bytes_of(number_);
  for (const BodyEntry& of : of_)
    sum += bytes_of(of.vertices) + bytes_of(of.vertex_fragment) + bytes_of(of.face_fragment);
  return sum;
}

} // namespace rend
