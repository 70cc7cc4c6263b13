#include "sim/expression/parser.h"

#include "sim/base/wording.h"
#include "sim/expression/code_builder.h"
#include "sim/expression/functions.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace rend {
namespace {

using Token = ExpressionToken;

bool is_keyword(std::string_view word) {
  return word == "and" || word == "or" || word == "not" || word == "if";
}

// Recursive descent by precedence (Pratt 1973). Each method reads what it is named after from the next token
// on, emits code that pushes its value, and returns its type.
class Parser {
public:
  Parser(std::string_view text, const std::vector<ExpressionFunction>& vocabulary)
      : tokens_(tokens_of_expression(text)), vocabulary_(vocabulary) {}

  ParsedExpression parse() {
    if (next().kind == Token::Kind::End) throw ExpressionError(1, "the expression is empty");
    const ValueType type = expression(Precedence::Or);
    if (next().kind != Token::Kind::End) refuse_rest();
    return code_.take(type);
  }

private:
  // What binds at least as tightly as `loosest`.
  ValueType expression(Precedence loosest) {
    ValueType left = operand();
    for (;;) {
      const Token& symbol = next();
      const Precedence precedence = symbol.kind == Token::Kind::Mark || is_keyword(symbol.text)
                                        ? binary_precedence(symbol.text)
                                        : Precedence{};
      if (precedence < loosest || precedence == Precedence{}) return left;
      ++at_;
      left = precedence <= Precedence::And ? decision(symbol, precedence, left)
                                           : operation(symbol, precedence, left);
    }
  }

  ValueType operation(const Token& symbol, Precedence precedence, ValueType left) {
    ValueType right;
    if (precedence == Precedence::Power) {
      const Deeper deeper(*this, symbol);
      right = expression(Precedence::Power); // to the right: 2^3^2 is 2^(3^2)
    } else {
      right = expression(tighter(precedence));
    }
    return code_.emit_operator(symbol, {left, right});
  }

  ValueType decision(const Token& symbol, Precedence precedence, ValueType left) {
    const std::size_t skip = code_.emit_skip(symbol);
    const ValueType right = expression(tighter(precedence));
    code_.emit_join(symbol, skip, {left, right});
    return ValueType::Condition;
  }

  ValueType operand() {
    const Token& token = next();
    if (token.kind == Token::Kind::Number) {
      ++at_;
      code_.emit({.column = column_of(token), .number = token.number});
      return ValueType::Scalar;
    }
    if (token.text == "(") return in_parentheses();
    if (token.text == "-" || token.text == "not") {
      ++at_;
      const Deeper deeper(*this, token);
      const ValueType type = expression(token.text == "-" ? Precedence::Power : Precedence::Comparison);
      return code_.emit_operator(token, {type});
    }
    if (token.text == "if") return choice();
    if (token.kind == Token::Kind::Word && !is_keyword(token.text)) return word();
    if (token.kind == Token::Kind::End)
      throw ExpressionError(token.column, "the expression ends where a value is expected");
    throw ExpressionError(token.column, fmt::format("a value is expected before '{}'", token.text));
  }

  ValueType in_parentheses() {
    const Token& open = take();
    const Deeper deeper(*this, open);
    const ValueType type = expression(Precedence::Or);
    close(open);
    return type;
  }

  // condition Branch first Jump second Choice
  ValueType choice() {
    const Token& name = take();
    const Token& open = next();
    constexpr const char* form = "if(condition, value, value)";
    if (open.text != "(") throw ExpressionError(name.column, "'if' is a function", form);
    const Deeper deeper(*this, take());
    if (const ValueType type = expression(Precedence::Or); type != ValueType::Condition)
      throw ExpressionError(open.column + 1,
                            fmt::format("'if' takes a condition first, here {}", a_value(type)),
                            "a condition is a comparison, such as x > 0");
    const std::size_t branch = code_.emit_jump(Instruction::Kind::Branch, name);
    const ValueType first = value_of_choice(form);
    const std::size_t leave = code_.emit_jump(Instruction::Kind::Jump, name);
    code_.lead(branch, leave);
    const ValueType second = value_of_choice(form);
    if (first != second)
      throw ExpressionError(
          name.column, fmt::format("the two values of 'if' are {} and {}", a_value(first), a_value(second)),
          "they are of one type");
    code_.lead(leave, code_.size() - 1);
    close(open);
    code_.emit({.kind = Instruction::Kind::Choice, .result = first, .count = 1, .column = column_of(name)});
    return first;
  }

