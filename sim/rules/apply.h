// Applying a rule: find a match of its left graph and replace it by the right graph.
//
//   if (const Applied done = apply(unsew_edge, body, dart); !done.ok) report(done.reason);
//
// If there is no match the map is unchanged to the last byte, and the reason is returned. A well-formed rule
// (rule_check.h) preserves the axioms wherever it matches. Rules specify topology and points only: all other
// embeddings are updated by their own policies (column.h).
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/rules/match.h"

#include <string>
#include <vector>

namespace rend {

// The arguments of a rule's point expressions.
struct Arguments {
  std::vector<Point> points; // given(n)
  std::vector<Vec3> vectors; // translated(node, n) [m]: added to position and rest position
};

struct Applied {
  bool ok = false;
  std::string reason; // a sentence; empty if ok

  // The darts of a node of the right graph, one per instance; the first belongs to the hook itself.
  // CHECK: the rule has such a node.
  std::vector<Dart> darts(char node) const;
  Dart dart(char node) const { return darts(node).front(); }

  const Rule* rule = nullptr;
  std::vector<Dart> all; // [instance][node of the right graph]
};

// Within an open edit, so that many applications share one update of the columns. Point expressions read the
// points from before the edit, and those given to its new darts. CHECK: as many hooks and arguments as the rule
// requires.
Applied apply(const Rule& rule, Edit& edit, const Hooks& hooks = {}, const Arguments& arguments = {});

// In an edit of its own.
Applied apply(const Rule& rule, EmbeddedMap& body, const Hooks& hooks = {}, const Arguments& arguments = {});

// The mean of the vertices of orbit(d), each counted once, in the order of their smallest dart in the orbit.
Point mean_point(const Edit& edit, Orbit orbit, Dart d);

} // namespace rend
