#include "render/facts/rows_are.h"

#include "sim/base/enum_words.h"

namespace rend {

const char* name_of(RowsAre rows) {
  static constexpr EnumWords<RowsAre::Cornered> words{"folded", "each by itself",
                                                      "each by itself, into corners"};
  return words[rows];
}

RowsAre folded_rows_are(const Program& program) {
  return program.options().fold ? RowsAre::Folded : RowsAre::Single;
}

} // namespace rend
