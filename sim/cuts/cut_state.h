// What a cut knows of a body, before an edit.
#pragma once

#include "sim/cuts/start_element.h"

#include <span>

namespace rend {

struct CutState {
  const EmbeddedMap& map;
  const Column<StartElement>& start; // of that map
  const Record *position, *velocity; // [m], [m/s], one per vertex slot
  std::span<const Slot> held;        // vertices that do not move, increasing
  bool rigid = false;                // no vertex moves
  LeastPart least = {};
};

} // namespace rend
