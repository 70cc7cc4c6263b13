#include "sim/rules/apply.h"

#include "sim/base/check.h"
#include "sim/base/stop_request.h"
#include "sim/rules/rest_measures.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

namespace rend {
namespace {

using Kind = RuleLink::Kind;
constexpr std::uint32_t no_point = IndexMap::none, no_family = IndexMap::none;

// One rewriting of a match.
class Rewriter {
public:
  Rewriter(const Rule& rule, const Match& match, Edit& edit, std::vector<Dart>& darts,
           std::vector<std::uint32_t>& points, std::vector<std::pair<Dart, Point>>& moved)
      : rule_(rule), match_(match), edit_(edit), nodes_(rule.right.nodes.size()), darts_(darts), point_(points),
        moved_(moved) {}

  // First, since expressions read the map as it was matched. ExpressionError.
  void place_vertices(const RuleValues& values);
  void run();
  // Why some element that was changed is flat or inverted; empty: none is.
  std::string shape_fault() const;

private:
  std::size_t index(std::size_t instance, int node) const {
    return instance * nodes_ + static_cast<std::size_t>(node);
  }
  int left_of(int right_node) const { return rule_.before[static_cast<std::size_t>(right_node)]; }
  int kept_in_vertex(int node) const;
  void place(const RuleValues& values, int node);
  void spread(std::size_t instance, int node, std::uint32_t point);
  void create();
  void record_elements();
  void link(const RulePlan::Link& link);

