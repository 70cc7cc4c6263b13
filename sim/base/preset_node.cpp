// PresetNode of sim/base/parameters.h: values parsed from their text, and the accessors.
#include "sim/base/check.h"
#include "sim/base/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <system_error>
#include <utility>

namespace rend {

namespace {

constexpr std::string_view blanks = " \t\r\n";

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string_view> tokens_of(std::string_view text) {
  std::vector<std::string_view> out;
  for (text = trimmed(text); !text.empty(); text = trimmed(text)) {
    const std::size_t end = std::min(text.find_first_of(blanks), text.size());
    out.push_back(text.substr(0, end));
    text.remove_prefix(end);
  }
  return out;
}

// from_chars, since it is independent of the locale. It does not accept '+', so the sign is skipped ("+-1"
// stays refused).
template <class T> std::errc parse(std::string_view token, T& out) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-') token.remove_prefix(1);
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), out);
  if (error != std::errc()) return end == token.data() + token.size() ? error : std::errc::invalid_argument;
  return end == token.data() + token.size() ? std::errc() : std::errc::invalid_argument;
}

} // namespace

struct PresetNode::Reading {
  const AttributeType& type;
  const std::string& element;
  const std::string& text;
  const Place& place;

  [[noreturn]] void fail(const std::string& flaw, const std::string& hint = {}) const {
    const std::string shown = fmt::format("{} of <{}> is {}", type.name, element, in_quotes(text));
    throw UserError(Exit::BadInput, place, fmt::format("{}, {}; expected {}", shown, flaw, expected(type)),
                    hint);
  }

  // "which" where the value is that one token, else "where 'x'".
  std::string subject(std::string_view token) const {
    return token == trimmed(text) ? "which" : "where " + in_quotes(token);
  }

  void check_bounds(std::string_view token, double number) const {
    if (type.open_low ? number > type.low : number >= type.low) {
      if (number <= type.high) return;
      fail(fmt::format("{} is above {}", subject(token), type.high));
    }
    fail(fmt::format("{} is {} {}", subject(token), type.open_low ? "not above" : "below", type.low));
  }

  double number(std::string_view token) const {
    double out = 0;
    const std::errc error = parse(token, out);
    if (error == std::errc::result_out_of_range)
      fail(subject(token) + " is too large or too small for a number of 64 bits (about 2e-308 to 2e308)");
    if (error != std::errc()) {
      const bool comma = token.find(',') != std::string_view::npos;
      fail(subject(token) + " is not a number",
           comma ? "the decimal point is '.', and numbers are separated by spaces" : "");
    }
    if (!std::isfinite(out)) fail(subject(token) + " is not a finite number");
    check_bounds(token, out);
    return out;
  }

  double integer(std::string_view token) const {
    int out = 0;
    const std::errc error = parse(token, out);
    if (error == std::errc::result_out_of_range)
      fail(subject(token) + " is beyond the range of a whole number of 32 bits");
    if (error != std::errc()) fail(subject(token) + " is not a whole number");
    check_bounds(token, out);
    return out;
  }

  std::string word(std::string_view token) const {
    if (std::find(type.words.begin(), type.words.end(), token) != type.words.end()) return std::string(token);
    fail(subject(token) + " is not known here", suggestion(token, type.words));
  }

  std::vector<double> list(bool whole) const {
    const auto tokens = tokens_of(text);
    std::vector<double> out;
    for (const std::string_view token : tokens) out.push_back(whole ? integer(token) : number(token));
    if (type.count > 0 && out.size() != static_cast<std::size_t>(type.count))
      fail(fmt::format("which has {} number{}", out.size(), out.size() == 1 ? "" : "s"));
    return out;
  }

  bool begins_as_number(std::string_view token) const {
    return token.find_first_of("0123456789+-.") == 0 &&
           std::find(type.words.begin(), type.words.end(), token) == type.words.end();
  }

  // Also of one that is too large, or not finite.
  static bool is_number(std::string_view token) {
    double out = 0;
    return parse(token, out) != std::errc::invalid_argument;
  }

