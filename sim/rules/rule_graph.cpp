#include "sim/rules/rule_graph.h"

#include "sim/base/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

namespace rend {

int RuleNode::position(int link) const {
  const auto found = std::find(label.begin(), label.end(), link);
  return found == label.end() ? -1 : static_cast<int>(found - label.begin());
}

const char* name_of(RuleSide side) {
  return side == RuleSide::Left ? "left" : "right";
}

RuleFault::RuleFault(RuleSide side_, std::size_t column_, const std::string& what, const std::string& hint_)
    : std::runtime_error(what), side(side_), column(column_), hint(hint_) {}

namespace {

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

class Parser {
public:
  Parser(RuleSide side, std::string_view text) : side_(side), text_(text) {}

  RuleGraph run() {
    if (text_.size() > RuleGraph::longest)
      fail(0, fmt::format("the text is longer than {} characters", RuleGraph::longest));
    for (skip_blanks(); at_ < text_.size(); skip_blanks()) item();
    for (const Link& link : links_) connect(link);
    return std::move(graph_);
  }

private:
  struct Link { // an arc, or a loop, whose `to` is empty
    std::string from, to;
    int i = 0;
    std::size_t from_column = 0, to_column = 0;
  };

  [[noreturn]] void fail(std::size_t column, const std::string& what, const std::string& hint = {}) const {
    throw RuleFault(side_, column, what, hint);
  }

