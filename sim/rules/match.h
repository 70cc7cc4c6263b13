// Matching the left graph of a rule in a map.
//
// The hooks determine the match: the darts of the first hook's orbit are the instances, in the order of a walk,
// and every node has one dart at each of them. It is a match if all links and loops of the graph hold at every
// instance, and no dart is used twice, unless the rule may fold (thesis 3.4.1, footnote 3: a match is
// injective). An arc always leads to another dart: a free link is no arc.
#pragma once

#include "sim/rules/rule.h"
#include "sim/topology/gmap.h"
#include "sim/topology/index_set.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace rend {

// One dart for every hook of a rule, in the order in which the rule names them.
class Hooks {
public:
  Hooks() = default;
  Hooks(Dart d) : darts_{d}, count_(1) {}
  Hooks(std::initializer_list<Dart> darts); // CHECK: at most four

  std::size_t size() const { return count_; }
  Dart operator[](std::size_t n) const { return darts_[n]; }
  std::span<const Dart> span() const { return {darts_.data(), count_}; }

private:
  std::array<Dart, 4> darts_;
  std::size_t count_ = 0;
};

// Why there is no match, as numbers: a sentence is made only if somebody asks.
struct Mismatch {
  enum class Kind {
    None, // it matches
    NoDart,
    SheetWithoutVolumes,
    NotFree,
    Free,
    OtherDart,
    NotIsomorphic,
    Twice,
    Condition,  // `link` is the number of the rule's <when>
    Expression, // an expression has no finite value
    Shape,      // a new element would be flat or inverted
    Budget,     // the map would have more darts than it may (map_budget.h)
  };
  Kind kind = Kind::None;
  int node = -1; // of the left graph
  int link = -1;
  Dart dart = {}, wanted = {}, is = {};
  std::string text = {}; // Expression, Shape, Budget: what is wrong

  explicit operator bool() const { return kind != Kind::None; }
  std::string sentence(const Rule& rule) const;
  // The same without darts and places: equal for all places that fail alike.
  std::string in_general(const Rule& rule) const;
};

struct Match {
  std::size_t nodes = 0;                 // of the left graph
  std::size_t positions = 0;             // of its labels
  std::size_t instances = 0;             // 1 for an empty left graph
  std::vector<Dart> darts;               // [instance][node]
  std::vector<std::uint32_t> neighbours; // [instance][position]: the instance that the hook's link leads to

  Dart dart(std::size_t instance, int node) const {
    return darts[instance * nodes + static_cast<std::size_t>(node)];
  }
  std::uint32_t neighbour(std::size_t instance, int position) const {
    return neighbours[instance * positions + static_cast<std::size_t>(position)];
  }
};

// Fills `match`. Linear in the number of matched darts. The rule's conditions (<when>) are not asked: see
// apply.h. CHECK: as many hooks as the rule has.
Mismatch find_match(const Rule& rule, const GMap& map, const Hooks& hooks, Match& match);

} // namespace rend