  const Rule& rule_;
  const Match& match_;
  Edit& edit_;
  std::size_t nodes_;                 // of the right graph
  std::vector<Dart>& darts_;          // [instance][right node]
  std::vector<std::uint32_t>& point_; // of the edit, [instance][right node]; kept nodes that do not move: none
  std::vector<std::pair<Dart, Point>>& moved_;
  std::vector<std::uint32_t> family_of_; // likewise: of the edit's lineage, of new vertices
  std::vector<Parent> parents_;          // scratch
  std::uint32_t family_ = no_family;     // of the vertex that is being placed
};

// A node of the same vertex that is kept, as a node of the left graph; -1: none.
int Rewriter::kept_in_vertex(int node) const {
  const std::vector<bool> vertex = rule_.right.reach(node, Vertex);
  for (int m = rule_.right.size() - 1; m >= 0; --m)
    if (vertex[static_cast<std::size_t>(m)] && left_of(m) >= 0) return left_of(m);
  return -1;
}

// Created darts of kept vertices have a point as well: a later change in the same edit may separate them.
void Rewriter::place_vertices(const RuleValues& values) {
  point_.assign(rule_.creates() || !rule_.sets.empty() ? match_.instances * nodes_ : 0, no_point);
  if (point_.empty()) return;
  family_of_.assign(point_.size(), no_family);
  for (int n = 0; n < rule_.right.size(); ++n)
    if (left_of(n) < 0 || rule_.vertex_set[static_cast<std::size_t>(n)] >= 0) place(values, n);
}

void Rewriter::place(const RuleValues& values, int node) {
  const int set = rule_.vertex_set[static_cast<std::size_t>(node)], kept = kept_in_vertex(node);
  for (std::size_t k = 0; k < match_.instances; ++k) {
    throw_if_stop_is_due();
    if (point_[index(k, node)] != no_point) continue;
    if (set < 0) {
      point_[index(k, node)] = edit_.add_point(edit_.point(match_.dart(k, kept)));
      if (edit_.inherits())
        family_of_[index(k, node)] = edit_.add_family(Vertex, std::array{Parent{match_.dart(k, kept), 1}});
      continue;
    }
    const Rule::Set& values_of = rule_.sets[static_cast<std::size_t>(set)];
    const bool stays = kept >= 0 && !rule_.joins[static_cast<std::size_t>(node)];
    const Point point =
        stays ? values.moved(values_of, k, edit_.point(match_.dart(k, kept))) : values.point(values_of, k);
    if (kept >= 0) {
      edit_.move(match_.dart(k, kept), point);
      moved_.push_back({match_.dart(k, kept), point});
    } else if (edit_.inherits()) {
      values.parents(values_of, k, parents_);
      family_ = parents_.empty() ? no_family : edit_.add_family(Vertex, parents_);
    }
    spread(k, node, edit_.add_point(point));
  }
}

// Gives a point to all darts of a vertex that the rule knows.
void Rewriter::spread(std::size_t instance, int node, std::uint32_t point) {
  thread_local std::vector<std::pair<std::size_t, int>> stack;
  stack.assign(1, {instance, node});
  const auto put = [&](std::size_t k, int n) {
    point_[index(k, n)] = point;
    family_of_[index(k, n)] = family_;
  };
  put(instance, node);
  while (!stack.empty()) {
    const auto [k, n] = stack.back();
    stack.pop_back();
    for (int i = 1; i < 4; ++i) {
      const RuleLink& link = rule_.right.link(n, i);
      if (link.kind == Kind::Absent) continue;
      const std::size_t next_k = link.kind == Kind::Implicit ? match_.neighbour(k, link.to) : k;
      const int next_n = link.kind == Kind::Implicit ? n : link.to;
      if (point_[index(next_k, next_n)] != no_point) continue;
      put(next_k, next_n);
      stack.push_back({next_k, next_n});
    }
  }
  family_ = no_family;
}

void Rewriter::run() {
  for (const auto& [node, i] : rule_.plan.unlinks)
    for (std::size_t k = 0; k < match_.instances; ++k)
      if (const Dart d = match_.dart(k, node); !edit_.map().is_free(i, d)) edit_.unlink(i, d);
  create();
  if (rule_.creates() && edit_.inherits()) record_elements(); // before darts of parents may be removed
  for (int node : rule_.plan.removed)
    for (std::size_t k = 0; k < match_.instances; ++k) edit_.remove_dart(match_.dart(k, node));
  for (const RulePlan::Link& each : rule_.plan.links) link(each);
}

// The darts of one instance get consecutive numbers: they will be neighbours.
void Rewriter::create() {
  darts_.resize(match_.instances * nodes_);
  for (std::size_t k = 0; k < match_.instances; ++k) {
    throw_if_stop_is_due();
    for (int n = 0; n < rule_.right.size(); ++n) {
      const int before = left_of(n);
      Dart& d = darts_[index(k, n)];
      d = before >= 0 ? match_.dart(k, before) : edit_.add_dart();
      // A kept vertex that moves has its old point for other applications, whichever of its darts they ask.
      if (before >= 0 || point_.empty() || point_[index(k, n)] == no_point) continue;
      edit_.give(d, point_[index(k, n)]);
      if (family_of_[index(k, n)] != no_family) edit_.inherit(d, Vertex, family_of_[index(k, n)]);
    }
  }
}

// In which element from before the created darts lie.
void Rewriter::record_elements() {
  const int dimension = edit_.map().dimension();
  const std::vector<int>& inside = rule_.plan.inside[static_cast<std::size_t>(dimension - 2)];
  for (int n = 0; n < rule_.right.size(); ++n) {
    const int node = inside[static_cast<std::size_t>(n)];
    if (node < 0) continue;
    for (std::size_t k = 0; k < match_.instances; ++k)
      edit_.inherit(darts_[index(k, n)], element_orbit(dimension), std::array{Parent{match_.dart(k, node), 1}});
  }
}

std::string Rewriter::shape_fault() const {
  thread_local IndexSet seen;
  thread_local std::vector<Dart> element;
  seen.clear();
  for (Dart d : darts_) {
    if (seen.contains(d.value)) continue;
    throw_if_stop_is_due();
    element.clear();
    collect(edit_.map(), element_orbit(edit_.map().dimension()), d, element);
    for (Dart e : element) seen.insert(e.value);
    if (std::string fault = rend::shape_fault(edit_, d); !fault.empty()) return fault;
  }
  return {};
}

void Rewriter::link(const RulePlan::Link& link) {
  for (std::size_t k = 0; k < match_.instances; ++k) {
    throw_if_stop_is_due();
    const bool arc = link.kind == Kind::Arc;
    const std::size_t other = arc ? k : match_.neighbour(k, link.to);
    if (!arc && other <= k) continue; // free, or done from the other end
    edit_.link(link.link, darts_[index(k, link.node)], darts_[index(other, arc ? link.to : link.node)]);
  }
}

} // namespace

bool RuleRunner::may_begin(const Edit& edit, int hook, Dart d) const {
  const int node = rule_.plan.hooks[static_cast<std::size_t>(hook)];
  for (const RulePlan::Test& test : rule_.plan.first_tests)
    if (test.node == node && edit.map().is_free(test.link, d) != (test.kind == Kind::Loop)) return false;
  return true;
}

bool RuleRunner::matches(const Edit& edit, const Hooks& hooks) {
  mismatch_ = find_match(rule_, edit.map(), hooks, match_);
  if (mismatch_) return false;
  try {
    const RuleValues values(rule_, edit, match_, context_);
    for (std::size_t n = 0; n < rule_.whens.size(); ++n)
      if (!values.holds(rule_.whens[n])) {
        mismatch_ = {.kind = Mismatch::Kind::Condition, .link = static_cast<int>(n)};
        return false;
      }
  } catch (const ExpressionError& error) {
    mismatch_ = {.kind = Mismatch::Kind::Expression, .text = error.flaw};
    return false;
  }
  return true;
}

bool RuleRunner::apply(Edit& edit, const Hooks& hooks) {
  return matches(edit, hooks) && rewrite(edit);
}

// Whether the map may have the darts that it would have.
bool RuleRunner::fits(const Edit& edit) const {
  if (rule_.growth() <= 0) return true;
  return edit.map().dart_count() + match_.instances * static_cast<std::size_t>(rule_.growth()) <=
         context_.most_darts;
}

bool RuleRunner::rewrite(Edit& edit) {
  moved_.clear();
  if (!fits(edit)) {
    mismatch_ = {.kind = Mismatch::Kind::Budget,
                 .text = fmt::format("the map would have more than {} darts", context_.most_darts)};
    return false;
  }
  Rewriter rewriter(rule_, match_, edit, darts_, point_, moved_);
  const bool may_fail = rule_.creates() || !rule_.sets.empty();
  const std::optional<Edit::Savepoint> start = may_fail ? std::optional(edit.savepoint()) : std::nullopt;
  try {
    rewriter.place_vertices(RuleValues(rule_, edit, match_, context_));
  } catch (const ExpressionError& error) {
    if (start) edit.rollback(*start);
    mismatch_ = {.kind = Mismatch::Kind::Expression, .text = error.flaw};
    return false;
  }
  rewriter.run();
  if (!rule_.creates()) return true; // where vertices move, others of the element may yet follow
  if (std::string fault = rewriter.shape_fault(); !fault.empty()) {
    edit.rollback(*start);
    mismatch_ = {.kind = Mismatch::Kind::Shape, .text = std::move(fault)};
    return false;
  }
  return true;
}

std::string RuleRunner::reason() const {
  return mismatch_ ? fmt::format("\"{}\" does not apply: {}", rule_.name(), mismatch_.sentence(rule_))
                   : std::string();
}

std::vector<Dart> Applied::darts(std::string_view node) const {
  CHECK(rule);
  const int n = rule->right.find(node);
  CHECK_NOTE(n >= 0, fmt::format("\"{}\" has no node {} on the right", rule->name(), node));
  std::vector<Dart> found;
  for (auto at = static_cast<std::size_t>(n); at < all.size(); at += rule->right.nodes.size())
    found.push_back(all[at]);
  return found;
}

RuleContext context_of(const Rule& rule, const RuleArguments& arguments) {
  RuleContext context;
  for (const Rule::Where& where : rule.wheres) context.wheres.push_back(where.value);
  for (const auto& [name, value] : arguments) {
    bool known = false;
    for (std::size_t n = 0; n < rule.wheres.size(); ++n)
      if (rule.wheres[n].name == name) {
        context.wheres[n] = value;
        known = true;
      }
    CHECK_NOTE(known, fmt::format("\"{}\" has no argument {}", rule.name(), name));
  }
  return context;
}

Applied apply(const Rule& rule, Edit& edit, const Hooks& hooks, const RuleArguments& arguments) {
  RuleRunner runner(rule, context_of(rule, arguments));
  Applied applied;
  applied.rule = &rule;
  applied.ok = runner.apply(edit, hooks);
  applied.reason = runner.reason();
  if (applied.ok) applied.all = runner.darts();
  return applied;
}

Applied apply(const Rule& rule, EmbeddedMap& body, const Hooks& hooks, const RuleArguments& arguments) {
  Applied applied;
  body.edit([&](Edit& edit) { applied = apply(rule, edit, hooks, arguments); });
  return applied;
}

} // namespace rend
