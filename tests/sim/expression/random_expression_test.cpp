// Random trees of every type, evaluated by walking them; then written as text with parentheses where needed and
// here and there where not, compiled, and evaluated: the same bits.
#include "sim/expression/expression.h"

#include "sim/base/math.h"
#include "sim/expression/noise.h"
#include "sim/expression/vocabulary.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>
#include <optional>
#include <random>

namespace rend::random_expression_test {
namespace {

using Vector = std::array<double, 3>;
enum Type { Scalar, Vector3, Condition };

struct Tree {
  std::string op; // an operator, a function, or a leaf's text
  std::vector<Tree> parts = {};
  double number = 0; // of a leaf "number"
};

// A value; none where something in it is not finite.
using Result = std::optional<Vector>;

Result finite(const Vector& v) {
  return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]) ? Result(v) : std::nullopt;
}

// The type of a tree; the tests of `evaluate` below rely on it.
Type type_of(const Tree& tree) {
  const std::string& op = tree.op;
  if (op == "centre" || op == "point" || op == "cross") return Vector3;
  for (const char* condition : {"free", "and", "or", "not", "<", "<=", ">", ">=", "==", "!="})
    if (op == condition) return Condition;
  if (op == "+" || op == "-" || op == "*" || op == "/")
    for (const Tree& part : tree.parts)
      if (type_of(part) == Vector3) return Vector3;
  return Scalar;
}

double computed(const std::string& op, double a, double b) {
  if (op == "+") return a + b;
  if (op == "-") return a - b;
  if (op == "*") return a * b;
  if (op == "/") return a / b;
  if (op == "^" || op == "pow") return power(a, b);
  if (op == "min") return b < a ? b : a;
  if (op == "max") return a < b ? b : a;
  if (op == "step") return b < a ? 0 : 1;
  if (op == "<") return a < b;
  if (op == "<=") return a <= b;
  if (op == ">") return a > b;
  if (op == ">=") return a >= b;
  if (op == "==") return a == b;
  return a != b;
}

double computed(const std::string& op, double a) {
  if (op == "sin") return sine(a);
  if (op == "cos") return cosine(a);
  if (op == "exp") return exponential(a);
  if (op == "log") return logarithm(a);
  if (op == "sqrt") return std::sqrt(a);
  if (op == "abs") return std::fabs(a);
  return std::floor(a);
}

double inner(const Vector& u, const Vector& v) {
  return u[0] * v[0] + u[1] * v[1] + u[2] * v[2];
}

Result evaluate(const Tree& tree);

Result evaluate_all(const Tree& tree, const std::vector<Vector>& v) {
  const std::string& op = tree.op;
  if (op == "point") return finite({v[0][0], v[1][0], v[2][0]});
  if (op == "clamp") return finite({std::min(std::max(v[0][0], v[1][0]), v[2][0]), 0, 0});
  if (op == "cross")
    return finite({v[0][1] * v[1][2] - v[0][2] * v[1][1], v[0][2] * v[1][0] - v[0][0] * v[1][2],
                   v[0][0] * v[1][1] - v[0][1] * v[1][0]});
  if (op == "dot") return finite({inner(v[0], v[1]), 0, 0});
  if (op == "norm") return finite({std::sqrt(inner(v[0], v[0])), 0, 0});
  if (op == "noise") return finite({noise(v[0]), 0, 0});
  if (op == "x" || op == "y" || op == "z") return finite({v[0][op[0] - 'x'], 0, 0});
  if (op == "not") return Vector{v[0][0] == 0 ? 1.0 : 0.0, 0, 0};
  if (v.size() == 1 && op == "-") {
    if (type_of(tree) == Scalar) return Vector{-v[0][0], 0, 0};
    return Vector{-v[0][0], -v[0][1], -v[0][2]};
  }
  if (v.size() == 1) return finite({computed(op, v[0][0]), 0, 0});
  if (type_of(tree) != Vector3) return finite({computed(op, v[0][0], v[1][0]), 0, 0});
  Vector out;
  for (int axis = 0; axis < 3; ++axis)
    out[axis] = computed(op, v[0][type_of(tree.parts[0]) == Vector3 ? axis : 0],
                         v[1][type_of(tree.parts[1]) == Vector3 ? axis : 0]);
  return finite(out);
}

Result evaluate(const Tree& tree) {
  if (tree.op == "number") return Vector{tree.number, 0, 0};
  if (tree.op == "time") return Vector{0.5, 0, 0};
  if (tree.op == "area(abc)") return Vector{0.75, 0, 0};
  if (tree.op == "centre") return Vector{1, 2, 3};
  if (tree.op == "free") return Vector{1, 0, 0};
  const Result first = evaluate(tree.parts[0]);
  if (!first) return {};
  if (tree.op == "and" && (*first)[0] == 0) return first;
  if (tree.op == "or" && (*first)[0] != 0) return first;
  if (tree.op == "and" || tree.op == "or") return evaluate(tree.parts[1]);
  std::vector<Vector> values = {*first};
  for (std::size_t n = 1; n < tree.parts.size(); ++n) {
    const Result next = evaluate(tree.parts[n]);
    if (!next) return {};
    values.push_back(*next);
  }
  return evaluate_all(tree, values);
}

class Trees {
public:
  explicit Trees(std::uint64_t seed) : random_(seed) {}