  ValueType value_of_choice(const char* form) {
    if (next().text != ",") throw ExpressionError(next().column, "'if' takes three arguments", form);
    ++at_;
    return expression(Precedence::Or);
  }

  // A variable or a call.
  ValueType word() {
    const Token& name = take();
    const bool called = next().text == "(";
    for (const BuiltIn& built_in : built_ins()) {
      if (built_in.declared.name != name.text) continue;
      const Arguments given = arguments(name, built_in.declared, called);
      code_.emit({.kind = Instruction::Kind::Function,
                  .result = built_in.declared.result,
                  .count = static_cast<std::uint8_t>(given.types.size()),
                  .index = static_cast<std::uint32_t>(&built_in - built_ins().data()),
                  .column = column_of(name),
                  .apply = built_in.apply});
      return built_in.declared.result;
    }
    for (const ExpressionFunction& function : vocabulary_) {
      if (function.name != name.text) continue;
      if (function.is_name && called) return called_name(name, function);
      Arguments given = arguments(name, function, called);
      code_.emit_call({static_cast<std::size_t>(&function - vocabulary_.data()), function.name, name.column,
                       function.result, std::move(given.types), std::move(given.names),
                       std::move(given.columns), !called});
      return function.result;
    }
    refuse_word(name, called);
  }

  // A call that stands for a name, as a value.
  ValueType called_name(const Token& word, const ExpressionFunction& function) {
    --at_; // back to the word
    std::size_t column = 0;
    std::string name = name_argument(column, [&](const Token& token) {
      throw ExpressionError(token.column, fmt::format("'{}' takes a name and a whole number", word.text),
                            signature(function));
    });
    code_.emit_call({static_cast<std::size_t>(&function - vocabulary_.data()),
                     name,
                     word.column,
                     function.result,
                     {ValueType::Name},
                     {name},
                     {column},
                     true});
    return function.result;
  }

  // A word, or a call that stands for a name; `refuse` throws. The column is that of the innermost word.
  template <class Refuse> std::string name_argument(std::size_t& column, const Refuse& refuse) {
    const Token& first = next();
    if (first.kind != Token::Kind::Word || is_keyword(first.text)) refuse(first);
    const Token& behind = tokens_[at_ + 1];
    if (ends_argument(behind)) {
      column = first.column;
      return std::string(take().text);
    }
    if (behind.text != "(" || !stands_for_name(first.text)) refuse(first);
    const Deeper deeper(*this, first);
    at_ += 2;
    const std::string inner = name_argument(column, refuse);
    if (next().text != ",") refuse(next());
    ++at_;
    const Token& number = take_number(refuse);
    close(behind);
    return fmt::format("{}({}, {})", first.text, inner, number.number);
  }

  template <class Refuse> const Token& take_number(const Refuse& refuse) {
    if (next().kind != Token::Kind::Number || next().number != std::floor(next().number)) refuse(next());
    return take();
  }

  bool stands_for_name(std::string_view word) const {
    return std::ranges::any_of(vocabulary_,
                               [&](const ExpressionFunction& one) { return one.is_name && one.name == word; });
  }

  struct Arguments {
    std::vector<ValueType> types;
    std::vector<std::string> names;
    std::vector<std::size_t> columns;
  };

  Arguments arguments(const Token& name, const ExpressionFunction& function, bool called) {
    const std::size_t most = function.arguments.size(), least = most - function.optional;
    if (called && most == 0)
      throw ExpressionError(name.column, fmt::format("'{}' takes no arguments", name.text),
                            fmt::format("write {}", name.text));
    if (!called && most > 0)
      throw ExpressionError(name.column, fmt::format("'{}' is a function", name.text),
                            "write " + signature(function));
    Arguments out;
    if (!called) return out;
    const Token& open = take();
    const Deeper deeper(*this, open);
    if (next().text != ")") {
      argument(name, function, out);
      while (next().text == ",") {
        ++at_;
        argument(name, function, out);
      }
    }
    if (out.types.size() < least && (next().text == ")"))
      throw ExpressionError(next().column,
                            fmt::format("'{}' takes {}{} argument{}, here {} {}", name.text,
                                        least < most ? "at least " : "", least, least == 1 ? "" : "s",
                                        out.types.size() == 1 ? "is" : "are", out.types.size()),
                            signature(function));
    close(open);
    return out;
  }

