// The table of parameters: the single description of every element and attribute that a preset may hold.
//
// An ElementType is declared beside the code that uses it (a force declares its stiffness beside its formula).
// The table drives the reader, the defaults, `rend help preset` and the schema presets/scene.xsd. A PresetNode
// is one element of a preset, checked against its type: every attribute has a value, finite and in range, the
// default where the preset gives none.
#pragma once

#include "sim/base/error.h"
#include "sim/base/wording.h"

#include <Eigen/Core>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rend {

enum class AttributeKind {
  Number,  // one finite number
  Numbers, // `count` finite numbers, separated by blanks (0: any count)
  Integer,
  Integers,           // `count` integers
  Word,               // one of `words`
  Words,              // any of `words`, separated by blanks
  Flag,               // yes, no
  Text,               // anything
  NumberOrWord,       // a number, or one of `words` (step="auto")
  NumberOrExpression, // a number, or an expression, which whoever uses it compiles
};

struct AttributeType {
  std::string name;
  AttributeKind kind = AttributeKind::Number;
  std::string unit; // "N/m"; empty: a pure number or a word
  std::string what; // one line for a reader of `rend help preset`
  // the default, as it would be written in a preset; nullopt: may be absent
  std::optional<std::string> fallback;
  bool required = false;
  int count = 0;                     // Numbers, Integers
  std::vector<std::string> words;    // Word, Words, NumberOrWord
  double low = -1e300, high = 1e300; // inclusive bounds of each number
  bool open_low = false;             // low itself is refused (k > 0)
  // Words: names of the preset as well, which the table cannot know: whoever reads the attribute checks them.
  bool names = false;

  // Written as a chain: number("k", "N/m", "stiffness").at_least(0).is_required()
  AttributeType& is_required();
  AttributeType& otherwise(std::string value); // sets fallback
  AttributeType& at_least(double bound);
  AttributeType& above(double bound);
  AttributeType& at_most(double bound);
};

AttributeType number(std::string name, std::string unit, std::string what);
AttributeType numbers(std::string name, int count, std::string unit, std::string what);
AttributeType integer(std::string name, std::string what);
AttributeType integers(std::string name, int count, std::string what);
AttributeType word(std::string name, std::vector<std::string> words, std::string what);
AttributeType words_of(std::string name, std::vector<std::string> words, std::string what);
AttributeType flag(std::string name, std::string what);
AttributeType text(std::string name, std::string what);
AttributeType number_or(std::string name, std::vector<std::string> words, std::string unit, std::string what);
AttributeType number_or_expression(std::string name, std::string unit, std::string what);

struct ElementType;

// A child element and how often it may occur in its parent.
struct ChildType {
  const ElementType* type;
  int at_least = 0;
  int at_most = 1; // -1: any number
};

struct ElementType {
  std::string name;
  std::string what; // one line
  std::vector<AttributeType> attributes;
  std::vector<ChildType> children;
  // What attributes of other names are, such as the arguments of a rule: they are kept as texts. Empty: there
  // are none.
  std::string further = {};
  const AttributeType* find(std::string_view attribute) const; // null if there is none
};

// The value of an attribute, parsed according to its kind.
struct AttributeValue {
  std::string text; // trimmed (Text: as written)
  std::vector<double> numbers;
  std::vector<std::string> words;
  bool word = false; // NumberOrWord, NumberOrExpression: the value is no number
};

// What a value must be, for messages and help: "2 whole numbers, each of at least 1", "auto, or a number above
// 0 [s]".
std::string expected(const AttributeType& attribute);

// One checked element of a preset.
class PresetNode {
public:
  PresetNode(const ElementType& type, Place place);

  const ElementType& type() const { return *type_; }
  const std::string& name() const { return type_->name; }
  const Place& place() const { return place_; }
  const Place& place(std::string_view attribute) const; // of its value; of the element if it is a default

  bool has(std::string_view attribute) const;   // given, or by default
  bool given(std::string_view attribute) const; // written in the preset (or set on the command line)

  const AttributeValue* find(std::string_view attribute) const; // null: neither given, nor has it a default

  // Values. CHECK: the attribute has that kind and a value.
  double number(std::string_view attribute) const;
  Eigen::Vector3d vector(std::string_view attribute) const; // of 3 numbers
  const std::vector<double>& numbers(std::string_view attribute) const;
  int integer(std::string_view attribute) const;
  const std::vector<double>& integers(std::string_view attribute) const { return numbers(attribute); }
  bool flag(std::string_view attribute) const;
  const std::string& text(std::string_view attribute) const; // Text, Word, or the word of a NumberOrWord
  const std::vector<std::string>& words(std::string_view attribute) const; // Words, in their order
  bool is_word(std::string_view attribute) const;                          // NumberOrWord: the value is a word

  // Attributes that its type does not list (ElementType::further): names, in alphabetical order.
  std::vector<std::string> further() const;

  std::span<const std::unique_ptr<PresetNode>> children() const { return children_; }
  const PresetNode* child(std::string_view name) const; // the first of that name, or null
  std::vector<const PresetNode*> all(std::string_view name) const;

  // Throws UserError for a bad value: file:line:column of the attribute, exit code 65.
  [[noreturn]] void fail(std::string_view attribute, const std::string& what,
                         const std::string& hint = {}) const;

  // For readers: sets an attribute from its text. Throws UserError with `place` if the text does not fit its
  // type.
  void set(const AttributeType& attribute, const std::string& value, const Place& place, bool given = true);
  PresetNode& add(std::unique_ptr<PresetNode> child);
  void fill_defaults();        // of this element and its descendants
  void check_complete() const; // required attributes, numbers of children; of this element and its descendants

private:
  bool may_have(std::string_view attribute) const; // its type lists it, or takes any
  struct Value : AttributeValue {
    bool given = false;
    Place place;
  };
  struct Reading; // parses a text into a Value
  const Value& value(std::string_view attribute, std::initializer_list<AttributeKind> kinds) const;

  const ElementType* type_;
  Place place_;
  std::map<std::string, Value, std::less<>> values_;
  std::vector<std::unique_ptr<PresetNode>> children_;
};

} // namespace rend
