#include "sim/rules/rule_symmetry.h"

#include "sim/rules/rule_vocabulary.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace rend {
namespace {

bool commute(char a, char b) {
  return a - b >= 2 || b - a >= 2;
}

// Links that cancel each other are left out.
std::string reduced(const std::string& word) {
  std::string out;
  for (char c : word) {
    std::size_t at = out.size();
    while (at > 0 && commute(out[at - 1], c)) --at;
    if (at > 0 && out[at - 1] == c)
      out.erase(at - 1, 1);
    else
      out += c;
  }
  return out;
}

// Whether the letter can be brought to the end, or to the begin.
bool can_be_last(const std::string& word, std::size_t at) {
  return std::all_of(word.begin() + static_cast<std::ptrdiff_t>(at) + 1, word.end(),
                     [&](char c) { return commute(c, word[at]); });
}
bool can_be_first(const std::string& word, std::size_t at) {
  return std::all_of(word.begin(), word.begin() + static_cast<std::ptrdiff_t>(at),
                     [&](char c) { return commute(c, word[at]); });
}

// Of two values of one expression: the same but for rounding.
bool same(const Value& a, const Value& b) {
  for (std::size_t n = 0; n < 3; ++n) {
    const double size = std::max({1.0, std::abs(a.number[n]), std::abs(b.number[n])});
    if (!(std::abs(a.number[n] - b.number[n]) <= 1e-9 * size)) return false;
  }
  return true;
}

// The values of calls at one instance: at that of the expression (p < 0), or at the one where position p leads.
class MadeUp {
public:
  MadeUp(const Rule& rule, unsigned seed, int p) : rule_(rule), seed_(seed), p_(p) {}

  Value value(const Expression& expression) {
    return expression.evaluate([&](const ExpressionCall& call, std::size_t, std::span<const Value> arguments) {
      return of_call(call, arguments);
    });
  }

private:
  Value of_call(const ExpressionCall& call, std::span<const Value> arguments) {
    if (const Rule::Let* let = rule_.find_let(call)) {
      const auto known = lets_.find(let);
      return known != lets_.end() ? known->second : lets_[let] = value(let->value);
    }
    if (call.function == static_cast<std::size_t>(RuleFunction::Lerp)) {
      const double t = arguments[2].scalar();
      const auto mixed = [&](std::size_t n) {
        return (1 - t) * arguments[0].number[n] + t * arguments[1].number[n];
      };
      return vector_value(mixed(0), mixed(1), mixed(2));
    }
    return number(call, key(call, arguments), arguments);
  }

  // What its value hangs on.
  std::string key(const ExpressionCall& call, std::span<const Value> arguments) const {
    const std::string_view name = dart_of_call(call, rule_.left);
    if (name.empty()) return call.name;
    const bool free = call.function == static_cast<std::size_t>(RuleFunction::Free);
    const bool point =
        call.function >= rule_functions || call.function <= static_cast<std::size_t>(RuleFunction::Copy);
    const Orbit orbit = orbit_of_call(call, free ? static_cast<int>(arguments[0].scalar()) : -1);
    NamedDart dart = named_dart(name);
    std::string beyond;
    if (p_ >= 0) {
      const int link = rule_.left[rule_.left.find(dart.node)].label[static_cast<std::size_t>(p_)];
      if (link == RuleNode::dropped)
        beyond = "beyond ";
      else
        dart.links.insert(0, 1, static_cast<char>('0' + link));
    }
    return fmt::format("{}{} {} {} {}", beyond, dart.node, normal_word(dart.links, orbit),
                       point ? std::string("point") : call.name, call.names.size() > 1 ? call.names[1] : "");
  }

  Value number(const ExpressionCall& call, const std::string& key, std::span<const Value> arguments) const {
    std::uint64_t hash = 0x9e3779b97f4a7c15u * seed_;
    const auto add = [&](std::uint64_t bits) { hash = (hash ^ bits) * 0x100000001b3u; };
    for (char c : key) add(static_cast<unsigned char>(c));
    for (const Value& argument : arguments)
      for (double x : argument.number)
        add(static_cast<std::uint64_t>(std::llround(std::clamp(x, -1e9, 1e9) * 1e6)));
    const auto next = [&] {
      hash ^= hash >> 29;
      hash *= 0xbf58476d1ce4e5b9u;
      hash ^= hash >> 32;
      return 0.5 + static_cast<double>(hash >> 12) / static_cast<double>(1ull << 52);
    };
    const double x = next();
    if (call.result == ValueType::Condition) return condition_value(x < 1);
    if (call.result == ValueType::Scalar) return scalar_value(x);
    const double y = next();
    return vector_value(x, y, next());
  }

  const Rule& rule_;
  unsigned seed_;
  int p_;
  std::map<const Rule::Let*, Value> lets_;
};

} // namespace

std::string normal_word(const std::string& word, Orbit orbit) {
  std::string rest = reduced(word);
  for (std::size_t n = rest.size(); n-- > 0;)
    if (orbit.has(rest[n] - '0') && can_be_last(rest, n)) {
      rest.erase(n, 1);
      n = rest.size();
    }
  std::string out; // the smallest that can be next
  while (!rest.empty()) {
    std::size_t best = rest.size();
    for (std::size_t n = 0; n < rest.size(); ++n)
      if (can_be_first(rest, n) && (best == rest.size() || rest[n] < rest[best])) best = n;
    out += rest[best];
    rest.erase(best, 1);
  }
  return out;
}

bool is_symmetric(const Rule& rule, const Expression& expression, int p) {
  constexpr unsigned trials = 8; // several, so that both values of an `if` are met
  for (unsigned seed = 1; seed <= trials; ++seed) try {
      if (!same(MadeUp(rule, seed, -1).value(expression), MadeUp(rule, seed, p).value(expression)))
        return false;
    } catch (const ExpressionError&) { // at these numbers it has no value; at others it may
    }
  return true;
}

} // namespace rend
