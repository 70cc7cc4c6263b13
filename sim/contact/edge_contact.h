// Detection of contact between bodies, and with `self` within one, at the end of a step: edges against edges.
// (Vertices against faces, which see what edges do only where cells are small: fragment_contact.h.)
//
// For the nearest points p and q of two edges at the start of the step, both between the ends of their edges,
//
//   n = (p − q)/|p − q|,   gap = n·(p − q)
//   between two solids n must point out of the one and into the other: their near edges
//
// There is a contact if the gap at the end of the step is less than the thickness. What touches at the ends of
// an edge is a vertex against an edge, and parallel edges touch there: fragment_contact.h has both.
//
// Edges of one body that are closer than two thicknesses at rest have no contact, and those of different
// fragments of a body have none either: torn sides lie on each other when they part, in no direction that edges
// could keep. (In contact/shatter, as many faces were crossed with such contacts as without, in twice the
// time.)
//
// The edges of a sheet are those of its faces; of a solid those of its boundary at which it is not flat at
// rest, since a flat face is kept out by its vertices. Pairs are found through trees of the edges of each body,
// with a margin, and anew when an edge has moved by half of it relative to the mean of all: they include all
// that touch, so results do not depend on when.
#pragma once

#include "sim/contact/contact_answer.h"
#include "sim/contact/contact_pairs.h"

#include <array>
#include <optional>
#include <vector>

namespace rend {

class EdgeContact {
public:
  // Of bodies with each other, or with obstacles: what moves past an obstacle is then searched for there alone.
  enum class With { Bodies, Obstacles };
  explicit EdgeContact(With with = With::Bodies) : with_(with) {}

  // Whether two of them can touch, or one itself. Their names are resolved (contact_names.h).
  static bool is_asked_for(const ContactPairs::Bodies& bodies, With with = With::Bodies);

  // Adds those of the bodies' `next` to the answer.
  void detect(const ContactPairs::Bodies& bodies, ContactAnswer& answer);
  void forget() { *this = EdgeContact(with_); }       // what was listed: after a state was read
  std::size_t pairs() const { return pairs_.size(); } // candidates in the last step
  long searches() const { return searches_; }
  std::size_t bytes() const;

private:
  struct Edge {
    std::array<Slot, 2> end{};
    // Of its faces, from one end to the other and back: the corner after the edge; of a sheet that ends there
    // only the first counts.
    std::array<Slot, 2> beyond{};
    std::uint32_t fragment = 0;
  };
  struct Pair {
    std::uint32_t body = 0, edge = 0; // index into edges_ of the body
    std::uint32_t other_body = 0, other_edge = 0;
  };
  class Trees;
  class Finder;

  static bool looked_for(const ContactBody& a, const ContactBody& b, With with);
  void list(const ContactBody& body, std::vector<Edge>& edges) const;
  bool has_moved(const ContactPairs::Bodies& bodies) const;
  void search(const ContactPairs::Bodies& bodies);
  void add_pairs(const ContactPairs::Bodies& bodies, std::uint32_t body, const Trees& trees, double reach);
  static bool joined(const ContactBody& body, const Edge& a, const Edge& b);
  std::optional<ContactConstraint> touch(const ContactPairs::Bodies& bodies, const Pair& pair) const;

  With with_;
  std::vector<std::vector<Edge>> edges_; // one list per body; of one without contact of fragments empty
  std::vector<std::vector<Vec3>> there_; // [m], both ends of each edge at the last search
  std::vector<Pair> pairs_;              // of the last search, sorted
  double skin_ = 0;                      // [m]
  bool searched_ = false;
  long searches_ = 0;
};

} // namespace rend
