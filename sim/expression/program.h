// An expression as postfix code for a stack of values.
#pragma once

#include "sim/expression/value.h"

#include <cstddef>
#include <cstdint>

namespace rend {

constexpr std::size_t most_values = 256; // on the stack; an expression that needs more is refused

struct Instruction {
  enum class Kind : std::uint8_t {
    Number,   // pushes `number`
    Operator, // replaces the last `count` values by apply() of them
    Function, // the same for a built-in function
    Call,     // the same for a function of the caller
    Skip,     // of `and` and `or`: where the last value is `when`, goes on at `index`; elsewhere drops it
    Join,     // where such a Skip leads: does nothing
    Branch,   // of `if`: drops a condition, and goes on at `index` where it does not hold
    Jump,     // goes on at `index`
    Choice,   // behind the second value of an `if`: does nothing
  };
  Kind kind = Kind::Number;
  bool when = false;
  ValueType result = ValueType::Scalar;
  std::uint8_t count = 0;   // arguments on the stack
  std::uint32_t index = 0;  // in operators() (also of a Join), in built_ins(), in calls(), in the program
  std::uint32_t column = 0; // in the text, from 1
  double number = 0;
  Apply apply = nullptr;
};

} // namespace rend
