// The velocities of vertices that rules make: the derivative in time of where the rule puts them, by central
// differences of the same rule on the body a moment before and after.
#include "sim/house_rules/house_rules.h"
#include "tests/sim/assets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::velocity_test {
namespace {

// Every vertex moves along a straight line of its own.
assets::Body moving(const char* name, double time) {
  assets::Body body = std::string(name) == "sheet" ? assets::grid(3, 2) : assets::row_of_cubes(2);
  for (Slot v = 0; v < body->position().values().size(); ++v) {
    const Vec3 velocity(std::sin(2.0 * v), std::cos(3.0 * v), std::sin(5.0 * v + 1));
    const Vec3 bump = 0.1 * Vec3(std::sin(7.0 * v), std::sin(11.0 * v), std::cos(13.0 * v));
    body->position()[v] = Record(body->rest()[v].vec() + bump + time * velocity);
    body->velocity()[v] = Record(velocity);
  }
  return body;
}

// A single dart c is made beside a dart a and the other end b of its side.
Rule beside(const std::string& position, const std::string& velocity = "") {
  return Rule(RuleSettings{.name = "beside",
                           .left = "a* b a-0-b",
                           .right = "a b c a-0-b c|0,1,2,3",
                           .sets = {{.node = "c", .position = position, .rest = "a", .velocity = velocity}}});
}

constexpr Dart hook{5u};

Point made(const Rule& rule, const char* name, double time) {
  const assets::Body body = moving(name, time);
  const Applied done = apply(rule, *body, hook);
  EXPECT_TRUE(done.ok) << done.reason;
  if (!done.ok) return {};
  const Slot v = body->vertex(done.dart("c"));
  return {body->position()[v].vec(), body->rest()[v].vec(), body->velocity()[v].vec()};
}

TEST(Velocity, of_what_is_born_is_the_derivative_of_its_position) {
  for (const char* name : {"sheet", "solid"})
    for (const char* position :
         {"a", "copy(a)", "mean(a, edge)", "mean(a, face)", "mean(a, component)", "lerp(a, b, 0.25)",
          "lerp(a, b, 0.25 + 0.5*x(b))", "along(a, normal, 0.3)", "along(a, face, 0.1*y(b))",
          "along(a, edge, 0.5)", "along(a, edge, norm(b - a)/3)",
          "a + (b - a)*(x(mean(a, face))/(x(b) - x(a)))", "cross(a - b, mean(a, face))",
          "point(sin(x(a)), y(b)*z(a), norm(b - a))", "a + 0.1*noise(3*b)*(b - a)",
          "a/(1 + dot(a, b)^2) + point(length(a), area(a), size(a, face))"}) {
      SCOPED_TRACE(fmt::format("{} of a {}", position, name));
      constexpr double h = 1e-5, time = 0.07;
      const Rule rule = beside(position);
      const Vec3 expected =
          (made(rule, name, time + h).position - made(rule, name, time - h).position) / (2 * h);
      EXPECT_LT((made(rule, name, time).velocity - expected).norm(), 1e-7 * (1 + expected.norm()));
    }
}

// Of a midpoint that wanders along its edge: (1 - t) a' + t b' + t' (b - a).
TEST(Velocity, of_a_point_that_wanders_is_that_of_the_formula) {
  const assets::Body body = moving("sheet", 0);
  const Dart other = body->map().alpha(0, hook);
  const Vec3 a = body->position_of(hook), b = body->position_of(other),
             of_a = body->velocity()[body->vertex(hook)], of_b = body->velocity()[body->vertex(other)];
  const double t = 0.25 + 0.5 * b.x();
  const Vec3 expected = (1 - t) * of_a + t * of_b + 0.5 * of_b.x() * (b - a);
  EXPECT_LT((made(beside("lerp(a, b, 0.25 + 0.5*x(b))"), "sheet", 0).velocity - expected).norm(), 1e-15);
}

TEST(Velocity, that_is_given_is_taken_and_the_position_not_differentiated) {
  const assets::Body body = moving("sheet", 0);
  // Of infinite slope there.
  const std::string tip = fmt::format("a + point(0, 0, sqrt(x(a) - ({})))", body->position_of(hook).x());
  const Applied refused = apply(beside(tip), *body, hook);
  EXPECT_FALSE(refused.ok);
  EXPECT_NE(refused.reason.find("sqrt(0) changes at no finite rate"), std::string::npos) << refused.reason;
  const Point point = made(beside(tip, "0.5*a + point(1, 0, 0)"), "sheet", 0);
  EXPECT_EQ(point.position, body->position_of(hook));
  EXPECT_EQ(point.velocity, Vec3(0.5 * body->velocity()[body->vertex(hook)].vec() + Vec3(1, 0, 0)));
}

} // namespace
} // namespace rend::velocity_test
