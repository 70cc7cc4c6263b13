// Shapes: what a body is made of, cell by cell. Of <sheet>, <bar>, <tube> ... a <body> holds exactly one.
//
// Adding one: a file with a function `ShapeType my_shape()`, and its name in all_shapes().
#pragma once

#include "sim/base/parameters.h"
#include "sim/body/body.h"
#include "sim/mesh/fault.h"

#include <filesystem>

namespace rend {

// <place>: x to turn x + shift.
struct Placement {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity(); // with the scale
  Vec3 shift = Vec3::Zero();                          // [m]
  explicit Placement(const PresetNode* place);        // null: none
  void apply(std::vector<Vec3>& points) const;
};

struct ShapeType {
  const ElementType& (*type)();
  // Makes body.map, with its points where `place` puts them. UserError, with its place, for what cannot be
  // built.
  void (*build)(Body& body, const PresetNode& node, const Placement& place);
};

const std::vector<ShapeType>& all_shapes();

ShapeType sheet_shape();
ShapeType bar_shape();
ShapeType tube_shape();
ShapeType mesh_shape();

} // namespace rend