  Value read() const {
    Value value;
    value.text = type.kind == AttributeKind::Text ? std::string_view(text) : trimmed(text);
    value.place = place;
    if (type.kind == AttributeKind::Text) return value;
    if (value.text.empty()) fail("which is empty");
    switch (type.kind) {
    case AttributeKind::Number:
      value.numbers = {number(value.text)};
      break;
    case AttributeKind::Integer:
      value.numbers = {integer(value.text)};
      break;
    case AttributeKind::Numbers:
      value.numbers = list(false);
      break;
    case AttributeKind::Integers:
      value.numbers = list(true);
      break;
    case AttributeKind::Word:
      word(value.text);
      break;
    case AttributeKind::Words:
      for (const std::string_view token : tokens_of(text))
        value.words.push_back(type.names ? std::string(token) : word(token));
      break;
    case AttributeKind::Flag:
      if (value.text != "yes" && value.text != "no") fail("which is neither yes nor no");
      break;
    case AttributeKind::NumberOrWord:
      value.word = !begins_as_number(value.text);
      if (value.word)
        word(value.text);
      else
        value.numbers = {number(value.text)};
      break;
    case AttributeKind::NumberOrExpression:
      value.word = !is_number(value.text);
      if (!value.word) value.numbers = {number(value.text)};
      break;
    case AttributeKind::Text:
      break;
    }
    return value;
  }
};

PresetNode::PresetNode(const ElementType& type, Place place) : type_(&type), place_(std::move(place)) {}

const Place& PresetNode::place(std::string_view attribute) const {
  CHECK_NOTE(may_have(attribute), fmt::format("{} of <{}>", attribute, name()));
  const auto found = values_.find(attribute);
  return found != values_.end() && found->second.given ? found->second.place : place_;
}

bool PresetNode::may_have(std::string_view attribute) const {
  return type_->find(attribute) || !type_->further.empty();
}

bool PresetNode::has(std::string_view attribute) const {
  CHECK_NOTE(may_have(attribute), fmt::format("{} of <{}>", attribute, name()));
  return values_.find(attribute) != values_.end();
}

const AttributeValue* PresetNode::find(std::string_view attribute) const {
  return has(attribute) ? &values_.find(attribute)->second : nullptr;
}

bool PresetNode::given(std::string_view attribute) const {
  return has(attribute) && values_.find(attribute)->second.given;
}

const PresetNode::Value& PresetNode::value(std::string_view attribute,
                                           std::initializer_list<AttributeKind> kinds) const {
  const AttributeType* type = type_->find(attribute);
  const auto found = values_.find(attribute);
  const std::string note = fmt::format("{} of <{}>", attribute, name());
  CHECK_NOTE(type && std::find(kinds.begin(), kinds.end(), type->kind) != kinds.end(), note);
  CHECK_NOTE(found != values_.end(), note);
  return found->second;
}

double PresetNode::number(std::string_view attribute) const {
  const Value& out = value(attribute, {AttributeKind::Number, AttributeKind::NumberOrWord});
  CHECK_NOTE(!out.word, std::string(attribute));
  return out.numbers.front();
}

Eigen::Vector3d PresetNode::vector(std::string_view attribute) const {
  const std::vector<double>& x = numbers(attribute);
  CHECK_NOTE(x.size() == 3, std::string(attribute));
  return {x[0], x[1], x[2]};
}

const std::vector<double>& PresetNode::numbers(std::string_view attribute) const {
  return value(attribute, {AttributeKind::Numbers, AttributeKind::Integers}).numbers;
}

int PresetNode::integer(std::string_view attribute) const {
  return static_cast<int>(value(attribute, {AttributeKind::Integer}).numbers.front());
}

bool PresetNode::flag(std::string_view attribute) const {
  return value(attribute, {AttributeKind::Flag}).text == "yes";
}