  void argument(const Token& name, const ExpressionFunction& function, Arguments& out) {
    const std::size_t number = out.types.size(), most = function.arguments.size();
    const Token& first = next();
    if (number == most)
      throw ExpressionError(first.column,
                            fmt::format("'{}' takes {}{} argument{}, here are more", name.text,
                                        function.optional > 0 ? "at most " : "", most, most == 1 ? "" : "s"),
                            signature(function));
    const ValueType wanted = function.arguments[number];
    out.types.push_back(wanted);
    if (wanted == ValueType::Name) {
      out.columns.push_back(0);
      out.names.push_back(name_argument(out.columns.back(), [&](const Token& token) {
        throw ExpressionError(
            token.column, fmt::format("argument {} of '{}' is a name, a single word", number + 1, name.text),
            signature(function));
      }));
      return;
    }
    const ValueType given = expression(Precedence::Or);
    if (given != wanted)
      throw ExpressionError(first.column,
                            fmt::format("argument {} of '{}' is {}, here {}", number + 1, name.text,
                                        a_value(wanted), a_value(given)),
                            signature(function));
  }

  static bool ends_argument(const Token& token) {
    return token.text == "," || token.text == ")" || token.kind == Token::Kind::End;
  }

  // Reads the ')' of `open`.
  void close(const Token& open) {
    const Token& token = next();
    if (token.text == ")") {
      ++at_;
      return;
    }
    if (token.kind == Token::Kind::End)
      throw ExpressionError(token.column,
                            fmt::format("')' is missing, which closes '(' of column {}", open.column));
    refuse_rest();
  }

  // Something stands behind a complete expression.
  [[noreturn]] void refuse_rest() const {
    const Token& token = tokens_[at_];
    if (token.text == ")") throw ExpressionError(token.column, "this ')' closes nothing");
    if (token.text == ",")
      throw ExpressionError(token.column, "',' stands outside the arguments of a function",
                            "the decimal point is '.'; a vector is point(x, y, z)");
    throw ExpressionError(token.column,
                          fmt::format("an operator is expected before {}", in_quotes(token.text)),
                          "a vector is written as point(x, y, z)");
  }

  [[noreturn]] void refuse_word(const Token& name, bool called) const {
    std::vector<std::string> names;
    const auto add = [&](const ExpressionFunction& one) {
      if (one.arguments.empty() != called) names.push_back(one.name);
    };
    for (const ExpressionFunction& one : vocabulary_) add(one);
    for (const BuiltIn& one : built_ins()) add(one.declared);
    const std::string hint = suggestion(name.text, names, called ? "functions" : "values");
    throw ExpressionError(name.column,
                          fmt::format("there is no {} {}", called ? "function" : "value", in_quotes(name.text)),
                          hint);
  }

  // Lives as long as what is nested once more.
  struct Deeper {
    Deeper(Parser& parser_, const Token& token) : parser(parser_) {
      if (++parser.depth_ > deepest_expression)
        throw ExpressionError(
            token.column,
            fmt::format("more than {} parentheses, signs and powers within each other", deepest_expression));
    }
    ~Deeper() { --parser.depth_; }
    Deeper(const Deeper&) = delete;
    Deeper& operator=(const Deeper&) = delete;
    Parser& parser;
  };

  static Precedence tighter(Precedence precedence) {
    return static_cast<Precedence>(static_cast<int>(precedence) + 1);
  }
  const Token& next() const { return tokens_[at_]; }
  const Token& take() { return tokens_[at_++]; } // never of the last one, End

  std::vector<Token> tokens_;
  const std::vector<ExpressionFunction>& vocabulary_;
  std::size_t at_ = 0;
  int depth_ = 0;
  CodeBuilder code_;
};

} // namespace

std::string_view type_word(ValueType type) {
  switch (type) {
  case ValueType::Scalar:
    return "scalar";
  case ValueType::Vector:
    return "vector";
  case ValueType::Condition:
    return "condition";
  default:
    return "name";
  }
}

std::string a_value(ValueType type) {
  return fmt::format("a {}", type_word(type));
}

ParsedExpression parse_expression(std::string_view text, const std::vector<ExpressionFunction>& vocabulary) {
  return Parser(text, vocabulary).parse();
}

} // namespace rend
