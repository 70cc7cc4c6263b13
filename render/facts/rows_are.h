// What a row of an interaction stands for.
#pragma once

#include "sim/rows/program.h"

namespace rend {

enum class RowsAre {
  Folded,  // parallel ones in one
  Single,  // each by itself
  Cornered // each by itself, and its forces go to element corners
};
const char* name_of(RowsAre rows);
RowsAre folded_rows_are(const Program& program); // those of Program::folded(); the elementary ones are Cornered

} // namespace rend
