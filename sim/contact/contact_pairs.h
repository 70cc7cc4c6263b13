// Which vertices may meet which faces in a step: the broad phase of contact between bodies and fragments.
//
// Faces are triangles (contact_faces.h). Those of each fragment are kept in a tree of boxes, and those trees in
// one more, so that a vertex passes by the faces of its own fragment, which are most of those near it. Trees
// are Eigen's KdBVH (unsupported/Eigen/BVH, MPL 2), since Eigen is there already, a tree is a pure function of
// the boxes, and what is found is sorted, so that no order of a search shows. (Bullet's btDbvt and FCL would be
// new dependencies, for single precision or for whole bodies.) Trees cannot follow what moves; so pairs are
// looked for with a skin around all, and looked for again when a vertex has moved by half of it against the
// mean of all (Verlet's neighbour lists, Phys. Rev. 159, 1967), or when a map was changed. Pairs are more than
// what meets, and what meets is always among them: when they were looked for leaves no trace.
#pragma once

#include "sim/contact/contact_body.h"

#include <memory>

namespace rend {

struct ContactPair {
  std::uint32_t body = 0; // of the vertex
  Slot vertex = 0;
  std::uint32_t face_body = 0;
  std::uint32_t triangle = 0; // index into the body's ContactFaces::triangles()
  bool neighbours = false;    // at rest they are nearer than the thickness

  void store(Archive& archive);
};

class ContactPairs {
public:
  using Bodies = std::vector<std::unique_ptr<ContactBody>>;

  // The pairs of this step, by body, vertex, body of the face, triangle. Of bodies with fragments: those of
  // different bodies and of different fragments, and with self also those within a fragment that are no
  // neighbours.
  const std::vector<ContactPair>& find(const Bodies& bodies);

  // What two bodies keep from each other [m].
  static double thickness(const ContactBody& a, const ContactBody& b) {
    return 0.5 * (a.settings().thickness + b.settings().thickness);
  }
  long searches() const { return searches_; }
  std::size_t pairs() const { return pairs_.size(); } // of the last search
  std::size_t bytes() const;
  void store(Archive& archive, const Bodies& bodies); // whose faces are those of their maps

private:
  class FaceTrees;
  struct Of {                                   // a body
    std::vector<Slot> vertices;                 // of its faces, increasing
    std::vector<std::uint32_t> vertex_fragment; // one per entry of `vertices`
    std::vector<std::uint32_t> face_fragment;   // one per triangle
    std::vector<Vec3> there;                    // [m], at the last search, one per entry of `vertices`
    bool several = false;                       // fragments

    void store(Archive& archive, std::size_t most); // vertices or triangles
    bool same_lists(const Of& other) const;         // but for where they were
  };
  void check_pair(const Bodies& bodies, std::size_t number) const; // throws ArchiveError
  void list(const ContactBody& body, Of& of) const;
  bool anything(const Bodies& bodies) const;
  bool stale(const Bodies& bodies) const;
  void search(const Bodies& bodies);
  void search_for(const Bodies& bodies, std::uint32_t b, const FaceTrees& trees, double reach); // b's vertices
  bool same_fragment(std::size_t entry, const ContactPair& pair) const; // entry: of the vertex in Of::vertices
  bool allowed(const Bodies& bodies, std::size_t entry, const ContactPair& pair) const;
  bool joined(const Bodies& bodies, std::size_t entry, ContactPair& pair) const;

  std::vector<Of> of_;             // one per body
  std::vector<ContactPair> pairs_; // of the last search, sorted
  double skin_ = 0;                // [m]
  bool listed_ = false;
  long searches_ = 0;
};

} // namespace rend
