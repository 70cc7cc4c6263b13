#include "sim/expression/tokens.h"

#include "sim/base/printable.h"
#include "sim/base/wording.h"
#include "sim/expression/expression.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <system_error>

namespace rend {
namespace {

using Kind = ExpressionToken::Kind;

// Not those of the C library, which depend on the locale.
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool begins_word(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool in_word(char c) {
  return begins_word(c) || is_digit(c);
}
bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

// What other languages write, and what it is here.
struct Foreign {
  std::string_view text, here;
};
constexpr std::array<Foreign, 11> foreign = {{{"**", "^"},
                                              {"&&", "and"},
                                              {"||", "or"},
                                              {"!", "not"},
                                              {"=", "=="},
                                              {"−", "-"},
                                              {"·", "*"},
                                              {"×", "*"},
                                              {"≤", "<="},
                                              {"≥", ">="},
                                              {"≠", "!="}}};

std::string_view mark_at(std::string_view text) {
  for (const std::string_view two : {"<=", ">=", "==", "!="})
    if (text.starts_with(two)) return two;
  for (const Foreign& other : foreign)
    if (text.starts_with(other.text)) return {};
  return std::string_view("+-*/^(),<>").find(text[0]) == std::string_view::npos ? std::string_view{}
                                                                                : text.substr(0, 1);
}

[[noreturn]] void refuse_character(std::string_view text, std::size_t column) {
  for (const Foreign& other : foreign)
    if (text.starts_with(other.text))
      throw ExpressionError(column, fmt::format("'{}' is not known here", other.text),
                            fmt::format("write '{}'", other.here));
  throw ExpressionError(column, fmt::format("'{}' is not known here", take_printable(text)));
}

// The number that `text` begins with, and its length.
ExpressionToken number_at(std::string_view text, std::size_t column) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::size_t length = end - text.data();
  if (length < text.size() && (in_word(text[length]) || text[length] == '.')) {
    while (length < text.size() && (in_word(text[length]) || text[length] == '.')) ++length;
    throw ExpressionError(column, in_quotes(text.substr(0, length)) + " is not a number",
                          "numbers are as 2, 0.5 or 1e-4; a product has its '*'");
  }
  if (error != std::errc() || !std::isfinite(number))
    throw ExpressionError(column, in_quotes(text.substr(0, length)) +
                                      " is too large or too small for a number of 64 bits");
  return {Kind::Number, text.substr(0, length), column, number};
}

ExpressionToken token_at(std::string_view text, std::size_t column) {
  if (is_digit(text[0]) || (text[0] == '.' && text.size() > 1 && is_digit(text[1])))
    return number_at(text, column);
  if (begins_word(text[0])) {
    std::size_t length = 1;
    while (length < text.size() && in_word(text[length])) ++length;
    return {Kind::Word, text.substr(0, length), column};
  }
  const std::string_view mark = mark_at(text);
  if (mark.empty()) refuse_character(text, column);
  return {Kind::Mark, text.substr(0, mark.size()), column};
}

} // namespace

std::vector<ExpressionToken> tokens_of_expression(std::string_view text) {
  if (text.size() > longest_expression)
    throw ExpressionError(
        longest_expression + 1,
        fmt::format("the expression has {} characters; at most {} are read", text.size(), longest_expression));
  std::vector<ExpressionToken> out;
  int depth = 0;
  for (std::size_t at = 0; at < text.size();) {
    if (is_blank(text[at])) {
      ++at;
      continue;
    }
    out.push_back(token_at(text.substr(at), at + 1));
    if (out.back().text == "(" && ++depth > deepest_expression)
      throw ExpressionError(at + 1,
                            fmt::format("more than {} parentheses within each other", deepest_expression));
    if (out.back().text == ")") --depth;
    at += out.back().text.size();
  }
  out.push_back({Kind::End, {}, text.size() + 1});
  return out;
}

} // namespace rend
