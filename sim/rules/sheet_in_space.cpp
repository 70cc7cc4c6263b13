#include "sim/rules/sheet_in_space.h"

#include <vector>

namespace rend {

std::unique_ptr<EmbeddedMap> sheet_in_space(const EmbeddedMap& sheet) {
  auto solid = std::make_unique<EmbeddedMap>(3);
  std::vector<Dart> made(sheet.map().capacity());
  solid->edit([&](Edit& edit) {
    sheet.map().for_each_dart([&](Dart d) {
      made[d.value] = edit.add_dart();
      edit.give(made[d.value],
                {sheet.position_of(d), sheet.rest_of(d), sheet.velocity()[sheet.vertex(d)].vec()});
    });
    for (int i = 0; i < 3; ++i)
      sheet.map().for_each_dart([&](Dart d) {
        const Dart other = sheet.map().alpha(i, d);
        if (d < other) edit.link(i, made[d.value], made[other.value]);
      });
  });
  return solid;
}

} // namespace rend
