#include "sim/base/parameters.h"

#include "sim/base/check.h"

#include <fmt/format.h>
#include <utility>

namespace rend {

AttributeType& AttributeType::is_required() {
  required = true;
  return *this;
}

AttributeType& AttributeType::otherwise(std::string value) {
  fallback = std::move(value);
  return *this;
}

AttributeType& AttributeType::at_least(double bound) {
  low = bound;
  open_low = false;
  return *this;
}

AttributeType& AttributeType::above(double bound) {
  low = bound;
  open_low = true;
  return *this;
}

AttributeType& AttributeType::at_most(double bound) {
  high = bound;
  return *this;
}

namespace {

AttributeType attribute_of(AttributeKind kind, std::string name, std::string what) {
  AttributeType type;
  type.kind = kind;
  type.name = std::move(name);
  type.what = std::move(what);
  return type;
}

} // namespace

AttributeType number(std::string name, std::string unit, std::string what) {
  AttributeType type = attribute_of(AttributeKind::Number, std::move(name), std::move(what));
  type.unit = std::move(unit);
  return type;
}

AttributeType numbers(std::string name, int count, std::string unit, std::string what) {
  AttributeType type = attribute_of(AttributeKind::Numbers, std::move(name), std::move(what));
  type.count = count;
  type.unit = std::move(unit);
  return type;
}

AttributeType integer(std::string name, std::string what) {
  return attribute_of(AttributeKind::Integer, std::move(name), std::move(what));
}

AttributeType integers(std::string name, int count, std::string what) {
  AttributeType type = attribute_of(AttributeKind::Integers, std::move(name), std::move(what));
  type.count = count;
  return type;
}

AttributeType word(std::string name, std::vector<std::string> words, std::string what) {
  AttributeType type = attribute_of(AttributeKind::Word, std::move(name), std::move(what));
  type.words = std::move(words);
  return type;
}

AttributeType words_of(std::string name, std::vector<std::string> words, std::string what) {
  AttributeType type = attribute_of(AttributeKind::Words, std::move(name), std::move(what));
  type.words = std::move(words);
  return type;
}

AttributeType flag(std::string name, std::string what) {
  return attribute_of(AttributeKind::Flag, std::move(name), std::move(what));
}

AttributeType text(std::string name, std::string what) {
  return attribute_of(AttributeKind::Text, std::move(name), std::move(what));
}

AttributeType number_or(std::string name, std::vector<std::string> words, std::string unit, std::string what) {
  AttributeType type = attribute_of(AttributeKind::NumberOrWord, std::move(name), std::move(what));
  type.words = std::move(words);
  type.unit = std::move(unit);
  return type;
}

AttributeType number_or_expression(std::string name, std::string unit, std::string what) {
  AttributeType type = attribute_of(AttributeKind::NumberOrExpression, std::move(name), std::move(what));
  type.unit = std::move(unit);
  return type;
}

const AttributeType* ElementType::find(std::string_view attribute) const {
  for (const AttributeType& type : attributes) {
    if (type.name == attribute) return &type;
  }
  return nullptr;
}

namespace {

// " of at least 0", " above 0 and at most 1", " from 0 to 1" or nothing.
std::string bounds_of(const AttributeType& type) {
  const AttributeType free;
  const bool has_low = type.low > free.low, has_high = type.high < free.high;
  const std::string low = fmt::format("{} {}", type.open_low ? "above" : "of at least", type.low);
  if (has_low && has_high && !type.open_low) return fmt::format(" from {} to {}", type.low, type.high);
  if (has_low && has_high) return fmt::format(" {} and at most {}", low, type.high);
  if (has_low) return " " + low;
  return has_high ? fmt::format(" of at most {}", type.high) : std::string();
}

std::string expected_list(const AttributeType& type, std::string_view one, std::string_view many) {
  const std::string bounds = bounds_of(type);
  if (type.count == 1) return fmt::format("1 {}{}", one, bounds);
  const std::string list =
      type.count > 0 ? fmt::format("{} {}", type.count, many) : fmt::format("one or more {}", many);
  return bounds.empty() ? list : list + ", each" + bounds;
}

} // namespace

std::string expected(const AttributeType& type) {
  const std::string unit = type.unit.empty() ? "" : " [" + type.unit + "]";
  switch (type.kind) {
  case AttributeKind::Number:
    return "a number" + bounds_of(type) + unit;
  case AttributeKind::Numbers:
    return expected_list(type, "number", "numbers") + unit;
  case AttributeKind::Integer:
    return "a whole number" + bounds_of(type);
  case AttributeKind::Integers:
    return expected_list(type, "whole number", "whole numbers");
  case AttributeKind::Word:
    return (type.words.size() > 1 ? "one of " : "") + listed(type.words);
  case AttributeKind::Words:
    if (type.words.empty()) return "names, separated by spaces";
    return (type.names ? "names, or any of " : "any of ") + listed(type.words) + ", separated by spaces";
  case AttributeKind::Flag:
    return "yes or no";
  case AttributeKind::Text:
    return "text";
  case AttributeKind::NumberOrWord:
    return listed(type.words) + ", or a number" + bounds_of(type) + unit;
  case AttributeKind::NumberOrExpression:
    return "a number" + bounds_of(type) + unit + ", or an expression of such numbers";
  }
  CHECK(!"a kind of attribute");
  return {};
}

} // namespace rend
