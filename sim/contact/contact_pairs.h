// The broad phase of contact between bodies and fragments: which vertices may touch which faces in a step.
//
// Faces are triangles (contact_faces.h). Those of each fragment are in a tree of bounding boxes, and these
// trees in a tree above, so that the query of a vertex skips the faces of its own fragment, which are most of
// those near it (box_tree.h). Results are sorted, so that they do not depend on the order of a search.
// (Bullet's btDbvt and FCL would be new dependencies, for single precision or for whole bodies.) The trees are
// static; so pairs are searched with a margin (skin), and again when a vertex has moved by half of it relative
// to the mean of all (Verlet's neighbour lists, Phys. Rev. 159, 1967), or when a map was changed. The pairs
// always include all that touch, so results do not depend on when they were searched.
//
// A pair that was searched at a distance d, and whose vertex and corners have moved by m_v and m_k since then,
// relative to the mean of all, is at
//
//   d − m_v − max m_k
//
// at least. A vertex touches a face from less than 1.5 thicknesses; from behind the face of a solid, at a depth
// g of up to a fifth of √(2 area) (fragment_contact.h). A pair that is farther apart by that is passed over
// without a look at its face. Of the depth two bounds are known, with M = m_v + max m_k:
//
//   g ≤ (e + 2 max m_k)/5          e: the longest edge at the search
//   M ≥ 0.94 d, if M ≤ a/8         a: the smallest height of the triangle then; the vertex was in front
//
// The second: let p' be the point of the face above the vertex x' = p' − g n', and p the same point of it at
// the search. Heights above the plane of the search change by less than a/8, so its normal turns by less than
// tan⁻¹ ⅓, and n'·(x − p) ≥ −|x − p|/3; hence M² ≥ |x − p + g n'|² ≥ r² − ⅔ g r + g² ≥ 8/9 r² with
// r = |x − p| ≥ d.
#pragma once

#include "sim/contact/contact_body.h"

#include <algorithm>
#include <memory>

namespace rend {

struct ContactPair {
  std::uint32_t body = 0; // of the vertex
  Slot vertex = 0;
  std::uint32_t face_body = 0;
  std::uint32_t triangle = 0; // index into the body's ContactFaces::triangles()
  bool neighbours = false;    // closer than the thickness at rest
  double clear = 0; // [m]: the two do not touch while their moves since the search, M, sum to less than this

  void store(Archive& archive);
};

class ContactPairs {
public:
  using Bodies = std::vector<std::unique_ptr<ContactBody>>;

  // The pairs of this step, sorted by body, vertex, body of the face, triangle. For bodies with contact of
  // fragments: pairs of different bodies that do not exclude each other, and of different fragments, and with
  // `self` also those within a fragment that are not neighbours.
  const std::vector<ContactPair>& find(const Bodies& bodies);

  // Whether a pair of the last find() is too far apart to touch within this step.
  bool apart(const Bodies& bodies, const ContactPair& pair) const {
    const auto& corner = bodies[pair.face_body]->faces->triangles()[pair.triangle].vertex;
    const std::vector<double>& moved = of_[pair.face_body].moved;
    const double most = std::max({moved[corner[0]], moved[corner[1]], moved[corner[2]]});
    return pair.clear > of_[pair.body].moved[pair.vertex] + most;
  }
  static constexpr double beside = 1.5;  // distance in thicknesses at which a path misses a face
  static constexpr double deepest = 0.2; // relative to a face's size: the largest penetration of a solid's face

  // The distance that two bodies keep [m].
  static double thickness(const ContactBody& a, const ContactBody& b) {
    return 0.5 * (a.settings().thickness + b.settings().thickness);
  }
  long searches() const { return searches_; }
  std::size_t pairs() const { return pairs_.size(); } // of the last search
  std::size_t bytes() const;
  void store(Archive& archive, const Bodies& bodies); // the faces must be those of the maps

private:
  class FaceTrees;
  struct BodyEntry {                            // per body
    std::vector<Slot> vertices;                 // of its faces, increasing
    std::vector<std::uint32_t> vertex_fragment; // one per entry of `vertices`
    std::vector<std::uint32_t> face_fragment;   // one per triangle
    std::vector<Vec3> there; // [m], positions at the last search, one per entry of `vertices`
    // [m], one per vertex slot, of those of its faces: how far it is from there within this step, at most,
    // relative to the mean of all
    std::vector<double> moved;
    bool several = false; // more than one fragment

    void store(Archive& archive, std::size_t most); // `most`: bound of the number of vertices or triangles
    bool same_lists(const BodyEntry& other) const;  // without the positions
  };
  void check_pair(const Bodies& bodies, std::size_t number) const; // throws ArchiveError
  void list(const ContactBody& body, BodyEntry& of) const;
  bool anything(const Bodies& bodies) const;
  static bool meet(const ContactBody& a, const ContactBody& b) { return !a.terms(b).excluded; }
  bool listed_since_search() const;
  double measure_moves(const Bodies& bodies);
  void search(const Bodies& bodies);
  // for the vertices of b
  void search_for(const Bodies& bodies, std::uint32_t b, const FaceTrees& trees, double reach);
  // entry: index of the vertex in Of::vertices
  bool same_fragment(std::size_t entry, const ContactPair& pair) const;
  bool allowed(const Bodies& bodies, std::size_t entry, const ContactPair& pair) const;
  bool joined(const Bodies& bodies, std::size_t entry, ContactPair& pair) const;

  std::vector<BodyEntry> of_;      // one per body
  std::vector<ContactPair> pairs_; // of the last search, sorted
  double skin_ = 0;                // [m]
  bool listed_ = false;
  long searches_ = 0;
};

} // namespace rend
