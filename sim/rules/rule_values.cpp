#include "sim/rules/rule_values.h"

#include "sim/base/check.h"
#include "sim/base/wording.h"
#include "sim/rules/rest_measures.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

struct NamedOrbit {
  std::string name;
  Orbit orbit;
};

const std::vector<NamedOrbit>& orbits_with_vertices() {
  static const std::vector<NamedOrbit> orbits{
      {"vertex", Vertex}, {"edge", Edge}, {"face", Face}, {"volume", Volume}, {"component", Component}};
  return orbits;
}

const Orbit* find_orbit(std::string_view name) {
  for (const NamedOrbit& each : orbits_with_vertices())
    if (each.name == name) return &each.orbit;
  return nullptr;
}

// What the second name of a call may be, and what such a name is.
struct SecondName {
  const char* what;
  std::vector<std::string> allowed;
};
const SecondName& second_name_of(RuleFunction function) {
  static const SecondName direction{"direction", {"normal", "face", "edge"}},
      place{"place", {"element", "vertex"}};
  static const SecondName orbit = [] {
    SecondName all{"orbit", {}};
    for (const NamedOrbit& each : orbits_with_vertices()) all.allowed.push_back(each.name);
    return all;
  }();
  if (function == RuleFunction::Along) return direction;
  return function == RuleFunction::Stress || function == RuleFunction::Strain ? place : orbit;
}

Value to_value(const Vec3& v) {
  return vector_value(v.x(), v.y(), v.z());
}
Vec3 to_vec(const Value& value) {
  return {value.number[0], value.number[1], value.number[2]};
}

// The orbit within which a call has one value.
Orbit orbit_of_call(const ExpressionCall& call) {
  if (call.function >= rule_functions) return Vertex; // a node: its point
  switch (static_cast<RuleFunction>(call.function)) {
  case RuleFunction::Mean:
  case RuleFunction::Size:
    return call.names.size() > 1 ? *find_orbit(call.names[1]) : Vertex;
  case RuleFunction::Along:
    // Seen from the two sides of a face in a solid, its normals are opposite.
    return call.names[1] == "normal" ? Vertex : call.names[1] == "face" ? VertexOfFace : EdgeEnd;
  case RuleFunction::LengthOf:
    return Edge;
  case RuleFunction::AreaOf:
    return Face;
  case RuleFunction::VolumeOf:
    return Volume;
  case RuleFunction::Stress:
  case RuleFunction::Strain:
    // An element of a sheet; a rule does not know whether it will run in a solid, where α2 stays in one, too.
    return call.names[1] == "vertex" ? Vertex : FaceOfVolume;
  default:
    return Vertex;
  }
}

// Of its calls: how many functions come before the nodes' names.
bool is_node(const ExpressionCall& call, const RuleGraph& left) {
  return call.function >= rule_functions && call.function < rule_functions + left.nodes.size();
}

} // namespace

std::vector<ExpressionFunction> rule_vocabulary(const RuleGraph& left, std::span<const std::string> wheres) {
  using enum ValueType;
  std::vector<ExpressionFunction> all{
      {"copy", {Name}, Vector, "the point of a node"},
      {"mean", {Name, Name}, Vector, "the mean of the vertices of its vertex, edge, face, volume, component"},
      {"lerp", {Vector, Vector, Scalar}, Vector, "(1 - t) u + t v"},
      {"along",
       {Name, Name, Scalar},
       Vector,
       "a node's point, moved along the normal of its vertex (normal), of its face (face), or along its edge "
       "(edge) [m]"},
      {"size", {Name, Name}, Scalar, "how many vertices its edge, face ... has; of a vertex: how many edges"},
      {"length", {Name}, Scalar, "of a node's edge, at rest [m]"},
      {"area", {Name}, Scalar, "of a node's face, at rest [m2]"},
      {"volume", {Name}, Scalar, "of a node's volume, at rest [m3]"},
      {"free", {Name, Scalar}, Condition, "whether that link of a node is free"},
      {"stress",
       {Name, Name},
       Scalar,
       "the largest principal stress [Pa] of its element (element), or of the mean at its vertex (vertex); "
       "this "
       "and the next four: of <tear>"},
      {"strain", {Name, Name}, Scalar, "the same of the strain"},
      {"value", {}, Scalar, "what the criterion found, in its unit"},
      {"across", {}, Vector, "the normal of the plane that would split a vertex"},
      {"time", {}, Scalar, "the time [s]; all five are as before the step's changes"},
  };
  CHECK(all.size() == rule_functions);
  for (const RuleNode& node : left.nodes) all.push_back({node.name, {}, Vector, "the point of this node"});
  for (const std::string& name : wheres) all.push_back({name, {}, Scalar, "an argument of the rule"});
  return all;
}

