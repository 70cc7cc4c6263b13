#include "sim/topology/orbit.h"

#include <array>

namespace rend {

std::string to_string(Orbit orbit) {
  std::string text = "<";
  for (int i = 0; i < 4; ++i) {
    if (!orbit.has(i)) continue;
    if (text.size() > 1) text += ',';
    text += static_cast<char>('0' + i);
  }
  return text + '>';
}

const char* name(Orbit orbit) {
  static constexpr std::array<const char*, orbit_kinds> names{"SingleDart",
                                                              "EdgeOfFace",
                                                              "VertexOfFace",
                                                              "FaceOfVolume",
                                                              "EdgeEndOfVolume",
                                                              "EdgeOfVolume",
                                                              "VertexOfVolume",
                                                              "Volume",
                                                              "DartBothSides",
                                                              "EdgeOfFaceBothSides",
                                                              "VertexOfFaceBothSides",
                                                              "Face",
                                                              "EdgeEnd",
                                                              "Edge",
                                                              "Vertex",
                                                              "Component"};
  return names[orbit.mask & 15];
}

} // namespace rend
