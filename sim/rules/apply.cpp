#include "sim/rules/apply.h"

#include "sim/base/check.h"
#include "sim/topology/rule_check.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {

std::vector<Dart> Applied::darts(char node) const {
  CHECK(rule);
  const int n = rule->right.find(node);
  CHECK_NOTE(n >= 0, fmt::format("\"{}\" has no node {} on the right", rule->name, node));
  std::vector<Dart> found;
  for (auto at = static_cast<std::size_t>(n); at < all.size(); at += rule->right.nodes.size())
    found.push_back(all[at]);
  return found;
}

Point mean_point(const Edit& edit, Orbit orbit, Dart d) {
  thread_local std::vector<Dart> darts, vertex;
  thread_local IndexSet counted;
  darts.clear();
  counted.clear();
  collect(edit.map(), orbit, d, darts);
  std::sort(darts.begin(), darts.end());
  Point sum;
  double count = 0;
  for (Dart e : darts) {
    if (counted.contains(e.value)) continue;
    vertex.clear();
    collect(edit.map(), Vertex, e, vertex);
    for (Dart v : vertex) counted.insert(v.value);
    const Point point = edit.point(e);
    sum.position += point.position;
    sum.rest += point.rest;
    sum.velocity += point.velocity;
    count += 1;
  }
  return {sum.position / count, sum.rest / count, sum.velocity / count};
}

namespace {

using Kind = RuleLink::Kind;
constexpr std::uint32_t no_point = IndexMap::none;

class Rewriter {
public:
  Rewriter(const Rule& rule, const Match& match, Edit& edit, const Arguments& arguments)
      : rule_(rule), match_(match), edit_(edit), arguments_(arguments),
        nodes_(static_cast<std::size_t>(rule.right.size())) {}

  std::vector<Dart> run() {
    place_vertices(); // first, since point expressions read the map as it was matched
    unlink_left();
    create();
    remove();
    link_right();
    return std::move(darts_);
  }

private:
  std::size_t index(std::size_t instance, int node) const {
    return instance * nodes_ + static_cast<std::size_t>(node);
  }
  int left_of(int right_node) const { return rule_.left.find(rule_.right[right_node].name); }

  void place_vertices();
  void spread(std::size_t instance, int node, std::uint32_t point);
  Point evaluate(const PointSource& source, std::size_t instance) const;
  void unlink_left();
  void create();
  void remove();
  void link_right();

