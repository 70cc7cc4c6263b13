#include "sim/rules/cell_words.h"

#include <array>

namespace rend {

std::string cell_in_words(Orbit orbit) {
  static constexpr std::array<const char*, orbit_kinds> names{"dart",
                                                              "side of a face, one volume",   // <0>
                                                              "corner of a face, one volume", // <1>
                                                              "face, one volume",             // <0,1>
                                                              "end of an edge, one volume",   // <2>
                                                              "edge, one volume",             // <0,2>
                                                              "vertex, one volume",           // <1,2>
                                                              "volume, or all of a sheet",    // <0,1,2>
                                                              "dart, both volumes",           // <3>
                                                              "side of a face",               // <0,3>
                                                              "corner of a face",             // <1,3>
                                                              "face",                         // <0,1,3>
                                                              "end of an edge",               // <2,3>
                                                              "edge",                         // <0,2,3>
                                                              "vertex",                       // <1,2,3>
                                                              "component"};
  return names[orbit.mask];
}

} // namespace rend
