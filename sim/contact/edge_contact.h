// Detection of contact between bodies, with mesh obstacles, and with `self` within one, at the end of a step:
// edges against edges.
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
// with a margin (search_margin.h), and anew when an edge has moved by half of it relative to the mean of all:
// they include all that touch, so results do not depend on when. Two edges that were at a distance d at the
// search, and whose ends have since then moved by m and m' at most relative to that mean, are at d − m − m' at
// least, and are passed over while that is more than they touch from, 1.5 thicknesses.
#pragma once

#include "sim/contact/contact_answer.h"
#include "sim/contact/contact_pairs.h"
#include "sim/contact/search_margin.h"

#include <array>
#include <optional>
#include <vector>

namespace rend {

class EdgeContact {
public:
  // Of bodies with each other, or with obstacles: what moves past an obstacle is then searched for there alone.
  enum class With { Bodies, Obstacles };
  explicit EdgeContact(With with = With::Bodies, SearchMargin margin = {}) : with_(with), margin_(margin) {}

  // Whether two of them can touch, or one itself. Their names are resolved (contact_names.h).
  static bool is_asked_for(const ContactPairs::Bodies& bodies, With with = With::Bodies);

  // Adds those of the bodies' `next` to the answer.
  void detect(const ContactPairs::Bodies& bodies, ContactAnswer& answer);
  void forget() { *this = EdgeContact(with_, margin_.anew()); } // what was listed: after a state was read
  std::size_t pairs() const { return pairs_.size(); }           // candidates in the last step
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
    std::uint32_t body = 0, edge = 0; // index into of_[body].edges
    std::uint32_t other_body = 0, other_edge = 0;
    double clear = 0; // [m]: the two do not touch while they have moved by less than this together
  };
  struct Listed {              // of one body; without contact of fragments empty
    std::vector<Edge> edges;   // sorted by their ends
    std::vector<Slot> ends;    // increasing
    std::vector<Vec3> there;   // [m], one per entry of `ends`, at the last search
    std::vector<double> moves; // [m], one per vertex slot; relative to the mean, at the start and end of a step
    std::vector<double> moved; // [m], one per edge: of its ends
  };
  struct Move { // [m], from the last search to the start of a step and to its end
    Vec3 start = Vec3::Zero(), end = Vec3::Zero();
  };
  class Trees;
  class Finder;

  static bool looked_for(const ContactBody& a, const ContactBody& b, With with);
  static void list(const ContactBody& body, Listed& of);
  void measure(const ContactPairs::Bodies& bodies);
  static void measure_moves(const ContactBody& body, const Move& mean, Listed& of);
  double widest_margin(const ContactPairs::Bodies& bodies) const; // [m]
  void search(const ContactPairs::Bodies& bodies);
  void add_pairs(const ContactPairs::Bodies& bodies, std::uint32_t body, const Trees& trees);
  static bool joined(const ContactBody& body, const Edge& a, const Edge& b);
  std::optional<ContactConstraint> touch(const ContactPairs::Bodies& bodies, const Pair& pair) const;

  With with_;
  std::vector<Listed> of_;  // one per body
  std::vector<Pair> pairs_; // of the last search, sorted
  SearchMargin margin_;
  double skin_ = 0;  // [m]
  double moved_ = 0; // [m]: of an edge, at most, at the start of this step and at its end
  bool searched_ = false;
  long searches_ = 0;
};

} // namespace rend
