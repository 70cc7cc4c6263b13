// Numbers on the command line, for Option::transform().
//
// CLI11 reads them as C does: "nan" lies within every range, 0x10 is 16, 010 is 8, " 5" and "true" are numbers.
// Here a number must be one decimal number, finite and within bounds, as in a preset. Others are refused with a
// message, and exit code 64.
#pragma once

#include "render/console/command_line.h"

namespace rend {

WordCheck whole_number(long low, long high);
WordCheck real_number(double low, double high);

// Refuses an empty word, for options that are parsed later and treat an empty word as not given.
WordCheck some_word();

} // namespace rend