void check_names(const Expression& expression, const RuleGraph& left) {
  std::vector<std::string> nodes;
  for (const RuleNode& node : left.nodes) nodes.push_back(node.name);
  for (const ExpressionCall& call : expression.calls()) {
    if (call.function >= rule_functions || call.names.empty()) continue;
    if (left.find(call.names[0]) < 0)
      throw ExpressionError(call.columns[0],
                            fmt::format("the left graph has no node {}", in_quotes(call.names[0])),
                            suggestion(call.names[0], nodes, "its nodes"));
    if (call.names.size() < 2) continue;
    const auto& [what, allowed] = second_name_of(static_cast<RuleFunction>(call.function));
    if (std::find(allowed.begin(), allowed.end(), call.names[1]) == allowed.end())
      throw ExpressionError(call.columns[1], fmt::format("{} is no {}", in_quotes(call.names[1]), what),
                            suggestion(call.names[1], allowed, "there are"));
  }
}

bool keeps_value(const ExpressionCall& call, const RuleGraph& left, int p) {
  int node = -1;
  if (is_node(call, left)) node = static_cast<int>(call.function - rule_functions);
  if (call.function < rule_functions && !call.names.empty()) node = left.find(call.names[0]);
  if (node < 0) return true; // a number
  const int link = left[node].label[static_cast<std::size_t>(p)];
  return link != RuleNode::dropped && orbit_of_call(call).has(link);
}

Dart RuleValues::dart(std::string_view node, std::size_t instance) const {
  return match_.dart(instance, rule_.left.find(node));
}

Vec3 RuleValues::part_of(Dart d, PointPart part) const {
  const Point point = edit_.point(d);
  return part == PointPart::Position ? point.position : part == PointPart::Rest ? point.rest : point.velocity;
}

double RuleValues::side(Dart d) const {
  if (!context_.sides) context_.sides = sides_of(edit_.map());
  if (!context_.sides->orientable) throw ExpressionError(1, "a surface with one side has no normal");
  return d.value < context_.sides->of_dart.size() && context_.sides->of_dart[d.value] == 2 ? -1 : 1;
}

Vec3 RuleValues::direction(Dart d, std::string_view which, PointPart part) const {
  const auto member = part == PointPart::Rest ? &Point::rest : &Point::position;
  const GMap& map = edit_.map();
  Vec3 sum = Vec3::Zero();
  if (which == "edge") {
    sum = edit_.point(map.alpha(0, d)).*member - edit_.point(d).*member;
  } else {
    const auto face = [&](Dart e) -> Vec3 {
      if (map.dimension() == 2) return side(e) * face_vector(edit_, e, member);
      const Vec3 n = face_vector(edit_, e, member);
      const Vec3 outward = mean_point(edit_, FaceOfVolume, e).*member - mean_point(edit_, Volume, e).*member;
      const double out = n.dot(outward), length = std::sqrt(n.norm());
      if (std::abs(out) <= 1e-9 * length * length * length)
        return side(e) * n; // a flat volume, as a face alone
      return out < 0 ? Vec3(-n) : n;
    };
    if (which == "face") {
      sum = face(d);
    } else {
      for (Dart e : darts_of(map, Vertex, d))
        if ((map.dimension() == 2 || map.is_free(3, e)) && e <= map.alpha(1, e))
          sum += face(e); // once a corner
    }
  }
  const double length = sum.norm();
  if (!(length > 0))
    throw ExpressionError(1, fmt::format("there is no direction '{}' at dart {}", which, d.value));
  return sum / length;
}

Value RuleValues::quantity(const ExpressionCall& call, Dart d) const {
  using Of = RuleQuantities::Of;
  RuleQuantities* const from = context_.quantities;
  if (!from)
    throw ExpressionError(1, "stress, strain, value, across and time are known to laws of tearing alone");
  const auto of = [&] { return call.names[1] == "vertex" ? Of::AtVertex : Of::InElement; };
  switch (static_cast<RuleFunction>(call.function)) {
  case RuleFunction::Stress:
    return scalar_value(from->stress(edit_, d, of()));
  case RuleFunction::Strain:
    return scalar_value(from->strain(edit_, d, of()));
  case RuleFunction::Found:
    return scalar_value(from->value);
  case RuleFunction::Across:
    return to_value(from->across);
  default:
    return scalar_value(from->time);
  }
}

const RuleValues::Mean& RuleValues::mean_of(const ExpressionCall& call, std::size_t instance) const {
  if (mean_.call == &call && mean_.instance == instance) return mean_;
  mean_.call = &call;
  mean_.instance = instance;
  vertices_of_orbit(edit_, orbit_of_call(call), dart(call.names[0], instance), mean_.vertices);
  mean_.point = mean_point(edit_, mean_.vertices);
  return mean_;
}