  const Rule& rule_;
  const Match& match_;
  Edit& edit_;
  const Arguments& arguments_;
  std::size_t nodes_;                // of the right graph
  std::vector<Dart> darts_;          // [instance][right node]
  std::vector<std::uint32_t> point_; // of the edit, [instance][right node]; kept nodes have none
};

Point Rewriter::evaluate(const PointSource& source, std::size_t instance) const {
  const auto argument = static_cast<std::size_t>(source.argument);
  if (source.kind == PointSource::Kind::Given) {
    CHECK_NOTE(argument < arguments_.points.size(), fmt::format("\"{}\" asks for more points", rule_.name));
    return arguments_.points[argument];
  }
  const Dart from = match_.dart(instance, rule_.left.find(source.node));
  if (source.kind == PointSource::Kind::Mean) return mean_point(edit_, source.orbit, from);
  Point point = edit_.point(from);
  if (source.kind == PointSource::Kind::Translated) {
    CHECK_NOTE(argument < arguments_.vectors.size(), fmt::format("\"{}\" asks for more vectors", rule_.name));
    point.position += arguments_.vectors[argument];
    point.rest += arguments_.vectors[argument];
  }
  return point;
}

// Sets the point of every created dart, also of those in kept vertices: a later change in the same edit may
// separate them.
void Rewriter::place_vertices() {
  point_.assign(match_.instances * nodes_, no_point);
  for (int n = 0; n < rule_.right.size(); ++n) {
    if (left_of(n) >= 0) continue;
    const auto vertex = rule_check::reach(rule_.right, n, 0b1110);
    int kept = -1; // a node of the same vertex, on the left
    for (int m = 0; m < rule_.right.size(); ++m)
      if (vertex[static_cast<std::size_t>(m)] && left_of(m) >= 0) kept = left_of(m);
    const PointSource* source = nullptr;
    for (const RulePoint& point : rule_.right.points)
      if (vertex[static_cast<std::size_t>(rule_.right.find(point.node))]) source = &point.source;
    for (std::size_t k = 0; k < match_.instances; ++k) {
      if (point_[index(k, n)] != no_point) continue;
      if (kept >= 0)
        point_[index(k, n)] = edit_.add_point(edit_.point(match_.dart(k, kept)));
      else
        spread(k, n, edit_.add_point(evaluate(*source, k)));
    }
  }
}

// Gives a point to all darts of a new vertex.
void Rewriter::spread(std::size_t instance, int node, std::uint32_t point) {
  thread_local std::vector<std::pair<std::size_t, int>> stack;
  stack.assign(1, {instance, node});
  point_[index(instance, node)] = point;
  while (!stack.empty()) {
    const auto [k, n] = stack.back();
    stack.pop_back();
    for (int i = 1; i < 4; ++i) {
      const RuleLink link = rule_.right.link(n, i);
      const std::size_t next_k = link.kind == Kind::Implicit ? match_.neighbour(k, link.to) : k;
      const int next_n = link.kind == Kind::Implicit ? n : link.to;
      if (point_[index(next_k, next_n)] != no_point) continue;
      point_[index(next_k, next_n)] = point;
      stack.push_back({next_k, next_n});
    }
  }
}

void Rewriter::unlink_left() {
  for (int n = 0; n < rule_.left.size(); ++n) {
    const int after = rule_.right.find(rule_.left[n].name);
    for (int i = 0; i < 4; ++i) {
      const Kind kind = rule_.left.link(n, i).kind;
      if (kind == Kind::Absent || kind == Kind::Loop || (after >= 0 && rule_.unchanged(n, after, i))) continue;
      for (std::size_t k = 0; k < match_.instances; ++k)
        if (const Dart d = match_.dart(k, n); !edit_.map().is_free(i, d)) edit_.unlink(i, d);
    }
  }
}

// The darts of one instance get consecutive numbers: they will be neighbours.
void Rewriter::create() {
  darts_.resize(match_.instances * nodes_);
  for (std::size_t k = 0; k < match_.instances; ++k) {
    for (int n = 0; n < rule_.right.size(); ++n) {
      const int before = left_of(n);
      darts_[index(k, n)] = before >= 0 ? match_.dart(k, before) : edit_.add_dart();
      if (before < 0) edit_.give(darts_[index(k, n)], point_[index(k, n)]);
    }
  }
}

void Rewriter::remove() {
  for (int n = 0; n < rule_.left.size(); ++n) {
    if (rule_.right.find(rule_.left[n].name) >= 0) continue;
    for (std::size_t k = 0; k < match_.instances; ++k) edit_.remove_dart(match_.dart(k, n));
  }
}

void Rewriter::link_right() {
  for (int n = 0; n < rule_.right.size(); ++n) {
    const int before = left_of(n);
    for (int i = 0; i < 4; ++i) {
      const RuleLink link = rule_.right.link(n, i);
      if (link.kind == Kind::Absent || link.kind == Kind::Loop) continue;
      if (before >= 0 && rule_.unchanged(before, n, i)) continue;
      if (link.kind == Kind::Arc && link.to < n) continue; // done from the other end
      for (std::size_t k = 0; k < match_.instances; ++k) {
        const std::size_t other = link.kind == Kind::Arc ? k : match_.neighbour(k, link.to);
        if (link.kind == Kind::Implicit && other <= k) continue; // free, or done from the other end
        edit_.link(i, darts_[index(k, n)], darts_[index(other, link.kind == Kind::Arc ? link.to : n)]);
      }
    }
  }
}

} // namespace

Applied apply(const Rule& rule, Edit& edit, const Hooks& hooks, const Arguments& arguments) {
  thread_local Match match;
  Applied applied;
  applied.rule = &rule;
  applied.reason = find_match(rule, edit.map(), hooks, match);
  applied.ok = applied.reason.empty();
  if (applied.ok)
    applied.all = Rewriter(rule, match, edit, arguments).run();
  else
    applied.reason = fmt::format("\"{}\" does not apply: {}", rule.name, applied.reason);
  return applied;
}

Applied apply(const Rule& rule, EmbeddedMap& body, const Hooks& hooks, const Arguments& arguments) {
  Applied applied;
  body.edit([&](Edit& edit) { applied = apply(rule, edit, hooks, arguments); });
  return applied;
}

} // namespace rend
