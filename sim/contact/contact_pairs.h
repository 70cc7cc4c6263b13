// The broad phase of contact between bodies and fragments: which vertices may touch which faces in a step.
//
// Faces are triangles (contact_faces.h), and lists of near ones are kept on two levels (Verlet's neighbour
// lists, Phys. Rev. 159, 1967), so that what moves is searched where it is, and the rest is left alone:
//
//   neighbours   pairs of fragments whose boxes, grown by a margin and by their motion in some steps to come,
//                intersect; swept anew by a tree of these boxes (box_tree.h) when a fragment has left its own
//   candidates   of two neighbours that may touch in this step, by their boxes of it (contact_fragments.h):
//                pairs of vertex and triangle, searched with a margin (skin), and again when these two
//                fragments have used it up; with `self` also those of a fragment and itself
//
// What has no neighbour costs one look at its vertices a step. A step is given the candidates that may touch
// within it, sorted, so that they do not depend on the order of a search. They always include all that touch,
// so results do not depend on when they were searched: nothing of this is stored in a checkpoint. (Bullet's
// btDbvt and FCL would be new dependencies, for single precision or for whole bodies.)
//
// A candidate that was searched at a distance d, whose vertex and corners have since then moved by m_v and m_k
// relative to the means of their fragments, and these by D relative to each other, is at
//
//   d − M,   M = m_v + max m_k + D
//
// at least. Moves of a fragment are known since it was renewed (contact_fragments.h); the largest one before
// that is added to M, by the triangle inequality. A candidate is one that may touch while M is less than the
// skin, or in the step of the search. A vertex touches a face from less than 1.5 thicknesses; from behind the
// face of a solid, at a depth g of up to a fifth of √(2 area) (fragment_contact.h). Of the depth two bounds are
// known:
//
//   g ≤ (e + 2 M)/5                e: the longest edge at the search
//   M ≥ q d, if M ≤ a/p            a: the smallest height of the triangle then; the vertex was in front
//
// The second: let p' be the point of the face above the vertex x' = p' − g n', and y the same point of it at
// the search. Heights above the plane of the search change by less than δ = a/p, so its normal turns by less
// than tan⁻¹ s, s = 2δ/(a − 2δ) = 2/(p − 2), and n'·(x − y) ≥ −c r with r = |x − y| ≥ d and c = s/√(1 + s²);
// hence M² ≥ |x − y + g n'|² ≥ r² − 2 c g r + g² ≥ (1 − c²) r², q = √(1 − c²) = 1/√(1 + s²). With p = 8, 6, 4:
// s = 1/3, 1/2, 1 and q = 0.94, 0.89, 0.70.
//
// An edge and a face that were at a distance d at a search are at d − M at least, less what contact has pushed
// their fragments by since M was measured: they may cross in a step where that is not positive. Those that were
// farther apart than the two were searched do not: they are searched again where M and the pushes exceed that.
#pragma once

#include "sim/contact/contact_fragments.h"
#include "sim/contact/search_margin.h"

namespace rend {

struct ContactPair {
  std::uint32_t body = 0; // of the vertex
  Slot vertex = 0;
  std::uint32_t face_body = 0;
  std::uint32_t triangle = 0; // index into the body's ContactFaces::triangles()
  bool neighbours = false;    // closer than the thickness at rest
};

struct EdgeFacePair {
  std::uint32_t body = 0; // of the edge
  std::array<Slot, 2> edge{};
  std::uint32_t face_body = 0;
  std::uint32_t triangle = 0; // index into the body's ContactFaces::triangles()
  auto operator<=>(const EdgeFacePair&) const = default;
};

class ContactPairs {
public:
  using Bodies = ContactBodies;

  // `edges`: pairs of edges and faces are listed as well. `margin`: that of any two in their first search.
  explicit ContactPairs(bool edges = false, SearchMargin margin = {})
      : fragments_(edges), edges_(edges), margin_(margin) {}

  // The pairs that may touch within this step, sorted by body, vertex, body of the face, triangle. For bodies
  // with contact of fragments: pairs of different bodies that do not exclude each other, and of different
  // fragments, and with `self` also those within a fragment that are not neighbours.
  const std::vector<ContactPair>& find(const Bodies& bodies);

  // Once find() was called, and vertices have been moved since then, those of each fragment by `pushed` [m] at
  // most: the edges and faces of different bodies, and with `self` of one fragment, that may go through
  // each other in this step. In the order of the lists, which depends on when they were searched.
  const std::vector<EdgeFacePair>& crossing(const Bodies& bodies, const std::vector<double>& pushed);
  const ContactFragments& fragments() const { return fragments_; }

