// Settings: structs whose members are described once (name, unit, bounds, meaning), so that the table of
// parameters (reader, help, schema, manual) and a C++ program use the same names and defaults.
//
//   struct ViscositySettings { double value = 0; bool per_body = false; SettingsSource source; };
//
//   template <> const Fields<ViscositySettings>& fields_of() {
//     static const Fields<ViscositySettings> fields{
//         field(&ViscositySettings::value, number("value", "N.s/m", "the coefficient").is_required()), ...};
//     return fields;
//   }
//
// The default of an attribute is that of the member: where it is an empty optional, an empty text or an
// infinite number, or the attribute is required, there is none (of one that may be a word: its first).
// Enumerators stand for the attribute's words, in their order.
#pragma once

#include "sim/base/check.h"
#include "sim/base/parameters.h"
#include "sim/base/record.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace rend {

// Where settings come from in a user's file, for messages. Settings made by a program have no place.
struct SettingsSource {
  std::function<Place(std::string_view attribute)> place_of; // of the attribute's value; of the element for ""
  std::function<bool(std::string_view attribute)> is_given;  // written in the preset, not a default

  Place place(std::string_view attribute = {}) const { return place_of ? place_of(attribute) : Place{}; }
  bool given(std::string_view attribute) const { return is_given && is_given(attribute); }
  // Throws UserError (BadInput) at that place.
  [[noreturn]] void fail(std::string_view attribute, const std::string& what,
                         const std::string& hint = {}) const;
};

template <class S> struct Field {
  AttributeType type;
  std::function<void(S&, const AttributeValue&)> take;
  std::function<void(const S&, const SettingsSource&)> check =
      {}; // see check_settings(); empty: nothing to check
};
template <class S> using Fields = std::vector<Field<S>>;

// Specialised beside each settings struct.
template <class S> const Fields<S>& fields_of();

namespace fields {

// As it would be written in a preset: the shortest digits that parse to the same number.
std::string text_of(double value);

std::string text_of_list(std::span<const double> values);

// UserError: a number that is not finite or out of the attribute's bounds; a text that is none of its words
// (the hint names the nearest); one that is required and not there.
void check_numbers(const AttributeType& type, std::span<const double> values, const SettingsSource& source);
void check_text(const AttributeType& type, const std::string& value, const SettingsSource& source);
[[noreturn]] void refuse_missing(const AttributeType& type, const SettingsSource& source);

template <class T> struct IsOptional : std::false_type {};
template <class T> struct IsOptional<std::optional<T>> : std::true_type {};
template <class T> struct IsArray : std::false_type {};
template <class T, std::size_t N> struct IsArray<std::array<T, N>> : std::true_type {};

template <class M>
concept IsNumber = std::is_arithmetic_v<M> && !std::is_same_v<M, bool>;
template <class M>
concept IsText = std::is_same_v<M, std::string> || std::is_same_v<M, std::vector<std::string>>;

// The numbers of a member, one after another; none of words and of what is not there.
template <class M> void put_numbers(const M& member, std::vector<double>& out) {
  if constexpr (IsOptional<M>::value) {
    if (member) put_numbers(*member, out);
  } else if constexpr (IsNumber<M>) {
    out.push_back(static_cast<double>(member));
  } else if constexpr (std::is_same_v<M, Vec3>) {
    out.insert(out.end(), member.begin(), member.end());
  } else if constexpr (!std::is_same_v<M, bool> && !std::is_enum_v<M> && !IsText<M>) {
    for (const auto& each : member) put_numbers(each, out);
  }
}

// An infinite number, which stands for one that is not there.
template <class M> bool is_absent(const M& member) {
  if constexpr (std::is_floating_point_v<M>) return std::isinf(member);
  return false;
}

// The default given by a member's initial value; nullopt: none.
template <class M> std::optional<std::string> default_of(const AttributeType& type, const M& member) {
  if constexpr (IsOptional<M>::value) {
    if (member) return default_of(type, *member);
    return type.kind == AttributeKind::NumberOrWord ? std::optional(type.words.front()) : std::nullopt;
  } else if constexpr (std::is_same_v<M, bool>) {
    return member ? "yes" : "no";
  } else if constexpr (std::is_enum_v<M>) {
    return type.words.at(static_cast<std::size_t>(member));
  } else if constexpr (std::is_same_v<M, std::string>) {
    return member.empty() ? std::nullopt : std::optional(member);
  } else if constexpr (IsText<M>) {
    std::string out;
    for (const std::string& word : member) out += (out.empty() ? "" : " ") + word;
    return out.empty() ? std::nullopt : std::optional(out);
  } else {
    if (is_absent(member)) return default_of(type, std::optional<double>());
    std::vector<double> numbers;
    put_numbers(member, numbers);
    return text_of_list(numbers);
  }
}

template <class M> constexpr std::size_t count_of = 1; // of numbers
template <> inline constexpr std::size_t count_of<Vec3> = 3;
template <class T, std::size_t N> constexpr std::size_t count_of<std::array<T, N>> = N* count_of<T>;

template <class M> void take_numbers(const double*& next, M& member) {
  if constexpr (std::is_same_v<M, Vec3>)
    for (double& component : member) component = *next++;
  else if constexpr (IsArray<M>::value)
    for (auto& each : member) take_numbers(next, each);
  else
    member = static_cast<M>(*next++);
}

template <class M> void take(const AttributeType& type, const AttributeValue& value, M& member) {
  if constexpr (IsOptional<M>::value) {
    if (value.word)
      member.reset();
    else
      take(type, value, member.emplace());
  } else if constexpr (std::is_same_v<M, bool>) {
    member = value.text == "yes";
  } else if constexpr (std::is_enum_v<M>) {
    std::size_t word = 0;
    while (word < type.words.size() && type.words[word] != value.text) ++word;
    CHECK_NOTE(word < type.words.size(), type.name);
    member = static_cast<M>(word);
  } else if constexpr (std::is_same_v<M, std::string>) {
    member = value.text;
  } else if constexpr (std::is_same_v<M, std::vector<std::string>>) {
    member = value.words;
  } else if constexpr (IsNumber<M>) {
    member = value.word ? std::numeric_limits<M>::infinity() : static_cast<M>(value.numbers.at(0));
  } else if constexpr (std::is_same_v<M, Vec3> || IsArray<M>::value) {
    CHECK_NOTE(value.numbers.size() == count_of<M>, type.name);
    const double* next = value.numbers.data();
    take_numbers(next, member);
  } else {
    member.assign(value.numbers.begin(), value.numbers.end());
  }
}

} // namespace fields

