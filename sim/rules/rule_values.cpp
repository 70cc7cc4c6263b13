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

Value to_value(const Vec3& v) {
  return vector_value(v.x(), v.y(), v.z());
}
Vec3 to_vec(const Value& value) {
  return {value.number[0], value.number[1], value.number[2]};
}

const char* normal_of(const ExpressionCall& call) {
  return call.names[1] == "vertex" ? "normal" : "face"; // as directions are called
}

constexpr double least_weight = 1e-12; // a smaller one is round-off

// Whether weights are those of a mean. One vertex that is named twice counts once, by the sum; what has no
// weight is no parent.
bool made_a_mean(std::vector<Parent>& parents) {
  std::vector<Parent> distinct;
  double sum = 0;
  for (const Parent& each : parents) {
    const auto same = std::ranges::find(distinct, each.dart, &Parent::dart);
    if (same == distinct.end())
      distinct.push_back(each);
    else
      same->weight += each.weight;
    sum += each.weight;
  }
  if (std::ranges::any_of(distinct, [](const Parent& each) { return each.weight < -least_weight; }) ||
      std::abs(sum - 1) > least_weight)
    return false;
  std::erase_if(distinct, [](const Parent& each) { return each.weight < least_weight; });
  parents = std::move(distinct);
  return true;
}

} // namespace

Dart RuleValues::dart(std::string_view name, std::size_t instance) const {
  const NamedDart named = named_dart(name);
  Dart d = match_.dart(instance, rule_.left.find(named.node));
  for (char link : named.links) d = edit_.map().alpha(link - '0', d);
  return d;
}

Vec3 RuleValues::part_of(Dart d, PointPart part) const {
  const Point point = edit_.point(d);
  return part == PointPart::Position ? point.position : part == PointPart::Rest ? point.rest : point.velocity;
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
  mean_.call = nullptr;
  const Dart d = dart(call.names[0], instance);
  const MeanOf of = mean_of_name(call.names[1]);
  switch (of) {
  case MeanOf::Orbit:
    vertices_of_orbit(edit_, orbit_of_call(call), d, mean_.vertices);
    mean_.point = mean_point(edit_, mean_.vertices);
    break;
  case MeanOf::Neighbours:
  case MeanOf::Border:
    ends_of_edges(edit_.map(), d, of == MeanOf::Border, mean_.vertices);
    if (mean_.vertices.empty())
      throw ExpressionError(1, fmt::format("there is no {} at a vertex", call.names[1]));
    mean_.point = mean_point(edit_, mean_.vertices);
    break;
  case MeanOf::Faces:
  case MeanOf::Volumes:
    mean_.point = mean_of_cells(edit_, of == MeanOf::Faces ? Face : Volume, d, mean_.vertices);
    break;
  }
  mean_.call = &call;
  mean_.instance = instance;
  return mean_;
}

double RuleValues::count(const ExpressionCall& call, std::size_t instance) const {
  const GMap& map = edit_.map();
  const Dart d = dart(call.names[0], instance);
  const MeanOf of = mean_of_name(call.names[1]);
  if (of == MeanOf::Faces || of == MeanOf::Volumes)
    return static_cast<double>(cells_at_vertex(map, of == MeanOf::Faces ? Face : Volume, d).size());
  const Orbit orbit = orbit_of_call(call);
  std::vector<Dart> found;
  if (of == MeanOf::Orbit && !(orbit == Vertex))
    vertices_of_orbit(map, orbit, d, found);
  else
    ends_of_edges(map, d, of == MeanOf::Border, found);
  return static_cast<double>(found.size());
}

