#include "sim/topology/rule_check.h"

#include "sim/base/check.h"

#include <fmt/format.h>

namespace rend::rule_fault {
namespace {

template <class... Values> [[noreturn]] void fault(const char* text, Values... values) {
  throw InternalError("a rule is malformed: " + fmt::format(fmt::runtime(text), values...));
}

} // namespace

void node_is_unknown(char node) {
  fault("there is no node {}", node);
}
void node_is_named_twice(char node) {
  fault("two nodes are called {}", node);
}
void there_is_no_such_link(char node, int i) {
  fault("node {} speaks of a link {}; there are 0 to 3", node, i);
}
void link_is_said_twice(char node, int i) {
  fault("node {} says twice what its α{} is", node, i);
}
void arc_should_be_a_loop(char node, int i) {
  fault("an arc joins node {} to itself by α{}", node, i);
}
void labels_differ_in_length(char node) {
  fault("the label of node {} is not as long as the hook's", node);
}
void hook_is_missing(char node) {
  fault("no hook leads to node {}", node);
}
void component_has_two_hooks(char node) {
  fault("two hooks lead to node {}", node);
}
void hook_is_on_the_right(char node) {
  fault("node {} of the right graph is marked as a hook", node);
}
void hook_drops_a_link(char node) {
  fault("the label of hook {} drops a link", node);
}
void link_is_missing(char node, int i) {
  fault("the new node {} does not say what its α{} is", node, i);
}
void kept_node_gains_a_link(char node, int i) {
  fault("node {} is kept but gains α{}", node, i);
}
void kept_node_loses_a_link(char node, int i) {
  fault("node {} is kept but loses α{}", node, i);
}
void removed_node_dangles(char node, int i) {
  fault("node {} is removed, but what its α{} leads to is not matched", node, i);
}
void cycle_is_broken(char node, int i, int j) {
  fault("at node {} α{}α{} is no involution any more", node, i, j);
}
void new_vertex_without_point(char node) {
  fault("the new vertex of node {} has no point", node);
}
void new_vertex_with_two_points(char node) {
  fault("the new vertex of node {} has several points", node);
}
void point_of_a_kept_vertex(char node) {
  fault("the vertex of node {} is kept, but is given a point", node);
}
void point_on_the_left(char node) {
  fault("node {} of the left graph has a point expression", node);
}
void point_from_unknown_node(char node) {
  fault("the point of node {} is not found from a node of the left", node);
}

} // namespace rend::rule_fault
