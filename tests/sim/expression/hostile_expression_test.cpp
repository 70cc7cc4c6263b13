// What users may write by mistake or by intent: endless, deep, random text. Every one is refused with a
// place, or has a finite value and a printed form that means the same.
#include "sim/expression/expression.h"

#include "sim/expression/vocabulary.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace rend::hostile_expression_test {
namespace {

std::string repeated(const std::string& text, int times) {
  std::string out;
  for (int n = 0; n < times; ++n) out += text;
  return out;
}

bool same(const Value& a, const Value& b) {
  return std::bit_cast<std::array<std::uint64_t, 3>>(a.number) ==
         std::bit_cast<std::array<std::uint64_t, 3>>(b.number);
}

TEST(HostileExpression, of_ten_megabytes_is_refused_at_once) {
  for (const std::string part : {"(", "1+", "-", "not ", "a", "1", "^", "\n", "\xff", "sin("}) {
    const std::string text = repeated(part, static_cast<int>(10'000'000 / part.size()));
    const auto start = std::chrono::steady_clock::now();
    const std::string why = refusal(text);
    EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::milliseconds(200));
    EXPECT_EQ(why, "column 4001: the expression has " + std::to_string(text.size()) +
                       " characters; at most 4000 are read");
  }
}

TEST(HostileExpression, may_have_the_greatest_length_and_not_one_more) {
  const std::string sum = repeated("1+", 1999) + "12";
  ASSERT_EQ(sum.size(), longest_expression);
  EXPECT_EQ(scalar_of(sum), 1999 + 12);
  EXPECT_TRUE(refusal(sum + " ").starts_with("column 4001: "));
  // Its normal form would be longer.
  const Expression one(sum, {}, ValueType::Scalar);
  EXPECT_EQ(one.print(), sum);
}

TEST(HostileExpression, may_have_the_greatest_depth_and_not_one_more) {
  struct Nesting {
    std::string open, middle, close;
    ValueType type = ValueType::Scalar;
  };
  for (const auto& [open, middle, close, type] : {Nesting{"(", "1", ")"},
                                                  {"-", "1", ""},
                                                  {"1^", "1", ""},
                                                  {"sin(", "1", ")"},
                                                  {"max(2,", "1", ")"},
                                                  {"not ", "free", "", ValueType::Condition},
                                                  {"1+2*1^(", "0", ")"},
                                                  {"free or free and (", "free", ")", ValueType::Condition}}) {
    const bool two = open.ends_with("^("); // a power and a parenthesis
    const int most = two ? deepest_expression / 2 : deepest_expression;
    EXPECT_EQ(refusal(repeated(open, most) + middle + repeated(close, most), type), "") << open;
    for (const int depth : {most + 1, 2 * most, 200}) {
      const std::string why = refusal(repeated(open, depth) + middle + repeated(close, depth), type);
      EXPECT_NE(why.find(": more than 50 parentheses"), std::string::npos) << open << ": " << why;
    }
  }
  EXPECT_EQ(refusal(repeated("(", 3999)), "column 51: more than 50 parentheses within each other");
  EXPECT_TRUE(refusal(repeated("(", 10000) + "1" + repeated(")", 10000)).starts_with("column 4001: "));
}

TEST(HostileExpression, has_room_for_all_values_that_wait) {
  // Each level keeps values waiting: of a sum, a product, a power and two arguments.
  const auto nested = [](int levels) {
    return repeated("1+2*3^clamp(0,1+2*3^1,", levels) + "1" + repeated(")", levels);
  };
  EXPECT_EQ(refusal(nested(24)), "") << nested(24);
  const auto wide = [](int levels) { return repeated("clamp(0,0,0+0*", levels) + "1" + repeated(")", levels); };
  EXPECT_EQ(refusal(wide(50)), "");
  std::vector<ExpressionFunction> many = {
      {"all", std::vector<ValueType>(20, ValueType::Scalar), ValueType::Scalar, ""}};
  const auto deep = [&](int levels) {
    return repeated("all(" + repeated("1,", 19), levels) + "1" + repeated(")", levels);
  };
  EXPECT_NO_THROW(Expression(deep(12), many, ValueType::Scalar));
  try {
    Expression(deep(14), many, ValueType::Scalar);
    FAIL();
  } catch (const ExpressionError& error) {
    EXPECT_EQ(error.flaw, "more than 256 values wait for an operator here");
  }
}

class Fuzz {
public:
  explicit Fuzz(std::uint64_t seed) : random_(seed) {}