Value RuleValues::call(const ExpressionCall& call, std::span<const Value> arguments, std::size_t instance,
                       PointPart part) const {
  if (is_node(call, rule_.left))
    return to_value(part_of(match_.dart(instance, static_cast<int>(call.function - rule_functions)), part));
  if (const Rule::Let* found = rule_.find_let(call)) return let(*found, instance, part);
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
  case RuleFunction::Alpha:
  case RuleFunction::Copy:
    return to_value(part_of(d, part));
  case RuleFunction::Mean: {
    const Point& mean = mean_of(call, instance).point;
    return to_value(part == PointPart::Position ? mean.position
                    : part == PointPart::Rest   ? mean.rest
                                                : mean.velocity);
  }
  case RuleFunction::Along:
    if (part == PointPart::Velocity) return to_value(part_of(d, part));
    return to_value(part_of(d, part) +
                    arguments[0].scalar() *
                        direction_at(edit_, d, call.names[1], part == PointPart::Rest, context_.sides).unit);
  case RuleFunction::Normal:
    return to_value(direction_at(edit_, d, normal_of(call), part == PointPart::Rest, context_.sides).unit);
  case RuleFunction::Size:
    return scalar_value(count(call, instance));
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
  case RuleFunction::Marked:
    return condition_value(context_.marks && context_.marks->has(d, call.names[1]));
  default:
    return quantity(call, d);
  }
}

Value RuleValues::rate(const ExpressionCall& call, std::span<const Value> arguments,
                       std::span<const Value> rates, std::size_t instance) const {
  const Value none{};
  if (const Rule::Let* found = rule_.find_let(call)) return rate_of_let(*found, instance);
  if (is_node(call, rule_.left))
    return to_value(
        part_of(match_.dart(instance, static_cast<int>(call.function - rule_functions)), PointPart::Velocity));
  if (call.function >= rule_functions) return none; // an argument
  switch (static_cast<RuleFunction>(call.function)) {
  case RuleFunction::Alpha:
  case RuleFunction::Copy:
    return to_value(part_of(dart(call.names[0], instance), PointPart::Velocity));
  case RuleFunction::Mean:
    return to_value(mean_of(call, instance).point.velocity);
  case RuleFunction::Lerp: {
    const double t = arguments[2].scalar();
    return to_value((1 - t) * to_vec(rates[0]) + t * to_vec(rates[1]) +
                    rates[2].scalar() * (to_vec(arguments[1]) - to_vec(arguments[0])));
  }
  case RuleFunction::Along: {
    const Dart d = dart(call.names[0], instance);
    const Direction direction = direction_at(edit_, d, call.names[1], false, context_.sides);
    return to_value(part_of(d, PointPart::Velocity) + rates[0].scalar() * direction.unit +
                    arguments[0].scalar() * direction.rate);
  }
  case RuleFunction::Normal:
    return to_value(
        direction_at(edit_, dart(call.names[0], instance), normal_of(call), false, context_.sides).rate);
  case RuleFunction::Time:
    return scalar_value(1);
  default:
    return none;
  }
}

Vec3 RuleValues::vector(const Expression& expression, std::size_t instance, PointPart part) const {
  return to_vec(
      expression.evaluate([&](const ExpressionCall& each, std::size_t, std::span<const Value> arguments) {
        return call(each, arguments, instance, part);
      }));
}

ValueAndRate RuleValues::moving(const Expression& expression, std::size_t instance) const {
  return expression.evaluate_with_rate([&](const ExpressionCall& each, std::size_t,
                                           std::span<const Value> arguments,
                                           std::span<const Value> rates) -> ValueAndRate {
    return {call(each, arguments, instance, PointPart::Position), rate(each, arguments, rates, instance)};
  });
}

Value RuleValues::let(const Rule::Let& let, std::size_t instance, PointPart part) const {
  Known& known = lets_[static_cast<std::size_t>(&let - rule_.lets.data())];
  if (!known.value_known || known.instance != instance || known.part != part) {
    known.value =
        let.value.evaluate([&](const ExpressionCall& each, std::size_t, std::span<const Value> arguments) {
          return call(each, arguments, instance, part);
        });
    known.value_known = true;
    known.instance = instance;
    known.part = part;
  }
  return known.value;
}

Value RuleValues::rate_of_let(const Rule::Let& let, std::size_t instance) const {
  Known& known = lets_[static_cast<std::size_t>(&let - rule_.lets.data())];
  if (!known.rate_known || known.instance_of_rate != instance) {
    known.rate = moving(let.value, instance).rate;
    known.rate_known = true;
    known.instance_of_rate = instance;
  }
  return known.rate;
}

