#include "sim/build/shape.h"
#include "sim/mesh/reader.h"
#include "sim/preset/paths.h"

namespace rend {
namespace {

const ElementType& mesh_type() {
  static const ElementType type = [] {
    std::string formats;
    for (const MeshReader& reader : all_readers())
      for (const std::string& extension : reader.extensions)
        formats += (formats.empty() ? "" : ", ") + extension;
    return ElementType{
        "mesh",
        "a sheet or a solid from a file",
        {text("file", formats + "; relative to the preset, and in its folder or below").is_required()},
        {}};
  }();
  return type;
}

void build(Body& body, const PresetNode& node, const Placement& place) {
  MeshFile file = [&] {
    try {
      return read_mesh(mesh_path(node));
    } catch (const UserError& error) {
      if (error.code == Exit::BadInput) throw; // says where in the mesh
      throw UserError(error.code, node.place("file"), error.what(), error.hint);
    }
  }();
  place.apply(file.points());
  order_for_locality(file);
  MeshBody mesh = sew(std::move(file));
  body.map = std::move(mesh.map);
  body.groups = std::move(mesh.groups);
  body.notes.insert(body.notes.end(), mesh.notes.begin(), mesh.notes.end());
}

} // namespace

ShapeType mesh_shape() {
  return {mesh_type, build};
}

} // namespace rend