  void skip_blanks() {
    while (at_ < text_.size() &&
           (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
      ++at_;
  }
  bool take(char c) {
    if (at_ == text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  bool at_end_of_item() const {
    return at_ == text_.size() || text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' ||
           text_[at_] == '\r';
  }

  std::string name() {
    const std::size_t first = at_;
    while (at_ < text_.size() &&
           (is_letter(text_[at_]) || (at_ > first && (is_digit(text_[at_]) || text_[at_] == '_'))))
      ++at_;
    if (at_ == first)
      fail(at_ + 1,
           at_ == text_.size() ? "a node's name is missing at the end"
                               : fmt::format("{} begins no node's name", in_quotes(text_.substr(at_, 1))),
           "items are nodes a(0,1), arcs a-2-b and free links a|3, separated by blanks");
    if (at_ - first > RuleGraph::longest_name)
      fail(first + 1, fmt::format("the name of a node is longer than {} characters", RuleGraph::longest_name));
    return std::string(text_.substr(first, at_ - first));
  }

  int link() {
    if (at_ < text_.size() && text_[at_] >= '0' && text_[at_] <= '3') return text_[at_++] - '0';
    fail(at_ + 1, "a link is 0, 1, 2 or 3", "α0 to α3 are all that a map has");
  }

  void item() {
    const std::size_t column = at_ + 1;
    const std::string first = name();
    if (take('-')) {
      const int i = link();
      if (!take('-'))
        fail(at_ + 1, fmt::format("the arc from {} lacks its second '-'", first), "an arc is a-2-b");
      const std::size_t second = at_ + 1;
      links_.push_back({first, name(), i, column, second});
    } else if (take('|')) {
      do links_.push_back({first, "", link(), column, column});
      while (take(','));
    } else {
      node(first, column);
    }
    if (!at_end_of_item())
      fail(at_ + 1, fmt::format("{} does not belong here", in_quotes(text_.substr(at_, 1))),
           "items are separated by blanks");
  }

  void node(const std::string& name, std::size_t column) {
    RuleNode node;
    node.name = name;
    node.column = column;
    node.hook = take('*');
    if (take('(')) label(node);
    if (!numbers_.emplace(name, graph_.size()).second)
      fail(column, fmt::format("two nodes are called {}", name), "each is stated once, with its whole label");
    if (graph_.nodes.size() == RuleGraph::most_nodes)
      fail(column, fmt::format("there are more than {} nodes", RuleGraph::most_nodes));
    graph_.nodes.push_back(std::move(node));
  }

  void label(RuleNode& node) {
    if (take(')')) return;
    do {
      skip_blanks();
      const std::size_t column = at_ + 1;
      const int i = take('_') ? RuleNode::dropped : link();
      skip_blanks();
      if (node.label.size() == 4)
        fail(column, fmt::format("the label of {} holds more than four links", node.name));
      const int position = static_cast<int>(node.label.size());
      node.label.push_back(i);
      if (i != RuleNode::dropped) say(node, i, {RuleLink::Kind::Implicit, position}, column);
    } while (take(','));
    if (!take(')'))
      fail(at_ + 1, fmt::format("the label of {} is not closed", node.name), "a label is (0,_,2)");
  }

  void say(RuleNode& node, int i, const RuleLink& link, std::size_t column) const {
    RuleLink& known = node.links[static_cast<std::size_t>(i)];
    if (known.kind != RuleLink::Kind::Absent)
      fail(column, fmt::format("node {} says twice what its α{} is", node.name, i),
           "a label, an arc or a free link: one of them");
    known = link;
  }

  int find(const std::string& name, std::size_t column) const {
    if (const auto found = numbers_.find(name); found != numbers_.end()) return found->second;
    std::vector<std::string> names;
    for (const RuleNode& node : graph_.nodes)
      if (names.size() < 20) names.push_back(node.name);
    fail(column, fmt::format("the {} graph has no node {}", name_of(side_), in_quotes(name)),
         suggestion(name, names, "its nodes"));
  }

  void connect(const Link& link) {
    const int from = find(link.from, link.from_column);
    RuleNode& node = graph_.nodes[static_cast<std::size_t>(from)];
    if (link.to.empty()) return say(node, link.i, {RuleLink::Kind::Loop, from}, link.from_column);
    const int to = find(link.to, link.to_column);
    if (from == to)
      fail(link.from_column, fmt::format("an arc joins node {} to itself by α{}", link.from, link.i),
           fmt::format("a free link is {}|{}", link.from, link.i));
    say(node, link.i, {RuleLink::Kind::Arc, to}, link.from_column);
    say(graph_.nodes[static_cast<std::size_t>(to)], link.i, {RuleLink::Kind::Arc, from}, link.to_column);
  }

  RuleSide side_;
  std::string_view text_;
  std::size_t at_ = 0;
  RuleGraph graph_;
  std::map<std::string, int, std::less<>> numbers_; // of nodes, by name
  std::vector<Link> links_;                         // connected when all nodes are known
};

std::string text_of(const RuleNode& node) {
  std::string out = node.name + (node.hook ? "*" : "");
  for (std::size_t p = 0; p < node.label.size(); ++p) {
    out += p == 0 ? "(" : ",";
    out += node.label[p] == RuleNode::dropped ? "_" : std::to_string(node.label[p]);
  }
  return node.label.empty() ? out : out + ")";
}

} // namespace

RuleGraph RuleGraph::parse(RuleSide side, std::string_view text) {
  return Parser(side, text).run();
}

int RuleGraph::find(std::string_view name) const {
  for (int n = 0; n < size(); ++n)
    if ((*this)[n].name == name) return n;
  return -1;
}

std::vector<bool> RuleGraph::reach(int node, Orbit allowed) const {
  std::vector<bool> marked(nodes.size());
  std::vector<int> stack{node};
  marked[static_cast<std::size_t>(node)] = true;
  while (!stack.empty()) {
    const int n = stack.back();
    stack.pop_back();
    for (int i = 0; i < 4; ++i) {
      const RuleLink& next = link(n, i);
      if (!allowed.has(i) || next.kind != RuleLink::Kind::Arc || marked[static_cast<std::size_t>(next.to)])
        continue;
      marked[static_cast<std::size_t>(next.to)] = true;
      stack.push_back(next.to);
    }
  }
  return marked;
}

std::string RuleGraph::print() const {
  std::string out;
  const auto append = [&](const std::string& item) { out += (out.empty() ? "" : " ") + item; };
  for (const RuleNode& node : nodes) append(text_of(node));
  for (int n = 0; n < size(); ++n)
    for (int i = 0; i < 4; ++i)
      if (link(n, i).kind == RuleLink::Kind::Arc && link(n, i).to > n)
        append(fmt::format("{}-{}-{}", (*this)[n].name, i, (*this)[link(n, i).to].name));
  for (int n = 0; n < size(); ++n) {
    std::string loops;
    for (int i = 0; i < 4; ++i)
      if (link(n, i).kind == RuleLink::Kind::Loop) loops += (loops.empty() ? "" : ",") + std::to_string(i);
    if (!loops.empty()) append((*this)[n].name + "|" + loops);
  }
  return out;
}

} // namespace rend
