#include "sim/rules/rule_vocabulary.h"

#include "sim/base/check.h"
#include "sim/base/wording.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

struct NamedOrbit {
  std::string name;
  MeanOf of;
  Orbit orbit; // within which the mean is one
};

const std::vector<NamedOrbit>& orbits_with_vertices() {
  static const std::vector<NamedOrbit> orbits{
      {"vertex", MeanOf::Orbit, Vertex},       {"edge", MeanOf::Orbit, Edge},
      {"face", MeanOf::Orbit, Face},           {"volume", MeanOf::Orbit, Volume},
      {"component", MeanOf::Orbit, Component}, {"neighbours", MeanOf::Neighbours, Vertex},
      {"border", MeanOf::Border, Vertex},      {"faces", MeanOf::Faces, Vertex},
      {"volumes", MeanOf::Volumes, Vertex}};
  return orbits;
}

const NamedOrbit& find_orbit(std::string_view name) {
  const std::vector<NamedOrbit>& all = orbits_with_vertices();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const NamedOrbit& each) { return each.name == name; });
  CHECK_NOTE(found != all.end(), std::string(name));
  return *found;
}

// What the second name of a call may be, and what such a name is.
struct SecondName {
  const char* what;
  std::vector<std::string> allowed;
};
const SecondName& second_name_of(RuleFunction function) {
  static const SecondName direction{"direction", {"normal", "face", "edge"}},
      normal{"cell with a normal", {"face", "vertex"}}, place{"place", {"element", "vertex"}};
  static const SecondName orbit = [] {
    SecondName all{"orbit", {}};
    for (const NamedOrbit& each : orbits_with_vertices()) all.allowed.push_back(each.name);
    return all;
  }();
  if (function == RuleFunction::Along) return direction;
  if (function == RuleFunction::Normal) return normal;
  return function == RuleFunction::Stress || function == RuleFunction::Strain ? place : orbit;
}

constexpr std::string_view call_of_alpha = "alpha(";

} // namespace

MeanOf mean_of_name(std::string_view name) {
  return find_orbit(name).of;
}

Orbit orbit_of_call(const ExpressionCall& call, int link) {
  if (call.function >= rule_functions) return Vertex; // a node: its point
  switch (static_cast<RuleFunction>(call.function)) {
  case RuleFunction::Mean:
  case RuleFunction::Size:
    return find_orbit(call.names[1]).orbit;
  case RuleFunction::Along:
    // Seen from the two sides of a face in a solid, its normals are opposite.
    return call.names[1] == "normal" ? Vertex : call.names[1] == "face" ? VertexOfFace : EdgeEnd;
  case RuleFunction::Normal:
    return call.names[1] == "vertex" ? Vertex : FaceOfVolume;
  case RuleFunction::LengthOf:
    return Edge;
  case RuleFunction::AreaOf:
    return Face;
  case RuleFunction::VolumeOf:
    return Volume;
  case RuleFunction::Free: { // across links that commute with it, it is free as well
    Orbit same;
    for (int i = 0; i < 4; ++i)
      if (link >= 0 && i - link != 1 && link - i != 1)
        same.mask = static_cast<std::uint8_t>(same.mask | 1 << i);
    return same;
  }
  case RuleFunction::Marked:
    return SingleDart;
  case RuleFunction::Stress:
  case RuleFunction::Strain:
    // An element of a sheet; a rule does not know whether it will run in a solid, where α2 stays in one, too.
    return call.names[1] == "vertex" ? Vertex : FaceOfVolume;
  default:
    return Vertex;
  }
}

NamedDart named_dart(std::string_view name) {
  NamedDart dart;
  for (; name.starts_with(call_of_alpha); ++dart.calls) name.remove_prefix(call_of_alpha.size());
  dart.node = name.substr(0, name.find(','));
  for (char c : name.substr(dart.node.size()))
    if (c >= '0' && c <= '9') dart.links += c;
  return dart;
}

bool is_node(const ExpressionCall& call, const RuleGraph& left) {
  return call.function >= rule_functions && call.function < rule_functions + left.nodes.size();
}

std::string_view dart_of_call(const ExpressionCall& call, const RuleGraph& left) {
  if (is_node(call, left)) return left.nodes[call.function - rule_functions].name;
  return call.names.empty() ? std::string_view() : std::string_view(call.names[0]);
}

std::vector<ExpressionFunction> rule_vocabulary(const RuleGraph& left, std::span<const std::string> wheres) {
  using enum ValueType;
  std::vector<ExpressionFunction> all{
      {"alpha", {Name, Scalar}, Vector, "", 0, true},
      {"copy", {Name}, Vector, "the point across that link; its point"},
      {"mean",
       {Name, Name},
       Vector,
       "of the vertices of its vertex, edge, face, volume, component; of those across the edges at its vertex "
       "(neighbours), or along the border or hull (border); of the middles of the faces, volumes there"},
      {"lerp", {Vector, Vector, Scalar}, Vector, "(1 - t) u + t v"},
      {"along",
       {Name, Name, Scalar},
       Vector,
       "moved [m] along normal (of its vertex), face (its normal) or edge"},
      {"normal", {Name, Name}, Vector, "the unit normal of its face or vertex"},
      {"size", {Name, Name}, Scalar, "how many those are that mean is of; of a vertex: its edges"},
      {"length", {Name}, Scalar, ""},
      {"area", {Name}, Scalar, ""},
      {"volume", {Name}, Scalar, "of its edge, face, volume at rest [m, m2, m3]"},
      {"free", {Name, Scalar}, Condition, "whether that link is free"},
      {"marked", {Name, Name}, Condition, "whether a step of a script has given it that mark"},
      {"stress", {Name, Name}, Scalar, ""},
      {"strain", {Name, Name}, Scalar, "largest principal one, in <tear> alone: element, vertex"},
      {"value", {}, Scalar, ""},
      {"across", {}, Vector, ""},
      {"time", {}, Scalar, "criterion's value; normal of the splitting plane; [s]: in <tear>"},
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
    const NamedDart dart = named_dart(call.names[0]);
    if (left.find(dart.node) < 0)
      throw ExpressionError(call.columns[0], fmt::format("the left graph has no node {}", in_quotes(dart.node)),
                            suggestion(dart.node, nodes, "its nodes"));
    if (dart.links.size() != dart.calls || dart.links.find_first_not_of("0123") != std::string::npos)
      throw ExpressionError(call.columns[0],
                            fmt::format("{} follows no link: 0, 1, 2 and 3 are", call.names[0]));
    if (call.names.size() < 2 || call.function == static_cast<std::size_t>(RuleFunction::Marked)) continue;
    const auto& [what, allowed] = second_name_of(static_cast<RuleFunction>(call.function));
    if (std::find(allowed.begin(), allowed.end(), call.names[1]) == allowed.end())
      throw ExpressionError(call.columns[1], fmt::format("{} is no {}", in_quotes(call.names[1]), what),
                            suggestion(call.names[1], allowed, "there are"));
  }
}

} // namespace rend