  // The distance that two bodies keep [m]; from an obstacle that of the body.
  static double thickness(const ContactBody& a, const ContactBody& b) {
    if (!a.body || !b.body) return (a.body ? a : b).settings().thickness;
    return 0.5 * (a.settings().thickness + b.settings().thickness);
  }
  void forget() { fragments_.forget(); } // all lists: the next step searches anew
  long sweeps() const { return sweeps_; }
  long searches() const { return searches_; }                  // of two neighbours, or of one with itself
  std::size_t pairs() const { return pool_.size() - unused_; } // candidates of the last step
  std::size_t bytes() const;

private:
  static constexpr double steps_ahead = 16; // of motion, in the boxes of a sweep
  using Box = ContactFragments::Box;
  using Fragment = ContactFragments::Fragment;
  struct Candidate {
    std::uint32_t vertex = 0, triangle = 0; // numbers of ContactFragments
    double clear = 0;                       // [m]: the two do not touch while M is less than this
    bool neighbours = false;
  };
  struct EdgeCandidate {
    std::uint32_t side = 0, triangle = 0; // numbers of ContactFragments
    double apart = 0;                     // [m], at the search
  };
  struct Found {
    std::uint32_t rank = 0; // of its vertex among all
    ContactPair pair;
  };
  struct Neighbours {
    std::uint32_t a = 0, b = 0;           // fragments, a < b; a = b: `self`
    bool searched = false;                // and near ever since
    std::size_t begin = 0, end = 0;       // of their candidates in the pool
    std::size_t edges = 0, edges_end = 0; // in the pool of edges
    SearchMargin margin = {};
    double skin = 0;             // [m]: searched again when M exceeds it
    double reach = 0;            // [m]: how far it was searched; at least the skin
    double least = 0;            // [m]: `clear` of a candidate
    double before = 0;           // [m], part of M: before their renewals
    Vec3 between = Vec3::Zero(); // [m]: of their means at the search
  };

  // of the neighbours
  void sweep(const Bodies& bodies);
  bool all_within() const; // the boxes of the last sweep
  void keep_lists(std::vector<Neighbours>& before);
  void note_near(const Bodies& bodies, bool further = false); // further: none searched in this step
  void renew(const Bodies& bodies);
  // of the candidates
  void drop(Neighbours& list);
  void pack();
  void search_due(const Bodies& bodies);
  double apart(const Neighbours& list) const; // [m]: M but for the moves of vertex and corners
  double moved(const Neighbours& list) const; // [m]: M, at most
  template <class Wide, class Around, class Look>
  void each_near(Neighbours& list, const Fragment& of, const Fragment& with, std::uint32_t begin,
                 std::uint32_t end, const Wide& wide, const Around& around, const Look& look);
  void search(const Bodies& bodies, Neighbours& list);
  void search(const Bodies& bodies, Neighbours& list, const Fragment& of, const Fragment& with);
  void try_one(const ContactBody& body, const ContactBody& other, const Neighbours& list, Candidate found);
  void gather();
  void sort();
  // of edges
  void search_edges(Neighbours& list, const Fragment& of, const Fragment& with);
  void try_edge(const Neighbours& list, EdgeCandidate found);
  void search_further(const Bodies& bodies, const std::vector<double>& pushed);

  ContactFragments fragments_;
  std::vector<Box> swept_;             // [m], one per fragment: what it has not left since the sweep
  std::vector<Neighbours> neighbours_; // sorted by a, b
  std::vector<Candidate> pool_;        // those of the same neighbours one after another
  std::vector<EdgeCandidate> edge_pool_;
  bool edges_;
  std::size_t unused_ = 0, unused_edges_ = 0; // in the pools
  std::vector<std::size_t> due_;              // indices of neighbours that are to be searched in this step
  enum class Renewal : std::uint8_t { Alone, None, Due };
  std::vector<Renewal> renewal_;       // one per fragment; alone: near nothing
  std::vector<Box> boxes_;             // [m], scratch: one per near triangle
  std::vector<std::uint32_t> near_;    // scratch: numbers of near triangles
  std::vector<Found> found_;           // of this step, in the order of the lists
  std::vector<std::uint32_t> begin_;   // scratch, one per rank of a vertex: where its pairs begin, and one more
  std::vector<ContactPair> pairs_;     // of this step, sorted
  std::vector<EdgeFacePair> crossing_; // of this step
  long sweeps_ = 0, searches_ = 0;
  SearchMargin margin_; // of two neighbours when they become such
};

} // namespace rend
