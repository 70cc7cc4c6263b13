// The fragments of all bodies in contact with each other: where each of them is in a step, and how far its
// vertices have moved.
//
// Moves are relative to the mean of the fragment's own vertices, since it was last renewed: what flies as a
// whole does not move at all in this sense. A step asks each fragment for its bounding box and its largest
// move, whether or not anything is near; so what is asked of vertices and triangles lies in arrays, those of a
// fragment one after another, and a step reads them once.
//
// Where a fragment may touch another in a step is its box, grown by its reach
//
//   r = max(¾ thickness, e/5)      e: its longest edge, of solids
//
// since what touches is nearer than 1.5 times the mean of two thicknesses, or no deeper behind the face of a
// solid than a fifth of √(2 area) ≤ e (fragment_contact.h). Of e only the bound e ≤ e₀ + 2 m is known, from its
// value at the renewal and the largest move since then.
#pragma once

#include "sim/contact/box_tree.h"
#include "sim/contact/contact_body.h"

#include <memory>
#include <utility>
#include <vector>

namespace rend {

using ContactBodies = std::vector<std::unique_ptr<ContactBody>>;

inline BoxTree::Box grown(const BoxTree::Box& box, double by) {
  return {box.min() - Vec3::Constant(by), box.max() + Vec3::Constant(by)};
}

class ContactFragments {
public:
  using Box = BoxTree::Box;
  static constexpr double beside = 1.5;  // distance in thicknesses at which a path misses a face
  static constexpr double deepest = 0.2; // relative to a face's size: the largest penetration of a solid's face

  struct Fragment {
    std::uint32_t body = 0;
    std::uint32_t vertices = 0, vertices_end = 0;   // numbers of its vertices, those of the arrays below
    std::uint32_t triangles = 0, triangles_end = 0; // of its triangles
    std::uint32_t sides = 0, sides_end = 0;         // of their sides, if these are listed
    Vec3 start = Vec3::Zero(), end = Vec3::Zero();  // [m]: the mean of its vertices, of this step
    double moved = 0;        // [m]: of its vertices, at most, at the start of this step and at its end
    double moved_at_end = 0; // [m]
    double longest = 0;      // [m]: edge at the renewal
    double edges = 0;        // [m]: sum of the triangles' longest edges then
    Box box;                 // [m]: of its vertices' motion in this step
    Box reach;               // [m]: grown by its reach
  };
  struct Triangle {
    std::array<std::uint32_t, 3> corner{}; // numbers of vertices
    std::uint32_t number = 0;              // index into the body's ContactFaces::triangles()
  };

  using Side = std::array<std::uint32_t, 2>; // numbers of vertices, the smaller first

  // `with_sides`: the sides of triangles are listed, each once.
  explicit ContactFragments(bool with_sides = false) : with_sides_(with_sides) {}

  // Lists them anew if a map was changed, or after forget(); false: they are those of the last call.
  bool update(const ContactBodies& bodies);
  void forget() { listed_ = false; }
  // Whether fragments of some bodies, or of one, may touch each other at all.
  bool anything(const ContactBodies& bodies) const;

  void measure(const ContactBodies& bodies);                // the boxes and moves of this step
  void renew(const ContactBodies& bodies, std::uint32_t f); // moves are measured from the end of this step on

  // Where its vertices are moved by `pushed` [m] at most after they were measured.
  void reach_further(std::uint32_t f, double pushed) {
    fragments_[f].reach = grown(fragments_[f].reach, pushed);
  }

  const std::vector<Fragment>& all() const { return fragments_; }
  // `body`: index of it; none: the vertex is in no face, or the body has no contact of fragments.
  std::optional<std::uint32_t> fragment_of(std::size_t body, Slot vertex) const;
  const Triangle& triangle(std::uint32_t t) const { return triangles_[t]; }
  const Side& side(std::uint32_t s) const { return sides_[s]; }
  std::size_t vertices() const { return slots_.size(); }
  Slot slot(std::uint32_t n) const { return slots_[n]; }
  std::uint32_t rank(std::uint32_t n) const { return rank_[n]; } // among all vertices, by body and slot
  const Vec3& from(std::uint32_t n) const { return from_[n]; }   // [m], at the start of this step
  const Vec3& at(std::uint32_t n) const { return at_[n]; }       // [m], at its end
  double moved(std::uint32_t n) const { return moved_[n]; }      // [m], the larger of start and end
  double moved(const Side& s) const { return std::max(moved_[s[0]], moved_[s[1]]); } // [m], of an end
  double moved(const Triangle& t) const { // [m], of a corner, at most
    return std::max({moved_[t.corner[0]], moved_[t.corner[1]], moved_[t.corner[2]]});
  }
  Box around(std::uint32_t n) const { return Box(from_[n].cwiseMin(at_[n]), from_[n].cwiseMax(at_[n])); }
  Box around(const Side& s) const { return around(s[0]).merged(around(s[1])); }
  Box around(const Triangle& t) const {
    return around(t.corner[0]).merged(around(t.corner[1])).merged(around(t.corner[2]));
  }
  std::size_t bytes() const;

private:
  struct BodyEntry {                            // per body
    std::vector<Slot> vertices;                 // of its faces, increasing
    std::vector<std::uint32_t> vertex_fragment; // one per entry of `vertices`, from 0, increasing at its first
    std::vector<std::uint32_t> face_fragment;   // one per triangle
    std::uint32_t fragments = 0, first = 0;     // how many, and the number of the first
  };
  static void list(const ContactBody& body, BodyEntry& of);
  static void list_obstacle(const ContactBody& body, BodyEntry& of);
  void arrange(const ContactBodies& bodies);
  void place(const ContactBody& body, const BodyEntry& of, std::size_t first);
  void list_sides();
  void gather(const ContactBody& body, Fragment& fragment);
  void measure_moves(const ContactBody& body, Fragment& fragment);

  std::vector<BodyEntry> of_;       // one per body
  std::vector<Fragment> fragments_; // by body
  std::vector<Slot> slots_;         // one per vertex number: those of a fragment one after another, increasing
  std::vector<std::uint32_t> rank_; // one per vertex number
  std::vector<Vec3> from_, at_;     // [m], one per vertex number: at the start of this step, at its end
  std::vector<Vec3> there_;         // [m], one per vertex number: from the mean, at the renewal
  std::vector<double> moved_;       // [m], one per vertex number
  std::vector<Triangle> triangles_; // those of a fragment one after another, increasing
  std::vector<Side> sides_;         // those of a fragment one after another, sorted; empty: not wanted
  std::vector<std::uint32_t> number_; // scratch, one per vertex slot of a body: its number here
  bool with_sides_;
  bool listed_ = false;
  bool fresh_ = false; // listed, and not measured since
};

} // namespace rend