template <class S, class M> Field<S> field(M S::*member, AttributeType type) {
  if (!type.required) type.fallback = fields::default_of(type, S{}.*member);
  return {type, [member, type](S& s, const AttributeValue& value) { fields::take(type, value, s.*member); },
          [member, type](const S& s, const SettingsSource& source) {
            if (fields::is_absent(s.*member) && fields::is_absent(S{}.*member)) return;
            std::vector<double> numbers;
            fields::put_numbers(s.*member, numbers);
            fields::check_numbers(type, numbers, source);
            if constexpr (std::is_same_v<M, std::string>) fields::check_text(type, s.*member, source);
            if constexpr (std::is_same_v<M, std::vector<std::string>>)
              for (const std::string& word : s.*member) fields::check_text(type, word, source);
          }};
}

// Numbers of one attribute, one for each member.
template <class S, class M, std::size_t N>
Field<S> field(const std::array<M S::*, N>& members, AttributeType type) {
  CHECK_NOTE(type.required, type.name);
  return {type,
          [members](S& s, const AttributeValue& value) {
            for (std::size_t n = 0; n < N; ++n) s.*members[n] = static_cast<M>(value.numbers.at(n));
          },
          [members, type](const S& s, const SettingsSource& source) {
            for (M S::*member : members)
              fields::check_numbers(type, std::array{static_cast<double>(s.*member)}, source);
          }};
}

// Words of one attribute, each of which sets a member; what is not named is unset.
template <class S>
Field<S> field(const std::vector<std::pair<std::string, bool S::*>>& members, const std::string& name,
               const std::string& what) {
  std::vector<std::string> words, set;
  for (const auto& [word, member] : members) {
    words.push_back(word);
    if (S{}.*member) set.push_back(word);
  }
  AttributeType type = words_of(name, words, what);
  type.fallback = fields::default_of(type, set);
  return {type, [members](S& s, const AttributeValue& value) {
            for (const auto& [word, member] : members)
              s.*member = std::find(value.words.begin(), value.words.end(), word) != value.words.end();
          }};
}

// A word that names one of a list: of schemes, criteria ...
template <class S, class T>
Field<S> field(const T* S::*member, const std::vector<T>& all, const std::string& name, const std::string& what,
               bool required = false) {
  std::vector<std::string> names;
  for (const T& each : all) names.push_back(each.name);
  AttributeType type = word(name, names, what);
  type.required = required;
  if (const T* usual = S{}.*member; usual && !required) type.fallback = usual->name;
  return {type,
          [member, &all](S& s, const AttributeValue& value) {
            for (const T& each : all)
              if (each.name == value.text) s.*member = &each;
          },
          [member, type](const S& s, const SettingsSource& source) {
            if ((type.required || type.fallback) && !(s.*member)) fields::refuse_missing(type, source);
          }};
}

// The fields of a member that is a struct of settings itself, as fields of the whole.
template <class S, class P> Fields<S> fields_of_part(P S::*part) {
  Fields<S> all;
  for (const Field<P>& of : fields_of<P>())
    all.push_back({of.type, [part, of](S& s, const AttributeValue& value) { of.take(s.*part, value); },
                   [part, of](const S& s, const SettingsSource& source) {
                     if (of.check) of.check(s.*part, source);
                   }});
  return all;
}

template <class S> Fields<S> operator+(Fields<S> a, const Fields<S>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// For settings that a program made, which no reader has looked at. UserError: a number that is not finite or
// out of its bounds, or what is required and not there.
template <class S> void check_settings(const S& settings) {
  for (const Field<S>& field : fields_of<S>())
    if (field.check) field.check(settings, settings.source);
}

// The attributes of S, for the table.
template <class S> std::vector<AttributeType> attributes_of() {
  std::vector<AttributeType> attributes;
  for (const Field<S>& field : fields_of<S>()) attributes.push_back(field.type);
  return attributes;
}

// An element of a preset whose attributes are S, without children.
template <class S> ElementType element_type_of(const std::string& name, const std::string& what) {
  return {name, what, attributes_of<S>(), {}};
}

} // namespace rend
