// Numbers on the command line, for an option's transform().
//
// CLI11 reads them as C does: "nan" lies within every range, 0x10 is 16, 010 is 8, " 5" and "true" are numbers.
// Here a number is a whole word of decimal digits, finite and within bounds, as in a preset. What is refused is
// said in a sentence, and ends with 64.
#pragma once

namespace CLI {
class Validator;
}

namespace rend {

CLI::Validator whole_number(long low, long high);
CLI::Validator real_number(double low, double high);

// For words that are taken apart later, where none would count as an option that was not given.
CLI::Validator some_word();

} // namespace rend
