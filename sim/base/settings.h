// Settings: structs whose members are described once - name, unit, bounds, what for - so that the table of
// parameters (reader, help, schema, manual) and a C++ program have the same names and the same defaults.
//
//   struct ViscositySettings { double value = 0; bool per_body = false; SettingsSource source; };
//
//   template <> const Fields<ViscositySettings>& fields_of() {
//     static const Fields<ViscositySettings> fields{
//         field(&ViscositySettings::value, number("value", "N.s/m", "the coefficient").is_required()), ...};
//     return fields;
//   }
//
// The default of an attribute is that of the member: where it is an empty optional, or the attribute is
// required, there is none. Enumerators stand for the attribute's words, in their order.
#pragma once

#include "sim/base/check.h"
#include "sim/base/parameters.h"
#include "sim/base/record.h"

#include <array>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace rend {

// Where settings stand in a user's file, for messages. Of settings that a program made: nowhere.
struct SettingsSource {
  std::function<Place(std::string_view attribute)> place_of; // of its value; of the element for ""
  std::function<bool(std::string_view attribute)> is_given;  // it stands there, and is no default

  Place place(std::string_view attribute = {}) const { return place_of ? place_of(attribute) : Place{}; }
  bool given(std::string_view attribute) const { return is_given && is_given(attribute); }
  // UserError (BadInput) at that place.
  [[noreturn]] void fail(std::string_view attribute, const std::string& what,
                         const std::string& hint = {}) const;
};

template <class S> struct Field {
  AttributeType type;
  std::function<void(S&, const AttributeValue&)> take;
};
template <class S> using Fields = std::vector<Field<S>>;

// Specialised beside each struct of settings.
template <class S> const Fields<S>& fields_of();

namespace fields {

// As it would stand in a preset: the shortest digits that are read back as the same number.
std::string text_of(double value);

template <class T> struct IsOptional : std::false_type {};
template <class T> struct IsOptional<std::optional<T>> : std::true_type {};
template <class T> struct IsArray : std::false_type {};
template <class T, std::size_t N> struct IsArray<std::array<T, N>> : std::true_type {};

template <class List> std::string text_of_list(const List& list) {
  std::string out;
  for (const auto& value : list) out += (out.empty() ? "" : " ") + text_of(static_cast<double>(value));
  return out;
}

// The default that a member stands for; none: there is none.
template <class M> std::optional<std::string> default_of(const AttributeType& type, const M& member) {
  if constexpr (IsOptional<M>::value) {
    if (member) return default_of(type, *member);
    return type.kind == AttributeKind::NumberOrWord ? std::optional(type.words.front()) : std::nullopt;
  } else if constexpr (std::is_same_v<M, bool>) {
    return member ? "yes" : "no";
  } else if constexpr (std::is_enum_v<M>) {
    return type.words.at(static_cast<std::size_t>(member));
  } else if constexpr (std::is_arithmetic_v<M>) {
    return text_of(static_cast<double>(member));
  } else if constexpr (std::is_same_v<M, std::string>) {
    return member;
  } else if constexpr (std::is_same_v<M, Vec3>) {
    return text_of_list(std::array{member.x(), member.y(), member.z()});
  } else if constexpr (std::is_same_v<M, std::vector<std::string>>) {
    std::string out;
    for (const std::string& word : member) out += (out.empty() ? "" : " ") + word;
    return out;
  } else {
    return text_of_list(member);
  }
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
  } else if constexpr (std::is_arithmetic_v<M>) {
    member = static_cast<M>(value.numbers.at(0));
  } else if constexpr (std::is_same_v<M, std::string>) {
    member = value.text;
  } else if constexpr (std::is_same_v<M, Vec3>) {
    member = Vec3(value.numbers.at(0), value.numbers.at(1), value.numbers.at(2));
  } else if constexpr (std::is_same_v<M, std::vector<std::string>>) {
    member = value.words;
  } else if constexpr (IsArray<M>::value) {
    for (std::size_t n = 0; n < member.size(); ++n)
      member[n] = static_cast<typename M::value_type>(value.numbers.at(n));
  } else {
    member.assign(value.numbers.begin(), value.numbers.end());
  }
}

} // namespace fields

template <class S, class M> Field<S> field(M S::*member, AttributeType type) {
  if (!type.required) type.fallback = fields::default_of(type, S{}.*member);
  return {type, [member, type](S& s, const AttributeValue& value) { fields::take(type, value, s.*member); }};
}

// Their attributes, for the table.
template <class S> std::vector<AttributeType> attributes_of() {
  std::vector<AttributeType> attributes;
  for (const Field<S>& field : fields_of<S>()) attributes.push_back(field.type);
  return attributes;
}

} // namespace rend
