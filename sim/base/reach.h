// How far away, how fast and how heavy what a preset describes may be.
//
// Energies are masses times squares of speeds, volumes products of three lengths: up to these bounds all of
// them are numbers, with room for what a simulation makes of them.
#pragma once

#include "sim/base/parameters.h"

#include <string>
#include <utility>

namespace rend {

constexpr double farthest = 1e30;     // [m], of each coordinate from the origin
constexpr double fastest = 1e30;      // [m/s], along each axis
constexpr double heaviest = 1e30;     // [kg]; of a density: [kg/m³]
constexpr double most_degrees = 1e30; // of an angle, and of one a second

// Numbers from -most to most.
inline AttributeType within(AttributeType type, double most) {
  return type.at_least(-most).at_most(most);
}

inline AttributeType position(std::string name, std::string what) {
  return within(numbers(std::move(name), 3, "m", std::move(what)), farthest);
}

inline AttributeType velocity(std::string name, std::string what) {
  return within(numbers(std::move(name), 3, "m/s", std::move(what)), fastest);
}

} // namespace rend
