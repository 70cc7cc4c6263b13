// The text of an expression as words, numbers and marks.
#pragma once

#include <cstddef>
#include <string_view>
#include <vector>

namespace rend {

struct ExpressionToken {
  enum class Kind { Number, Word, Mark, End } kind = Kind::End;
  std::string_view text;  // of the whole text's memory
  std::size_t column = 0; // from 1
  double number = 0;
};

// The last token is End. ExpressionError: longer than longest_expression (nothing is read then), parentheses
// deeper than deepest_expression, a character or a number that expressions do not have.
std::vector<ExpressionToken> tokens_of_expression(std::string_view text);

} // namespace rend