  Tree tree(Type type, int depth) {
    return type == Scalar ? scalar(depth) : type == Vector3 ? vector(depth) : condition(depth);
  }

  std::string text(const Tree& tree) {
    if (tree.op == "number") return fmt::format("{}", tree.number);
    if (tree.parts.empty()) return tree.op;
    if (!binds(tree)) {
      std::string out;
      for (const Tree& part : tree.parts) out += (out.empty() ? "" : ",") + text(part);
      return tree.op + "(" + out + ")";
    }
    if (tree.parts.size() == 1)
      return tree.op + (tree.op == "not" ? " " : "") + part(tree.parts[0], binds(tree), true);
    const bool power = tree.op == "^";
    return part(tree.parts[0], binds(tree), !power && binds(tree) != 4) + " " + tree.op + " " +
           part(tree.parts[1], binds(tree), power);
  }

private:
  // 1 or, 2 and, 3 not, 4 comparison, 5 sum, 6 product, 7 sign, 8 power; 0: leaf or call.
  static int binds(const Tree& tree) {
    const std::string& op = tree.op;
    if (op == "or") return 1;
    if (op == "and") return 2;
    if (op == "not") return 3;
    if (op == "-" && tree.parts.size() == 1) return 7;
    if (op == "+" || op == "-") return 5;
    if (op == "*" || op == "/") return 6;
    if (op == "^") return 8;
    return op[0] == '<' || op[0] == '>' || op[0] == '=' || op[0] == '!' ? 4 : 0;
  }
  std::string part(const Tree& tree, int around, bool equal_is_fine) {
    const int own = binds(tree);
    const bool free = own == 0 || own > around || (own == around && equal_is_fine);
    return free && below(5) > 0 ? text(tree) : "(" + text(tree) + ")";
  }

  Tree scalar(int depth) {
    if (depth == 0 || below(6) == 0) {
      static const double numbers[] = {0, 1, 2, 3, 0.1, 0.5, 1e-3, 7.25, 1e5, 1e200, 3e-310, 123456789};
      if (below(4) == 0) return {below(2) ? "time" : "area(abc)"};
      return {.op = "number", .number = numbers[below(std::size(numbers))]};
    }
    const int n = depth - 1;
    switch (below(8)) {
    case 0:
      return {"-", {scalar(n)}};
    case 1:
      return {one_of({"sin", "cos", "exp", "log", "sqrt", "abs", "floor"}), {scalar(n)}};
    case 2:
      return {one_of({"min", "max", "pow", "step"}), {scalar(n), scalar(n)}};
    case 3:
      return {one_of({"x", "y", "z", "norm", "noise"}), {vector(n)}};
    case 4:
      return below(2) ? Tree{"dot", {vector(n), vector(n)}} : Tree{"clamp", {scalar(n), scalar(n), scalar(n)}};
    default:
      return {one_of({"+", "-", "*", "/", "^"}), {scalar(n), scalar(n)}};
    }
  }
  Tree vector(int depth) {
    if (depth == 0) return {"centre"};
    const int n = depth - 1;
    switch (below(6)) {
    case 0:
      return {"-", {vector(n)}};
    case 1:
      return {"cross", {vector(n), vector(n)}};
    case 2:
      return {one_of({"*", "/"}), {vector(n), scalar(n)}};
    case 3:
      return {"*", {scalar(n), vector(n)}};
    case 4:
      return {"point", {scalar(n), scalar(n), scalar(n)}};
    default:
      return {one_of({"+", "-"}), {vector(n), vector(n)}};
    }
  }
  Tree condition(int depth) {
    if (depth == 0) return {"free"};
    const int n = depth - 1;
    switch (below(4)) {
    case 0:
      return {"not", {condition(n)}};
    case 1:
      return {one_of({"<", "<=", ">", ">=", "==", "!="}), {scalar(n), scalar(n)}};
    default:
      return {one_of({"and", "or"}), {condition(n), condition(n)}};
    }
  }
  std::string one_of(const std::vector<std::string>& all) { return all[below(all.size())]; }
  std::size_t below(std::size_t end) { return random_() % end; }
  std::mt19937_64 random_;
};

TEST(RandomExpression, has_the_value_of_its_tree) {
  Trees trees(7);
  int with_value = 0, refused = 0;
  for (int n = 0; n < 60000; ++n) {
    const auto type = static_cast<Type>(n % 3);
    const Tree tree = trees.tree(type, 1 + n % 6);
    const std::string text = trees.text(tree);
    if (text.size() > longest_expression) continue;
    const Result expected = evaluate(tree);
    try {
      const Value found =
          Expression(text, test_vocabulary(), static_cast<ValueType>(type)).evaluate(TestSupply());
      ASSERT_TRUE(expected.has_value()) << text;
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_EQ(std::bit_cast<std::uint64_t>(found.number[axis]),
                  std::bit_cast<std::uint64_t>((*expected)[axis]))
            << text << ": " << found.number[axis] << " and " << (*expected)[axis];
      ++with_value;
    } catch (const ExpressionError& error) {
      ASSERT_FALSE(expected.has_value()) << text << ": " << error.what();
      ++refused;
    }
  }
  EXPECT_GT(with_value, 20000);
  EXPECT_GT(refused, 5000);
}

} // namespace
} // namespace rend::random_expression_test