Value RuleValues::call(const ExpressionCall& call, std::span<const Value> arguments, std::size_t instance,
                       PointPart part, bool at_zero) const {
  if (is_node(call, rule_.left)) {
    if (at_zero) return vector_value(0, 0, 0);
    return to_value(part_of(match_.dart(instance, static_cast<int>(call.function - rule_functions)), part));
  }
  if (call.function >= rule_functions) {
    const std::size_t n = call.function - rule_functions - rule_.left.nodes.size();
    return n < context_.wheres.size() ? context_.wheres[n] : rule_.wheres[n].value;
  }
  const auto function = static_cast<RuleFunction>(call.function);
  if (function == RuleFunction::Lerp) {
    const double t = arguments[2].scalar();
    return to_value((1 - t) * to_vec(arguments[0]) + t * to_vec(arguments[1]));
  }
  const Dart d = call.names.empty() ? Dart{} : dart(call.names[0], instance);
  const GMap& map = edit_.map();
  switch (function) {
  case RuleFunction::Copy:
    return to_value(at_zero ? Vec3(Vec3::Zero()) : part_of(d, part));
  case RuleFunction::Mean: {
    if (at_zero) return vector_value(0, 0, 0);
    const Point& mean = mean_of(call, instance).point;
    return to_value(part == PointPart::Position ? mean.position
                    : part == PointPart::Rest   ? mean.rest
                                                : mean.velocity);
  }
  case RuleFunction::Along:
    if (part == PointPart::Velocity) return to_value(at_zero ? Vec3(Vec3::Zero()) : part_of(d, part));
    return to_value(part_of(d, part) + arguments[0].scalar() * direction(d, call.names[1], part));
  case RuleFunction::Size: {
    const Orbit orbit = orbit_of_call(call);
    if (!(orbit == Vertex)) return scalar_value(static_cast<double>(vertices_of_orbit(map, orbit, d).size()));
    IndexSet edges;
    double count = 0;
    for (Dart e : darts_of(map, Vertex, d)) count += edges.insert(smallest_dart(map, Edge, e).value);
    return scalar_value(count);
  }
  case RuleFunction::LengthOf:
    return scalar_value((edit_.point(map.alpha(0, d)).rest - edit_.point(d).rest).norm());
  case RuleFunction::AreaOf:
    return scalar_value(face_vector(edit_, d).norm());
  case RuleFunction::VolumeOf:
    return scalar_value(std::abs(volume_at_rest(edit_, d)));
  case RuleFunction::Free: {
    const double link = arguments[0].scalar();
    for (int i = 0; i < 4; ++i)
      if (link == i) return condition_value(map.is_free(i, d));
    throw ExpressionError(1, fmt::format("{} is no link: 0, 1, 2 and 3 are", link));
  }
  default:
    return quantity(call, d);
  }
}

Vec3 RuleValues::vector(const Expression& expression, std::size_t instance, PointPart part,
                        bool at_zero) const {
  return to_vec(
      expression.evaluate([&](const ExpressionCall& each, std::size_t, std::span<const Value> arguments) {
        return call(each, arguments, instance, part, at_zero);
      }));
}

Point RuleValues::moved(const Rule::Set& set, std::size_t instance, const Point& was) const {
  Point point = was;
  if (set.position) {
    point.position = vector(*set.position, instance, PointPart::Position);
    point.rest = vector(*set.position, instance, PointPart::Rest);
    point.velocity = vector(*set.position, instance, PointPart::Velocity) -
                     vector(*set.position, instance, PointPart::Velocity, true);
  }
  if (set.rest) point.rest = vector(*set.rest, instance, PointPart::Rest);
  if (set.velocity) point.velocity = vector(*set.velocity, instance, PointPart::Velocity);
  return point;
}

Point RuleValues::point(const Rule::Set& set, std::size_t instance) const {
  return moved(set, instance, Point{});
}

void RuleValues::parents(const Rule::Set& set, std::size_t instance, std::vector<Parent>& out) const {
  out.clear();
  if (!set.position) return;
  for (const ExpressionCall& call : set.position->calls()) {
    if (is_node(call, rule_.left)) {
      out.push_back({match_.dart(instance, static_cast<int>(call.function - rule_functions)), 1});
    } else if (call.function == static_cast<std::size_t>(RuleFunction::Mean)) {
      for (Dart d : mean_of(call, instance).vertices) out.push_back({d, 1});
    } else if (call.function == static_cast<std::size_t>(RuleFunction::Copy) ||
               call.function == static_cast<std::size_t>(RuleFunction::Along)) {
      out.push_back({dart(call.names[0], instance), 1});
    }
  }
  for (Parent& parent : out) parent.weight = 1 / static_cast<double>(out.size());
}

Value RuleValues::value(const Expression& expression, std::size_t instance) const {
  return expression.evaluate([&](const ExpressionCall& each, std::size_t, std::span<const Value> arguments) {
    return call(each, arguments, instance, PointPart::Position, false);
  });
}

bool RuleValues::holds(const Rule::When& when) const {
  const auto at = [&](std::size_t instance) { return value(when.test, instance).condition(); };
  if (when.at == RuleWhenSettings::At::Hook) return at(0);
  const bool all = when.at == RuleWhenSettings::At::All;
  for (std::size_t k = 0; k < match_.instances; ++k)
    if (at(k) != all) return !all;
  return all;
}

} // namespace rend
