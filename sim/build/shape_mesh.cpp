#include "sim/build/read_settings.h"
#include "sim/build/shape.h"
#include "sim/mesh/reader.h"
#include "sim/preset/paths.h"

namespace rend {
namespace {

const ElementType& mesh_type() {
  static const ElementType type{"mesh", "a sheet or a solid from a file", attributes_of<MeshSettings>(), {}};
  return type;
}

} // namespace

template <> const Fields<MeshSettings>& fields_of() {
  using S = MeshSettings;
  static const Fields<S> fields = [] {
    std::string formats;
    for (const MeshReader& reader : all_readers())
      for (const std::string& extension : reader.extensions)
        formats += (formats.empty() ? "" : ", ") + extension;
    return Fields<S>{
        field(&S::file,
              text("file", formats + "; relative to the preset, and in its folder or below").is_required())};
  }();
  return fields;
}

MeshFile read_mesh_of(const SettingsSource& source, const std::string& file) {
  try {
    return read_mesh(mesh_path(source.place(), file));
  } catch (const UserError& error) {
    if (error.code == Exit::BadInput) throw; // says where in the mesh
    throw UserError(error.code, source.place("file"), error.what(),
                    error.code == Exit::NoInput ? "its name is relative to the folder of the preset"
                                                : error.hint);
  }
}

void make_map(Body& body, const MeshSettings& shape, const Placement& place) {
  check_settings(shape);
  MeshFile file = read_mesh_of(shape.source, shape.file);
  if (PolygonMesh* polygons = std::get_if<PolygonMesh>(&file.mesh); polygons && !shape.texture_coordinates)
    polygons->texture.clear();
  if (shape.texture_coordinates && !file.texture_note.empty()) file.notes.push_back(file.texture_note);
  place.apply(file.points());
  order_for_locality(file);
  MeshBody mesh = sew(std::move(file));
  body.map = std::move(mesh.map);
  body.groups = std::move(mesh.groups);
  body.notes.insert(body.notes.end(), mesh.notes.begin(), mesh.notes.end());
}

ShapeType mesh_shape() {
  return {mesh_type, [](const PresetNode& node) -> ShapeSettings { return read_settings<MeshSettings>(node); }};
}

} // namespace rend
