#include "sim/build/named_file.h"
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

// What is wrong within a file tells its place there; what is wrong with its name, that in the preset.
template <class Read> auto with_place_of_file(const SettingsSource& source, Read&& read) {
  try {
    return read();
  } catch (const UserError& error) {
    if (error.code == Exit::BadInput) throw;
    throw UserError(error.code, source.place("file"), error.what(),
                    error.code == Exit::NoInput ? "its name is relative to the folder of the preset"
                                                : error.hint);
  }
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
  return with_place_of_file(source, [&] { return read_mesh(mesh_path(source.place(), file)); });
}

MeshSource open_file_of(const SettingsSource& source, const std::string& file) {
  return with_place_of_file(source, [&] { return MeshSource::open(mesh_path(source.place(), file), "file"); });
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