void RuleValues::place(const Rule::Set& set, std::size_t instance, bool rest_follows, Point& point) const {
  if (set.position && set.velocity) point.position = vector(*set.position, instance, PointPart::Position);
  if (set.position && !set.velocity) {
    const ValueAndRate found = moving(*set.position, instance);
    point.position = to_vec(found.value);
    point.velocity = to_vec(found.rate);
  }
  if (set.rest)
    point.rest = vector(*set.rest, instance, PointPart::Rest);
  else if (set.position && rest_follows)
    point.rest = vector(*set.position, instance, PointPart::Rest);
  if (set.velocity) point.velocity = vector(*set.velocity, instance, PointPart::Velocity);
}

Point RuleValues::moved(const Rule::Set& set, std::size_t instance, const Point& was) const {
  Point point = was;
  const bool in_a_law = context_.quantities != nullptr;
  place(set, instance, !in_a_law, point);
  return point;
}

Point RuleValues::point(const Rule::Set& set, std::size_t instance) const {
  Point point;
  place(set, instance, true, point);
  return point;
}

void RuleValues::parents(const Rule::Set& set, std::size_t instance, std::vector<Parent>& out) const {
  out.clear();
  if (!set.position) return;
  std::vector<bool> met(rule_.lets.size());
  std::vector<Source> sources;
  add_sources(*set.position, met, sources);
  if (sources.size() > 1 && weigh(*set.position, instance, sources)) {
    for (const Source& source : sources) add_parents(source, instance, out);
    if (made_a_mean(out)) return;
    out.clear();
  }
  for (const Source& source : sources) add_parents({source.call, 1}, instance, out);
  for (Parent& parent : out) parent.weight = 1 / static_cast<double>(out.size());
}

void RuleValues::add_sources(const Expression& expression, std::vector<bool>& met,
                             std::vector<Source>& out) const {
  for (const ExpressionCall& call : expression.calls()) {
    if (const Rule::Let* let = rule_.find_let(call)) {
      const auto n = static_cast<std::size_t>(let - rule_.lets.data());
      if (met[n]) continue;
      met[n] = true;
      add_sources(let->value, met, out);
    } else if (is_node(call, rule_.left) || call.function <= static_cast<std::size_t>(RuleFunction::Mean) ||
               call.function == static_cast<std::size_t>(RuleFunction::Along)) {
      out.push_back({&call, 0});
    }
  }
}

void RuleValues::add_parents(const Source& source, std::size_t instance, std::vector<Parent>& out) const {
  if (source.call->function != static_cast<std::size_t>(RuleFunction::Mean)) {
    out.push_back({dart(dart_of_call(*source.call, rule_.left), instance), source.weight});
    return;
  }
  const std::vector<Dart>& vertices = mean_of(*source.call, instance).vertices;
  for (Dart d : vertices) out.push_back({d, source.weight / static_cast<double>(vertices.size())});
}

bool RuleValues::weigh(const Expression& expression, std::size_t instance, std::span<Source> sources) const {
  try {
    for (Source& source : sources) {
      const Vec3 rate = to_vec(rate_by(source, expression, instance));
      source.weight = rate.x();
      if ((rate.array() - rate.x()).abs().maxCoeff() > least_weight) return false;
    }
    return true;
  } catch (const ExpressionError&) { // a rate that is not finite
    return false;
  }
}

Value RuleValues::rate_by(const Source& source, const Expression& expression, std::size_t instance) const {
  const auto rate = [&](const ExpressionCall& each, std::span<const Value> arguments,
                        std::span<const Value> rates) -> Value {
    if (&each == source.call) return vector_value(1, 1, 1);
    if (const Rule::Let* let = rule_.find_let(each)) return rate_by(source, let->value, instance);
    if (each.function != static_cast<std::size_t>(RuleFunction::Lerp)) return {};
    const double t = arguments[2].scalar();
    return to_value((1 - t) * to_vec(rates[0]) + t * to_vec(rates[1]));
  };
  return expression
      .evaluate_with_rate([&](const ExpressionCall& each, std::size_t, std::span<const Value> arguments,
                              std::span<const Value> rates) -> ValueAndRate {
        return {call(each, arguments, instance, PointPart::Position), rate(each, arguments, rates)};
      })
      .rate;
}

Value RuleValues::value(const Expression& expression, std::size_t instance) const {
  return expression.evaluate([&](const ExpressionCall& each, std::size_t, std::span<const Value> arguments) {
    return call(each, arguments, instance, PointPart::Position);
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