  std::string tokens() {
    static const std::vector<std::string> all = {
        "1",      "0",      "2.5",  "1e308",    "1e-300", "+",     "-",    "*",    "/",     "^",      "<",
        "<=",     ">",      ">=",   "==",       "!=",     "and",   "or",   "not",  "(",     ")",      ",",
        "time",   "centre", "free", "size",     "area",   "lerp",  "plus", "a",    "face",  "sin(",   "sqrt(",
        "log(",   "point(", "dot(", "norm",     "x(",     "noise", "pi",   "exp(", "pow(",  "clamp(", "cross",
        "broken", "mixed(", "@",    "\xc3\xa9", "=",      "1e",    "..",   "aera", "step(", "either("};
    std::string out;
    for (std::size_t n = below(12) + 1; n > 0; --n) out += all[below(all.size())] + (below(2) ? " " : "");
    return out;
  }

  // A scalar, mostly well formed; here and there random tokens or a vector.
  std::string sentence(int depth = 0) {
    static const std::vector<std::string> leaves = {
        "1",     "0",       "2",           "0.5",    "time", "(time - 0.5)",
        "1e300", "area(b)", "size(a, cc)", "broken", "pi",   "-time"};
    static const std::vector<std::string> vectors = {"centre", "copy(a)", "point(1, 2, 3)", "lerp(a, b, 0.5)"};
    static const std::vector<std::string> marks = {"+", "-", "*", "/", "^"};
    static const std::vector<std::string> calls = {"sin", "sqrt", "log", "exp", "floor", "tan", "-", "abs"};
    if (below(80) == 0) return below(2) ? tokens() : vectors[below(vectors.size())];
    if (depth > 4 || below(3) == 0) return leaves[below(leaves.size())];
    switch (below(6)) {
    case 0:
      return calls[below(calls.size())] + "(" + sentence(depth + 1) + ")";
    case 1:
      return "(" + sentence(depth + 1) + ")";
    case 2:
      return "noise(" + vectors[below(vectors.size())] + " * " + sentence(depth + 1) + ")";
    case 3:
      return "either(" + sentence(depth + 1) + " < " + sentence(depth + 1) + " or free, 1, " +
             sentence(depth + 1) + ")";
    default:
      return sentence(depth + 1) + " " + marks[below(marks.size())] + " " + sentence(depth + 1);
    }
  }

private:
  std::size_t below(std::size_t end) { return random_() % end; }
  std::mt19937_64 random_;
};

// How an expression of the text goes: refused at its making, refused at its evaluation, or with a value.
enum class End { Refused, NotFinite, Value };

End end_of(const std::string& text, ValueType wanted) {
  const auto has_place = [&](const ExpressionError& error) {
    EXPECT_GE(error.column, 1) << text;
    EXPECT_LE(error.column, std::min(text.size(), longest_expression) + 1) << text;
    EXPECT_FALSE(error.flaw.empty()) << text;
  };
  try {
    const Expression one(text, test_vocabulary(), wanted);
    const Expression again(one.print(), test_vocabulary(), wanted);
    EXPECT_EQ(again.print(), one.print()) << text;
    EXPECT_EQ(again.calls().size(), one.calls().size()) << text;
    try {
      const Value value = one.evaluate(TestSupply());
      for (const double number : value.number) EXPECT_TRUE(std::isfinite(number)) << text;
      EXPECT_TRUE(same(again.evaluate(TestSupply()), value)) << text << " printed as " << one.print();
      return End::Value;
    } catch (const ExpressionError& error) {
      has_place(error);
      EXPECT_THROW(again.evaluate(TestSupply()), ExpressionError) << text;
      return End::NotFinite;
    }
  } catch (const ExpressionError& error) {
    has_place(error);
    return End::Refused;
  }
}

TEST(HostileExpression, of_random_tokens_is_refused_with_its_place_or_has_a_finite_value) {
  Fuzz fuzz(1);
  std::array<int, 3> ends{};
  for (int n = 0; n < 100000; ++n)
    for (const std::string& text : {fuzz.tokens(), fuzz.sentence()}) {
      const auto wanted = static_cast<ValueType>(n % 20 < 2 ? 1 + n % 2 : 0); // mostly a scalar
      ++ends[static_cast<std::size_t>(end_of(text, wanted))];
      if (HasFailure()) FAIL() << text;
    }
  for (const int count : ends) EXPECT_GT(count, 10000); // each end is seen often
}

TEST(HostileExpression, of_random_bytes_is_refused_or_has_a_finite_value) {
  std::mt19937_64 random(2);
  for (int n = 0; n < 50000; ++n) {
    std::string text(random() % 20, ' ');
    const bool printable = n % 2 == 0;
    for (char& c : text) c = static_cast<char>(printable ? 32 + random() % 95 : random() % 256);
    end_of(text, ValueType::Scalar);
    if (HasFailure()) FAIL() << text;
  }
}

} // namespace
} // namespace rend::hostile_expression_test
