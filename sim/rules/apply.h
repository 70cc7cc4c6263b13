// Applying a rule: find its left graph, then put the right one in its place.
//
//   if (const Applied done = apply(unsew_edge, body, dart); !done.ok) report(done.reason);
//
// A match that fails leaves the map as it was, to the last byte, and says why. A rule that is well formed
// (rule_check.h) keeps the axioms wherever it matches. Rules speak of topology and points alone: all other
// embeddings follow by their own policies (column.h).
#pragma once

#include "sim/embedding/embedded_map.h"
#include "sim/rules/match.h"

#include <string>
#include <vector>

namespace rend {

// What the point expressions of a rule ask the caller for.
struct Arguments {
  std::vector<Point> points; // given(n)
  std::vector<Vec3> vectors; // translated(node, n) [m]: added to position and rest position
};

struct Applied {
  bool ok = false;
  std::string reason; // a sentence: why not

  // The darts of a node of the right graph, one per instance; the first belongs to the hook itself.
  // CHECK: the rule has such a node.
  std::vector<Dart> darts(char node) const;
  Dart dart(char node) const { return darts(node).front(); }

  const Rule* rule = nullptr;
  std::vector<Dart> all; // [instance][node of the right graph]
};

// In an edit that is open: so that many applications share one update of the columns. Expressions see the
// points from before the edit, and those that it gave to new darts. CHECK: as many hooks and arguments as the
// rule asks for.
Applied apply(const Rule& rule, Edit& edit, const Hooks& hooks = {}, const Arguments& arguments = {});

// In an edit of its own.
Applied apply(const Rule& rule, EmbeddedMap& body, const Hooks& hooks = {}, const Arguments& arguments = {});

// The mean of the vertices of orbit(d), each counted once, in the order of their smallest dart in the orbit.
Point mean_point(const Edit& edit, Orbit orbit, Dart d);

} // namespace rend
