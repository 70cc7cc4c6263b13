// Shapes: the mesh of a body. A <body> contains exactly one of <sheet>, <bar>, <tube>, <outline> ...
//
// Adding one: a struct of settings among ShapeSettings, its make_map(), a function `ShapeType my_shape()`, and
// its name in all_shapes().
#pragma once

#include "sim/base/settings.h"
#include "sim/body/body.h"
#include "sim/mesh/bar.h"
#include "sim/mesh/outline_mesh.h"
#include "sim/mesh/reader.h"
#include "sim/mesh/sheet.h"
#include "sim/mesh/tube.h"

#include <variant>
#include <vector>

namespace rend {

// Where a body is at rest: scaled, then rotated about x, y, z, then moved. And how it starts: as a rigid body
// that moves and turns about its centre of mass c,
//
//   v = velocity + ω × (x − c)
//
// What <fix> and <drive> prescribe at time 0 starts as they say.
struct Placement {
  double scale = 1;
  Vec3 rotate = Vec3::Zero();    // [degrees]
  Vec3 translate = Vec3::Zero(); // [m]
  Vec3 velocity = Vec3::Zero();  // [m/s], at time 0
  Vec3 spin = Vec3::Zero();      // ω, at time 0: along the axis, as long as its rate [degrees/s]
  SettingsSource source = {};

  void apply(std::vector<Vec3>& points) const; // [m]
};
template <> const Fields<Placement>& fields_of();
std::vector<AttributeType> attributes_at_rest(); // those of a Placement but for how it starts to move

struct MeshSettings {
  std::string file = {};            // relative to the preset; of settings that a program made, to where it runs
  bool texture_coordinates = false; // keep those of the file, for pictures and exports
  SettingsSource source = {};
};
template <> const Fields<MeshSettings>& fields_of();
// A mesh file that settings name. UserError, with its place in the preset or in the mesh.
MeshFile read_mesh_of(const SettingsSource& source, const std::string& file);

// An empty map, for rules to begin with.
struct CreateSettings {
  int dimension = 3; // 2: of a sheet, 3: of a solid
  SettingsSource source = {};
};
template <> const Fields<CreateSettings>& fields_of();

using ShapeSettings = std::variant<SheetShape, BarShape, TubeShape, OutlineShape, MeshSettings, CreateSettings>;

// Make body.map, with its points where `place` puts them. UserError, with its place, for what cannot be built.
void make_map(Body& body, const SheetShape& shape, const Placement& place);
void make_map(Body& body, const BarShape& shape, const Placement& place);
void make_map(Body& body, const TubeShape& shape, const Placement& place);
void make_map(Body& body, const OutlineShape& shape, const Placement& place);
void make_map(Body& body, const MeshSettings& shape, const Placement& place);
void make_map(Body& body, const CreateSettings& shape, const Placement& place);

struct ShapeType {
  const ElementType& (*type)();
  ShapeSettings (*read)(const PresetNode& node);
};

const std::vector<ShapeType>& all_shapes();

ShapeType sheet_shape();
ShapeType bar_shape();
ShapeType tube_shape();
ShapeType outline_shape();
ShapeType mesh_shape();
ShapeType create_shape();

} // namespace rend
