#include "render/draw/finish.h"

#include "sim/base/check.h"

namespace rend {

const std::vector<Finish>& finishes() {
  static const std::vector<Finish> all{
      {"cloth", "woven: light shines through a little", 0.07f, 3, 0.42f, 0, 0.16f},
      {"matte", "paper, plaster: no gloss, and soft light", 0, 1, 0, 0.12f, 0.05f},
      {"rubber", "dark and smooth, with a soft gloss", 0.40f, 3, 0.05f, 0, 0},
      {"organ", "wet and soft: light goes under the skin, and a sharp gloss lies on it", 0.60f, 5, 0.20f, 0.50f,
       0.10f},
      {"brittle", "glazed: a hard, bright gloss", 1, 7, 0.90f, 0, 0.05f}};
  return all;
}

const Finish& finish_called(const std::string& name) {
  for (const Finish& finish : finishes())
    if (finish.name == name) return finish;
  CHECK_NOTE(false, name);
  return finishes().front();
}

std::vector<std::string> finish_names() {
  std::vector<std::string> names;
  for (const Finish& finish : finishes()) names.push_back(finish.name);
  return names;
}

} // namespace rend