const std::string& PresetNode::text(std::string_view attribute) const {
  const Value& out = value(attribute, {AttributeKind::Text, AttributeKind::Word, AttributeKind::NumberOrWord});
  CHECK_NOTE(out.numbers.empty(), std::string(attribute));
  return out.text;
}

const std::vector<std::string>& PresetNode::words(std::string_view attribute) const {
  return value(attribute, {AttributeKind::Words}).words;
}

bool PresetNode::is_word(std::string_view attribute) const {
  return value(attribute, {AttributeKind::NumberOrWord}).word;
}

std::vector<std::string> PresetNode::further() const {
  std::vector<std::string> names;
  for (const auto& [name, value] : values_)
    if (!type_->find(name)) names.push_back(name);
  return names;
}

const PresetNode* PresetNode::child(std::string_view name) const {
  for (const auto& child : children_) {
    if (child->name() == name) return child.get();
  }
  return nullptr;
}

std::vector<const PresetNode*> PresetNode::all(std::string_view name) const {
  std::vector<const PresetNode*> out;
  for (const auto& child : children_) {
    if (child->name() == name) out.push_back(child.get());
  }
  return out;
}

void PresetNode::fail(std::string_view attribute, const std::string& what, const std::string& hint) const {
  throw UserError(Exit::BadInput, place(attribute), what, hint);
}

void PresetNode::set(const AttributeType& attribute, const std::string& value, const Place& place, bool given) {
  const AttributeType* listed = type_->find(attribute.name);
  CHECK_NOTE(listed == &attribute || (!listed && !type_->further.empty()), attribute.name);
  Value read = Reading{attribute, type_->name, value, place}.read();
  read.given = given;
  values_.insert_or_assign(attribute.name, std::move(read));
}

PresetNode& PresetNode::add(std::unique_ptr<PresetNode> child) {
  const auto fits = [&](const ChildType& allowed) { return allowed.type == child->type_; };
  CHECK_NOTE(std::any_of(type_->children.begin(), type_->children.end(), fits), child->name());
  children_.push_back(std::move(child));
  return *children_.back();
}

void PresetNode::fill_defaults() {
  for (const AttributeType& attribute : type_->attributes) {
    if (!attribute.fallback || has(attribute.name)) continue;
    try {
      set(attribute, *attribute.fallback, place_, false);
    } catch (const UserError& error) { // the table is part of rend: a default that does not fit is a bug
      CHECK_NOTE(!"a default fits its type", error.what());
    }
  }
  for (const auto& child : children_) child->fill_defaults();
}

void PresetNode::check_complete() const {
  for (const AttributeType& attribute : type_->attributes) {
    if (!attribute.required || has(attribute.name)) continue;
    throw UserError(Exit::BadInput, place_, fmt::format("<{}> needs {}", name(), attribute.name),
                    fmt::format("{}: {}; expected {}", attribute.name,
                                attribute.what.substr(0, attribute.what.find('\n')), expected(attribute)));
  }
  for (const ChildType& allowed : type_->children) {
    const std::vector<const PresetNode*> present = all(allowed.type->name);
    const int count = static_cast<int>(present.size());
    if (count < allowed.at_least)
      throw UserError(Exit::BadInput, place_,
                      fmt::format("<{}> needs {} <{}> and has {}", name(),
                                  allowed.at_least == 1 ? "a" : fmt::format("at least {}", allowed.at_least),
                                  allowed.type->name, count == 0 ? "none" : fmt::format("{}", count)),
                      fmt::format("add <{}>: {}", allowed.type->name,
                                  allowed.type->what.substr(0, allowed.type->what.find('\n'))));
    if (allowed.at_most >= 0 && count > allowed.at_most)
      throw UserError(Exit::BadInput, present[allowed.at_most]->place_,
                      fmt::format("<{}> may hold only {} <{}>", name(), allowed.at_most, allowed.type->name),
                      fmt::format("the first is at {}", present[0]->place_.text()));
  }
  for (const auto& child : children_) child->check_complete();
}

} // namespace rend
