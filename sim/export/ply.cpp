// Stanford's polygon file (.ply), binary little-endian: one file holds all bodies and obstacles, distinguished
// by a property. Turk, "The PLY Polygon File Format" (1994).
//
// Numbers are doubles, so that a reader gets the state to the last bit. Point properties have names that
// Blender keeps as attributes (vx vy vz, stress); ParaView reads only the surface, and has .vtu for the rest.
// There are no normals: a normal per point would round the creases of a solid, and programs that draw compute
// their own.
//
// Where a body has a picture, points have texture coordinates (s t, as Blender reads them, t up), and points on
// a seam are split (seams.h). The format has no word for the picture itself.
//
// ParaView takes times from a .series file, which lists the others; other programs use the numbers in their
// names.
#include "sim/export/format.h"
#include "sim/export/obstacle_skin.h"
#include "sim/export/seams.h"

#include <fmt/format.h>

#include <bit>
#include <utility>

namespace rend {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says so");

// One property of all elements of a kind, or several stored in one array.
struct Column {
  const char* type;
  std::vector<const char*> names;
  const void* values;
  std::size_t bytes; // of one element
};

template <class T> const char* type_name() {
  return std::is_same_v<T, double>          ? "double"
         : std::is_same_v<T, std::int32_t>  ? "int"
         : std::is_same_v<T, std::uint32_t> ? "uint"
                                            : "uchar";
}

template <class T>
void add_column(std::vector<Column>& to, std::vector<const char*> names, const std::vector<T>& values) {
  const std::size_t bytes = names.size() * sizeof(T);
  if (!values.empty()) to.push_back({type_name<T>(), std::move(names), values.data(), bytes});
}

std::vector<Column> point_columns(const Skin& skin, const std::vector<TexturePlace>& places) {
  std::vector<Column> all;
  add_column(all, {"x", "y", "z"}, skin.points);
  add_column(all, {"vx", "vy", "vz"}, skin.velocity);
  add_column(all, {"stress"}, skin.largest_stress);
  add_column(all, {"body"}, skin.body_of_point);
  add_column(all, {"vertex"}, skin.vertex);
  static_assert(sizeof(TexturePlace) == 2 * sizeof(double), "two numbers");
  if (!places.empty()) all.push_back({"double", {"s", "t"}, places.data(), sizeof(TexturePlace)});
  return all;
}

std::vector<Column> face_columns(const Skin& skin) {
  std::vector<Column> all;
  add_column(all, {"body"}, skin.body_of_face);
  add_column(all, {"fragment"}, skin.fragment);
  add_column(all, {"element"}, skin.element);
  add_column(all, {"bare"}, skin.exposed);
  add_column(all, {"von_mises"}, skin.equivalent);
  return all;
}

class PlyFile {
public:
  // places: of points, or empty.
  PlyFile(const Skin& skin, const std::vector<TexturePlace>& places)
      : skin_(skin), on_points_(point_columns(skin, places)), on_faces_(face_columns(skin)) {
    for (std::size_t f = 0; f < skin.ends.size(); ++f) many_sides_ = many_sides_ || sides(f) > 255;
  }

  std::string bytes() {
    add_header();
    for (std::size_t p = 0; p < skin_.vertex.size(); ++p) add_row(on_points_, p);
    for (std::size_t f = 0; f < skin_.ends.size(); ++f) {
      add_corners(f);
      add_row(on_faces_, f);
    }
    return std::move(out_);
  }

private:
  std::size_t begin(std::size_t face) const {
    return face == 0 ? 0 : static_cast<std::size_t>(skin_.ends[face - 1]);
  }
  std::size_t sides(std::size_t face) const { return static_cast<std::size_t>(skin_.ends[face]) - begin(face); }

  void append(const void* from, std::size_t bytes) { out_.append(static_cast<const char*>(from), bytes); }

  void add_header() {
    out_ += fmt::format("ply\nformat binary_little_endian 1.0\ncomment time {} s, lengths in m, z is up\n",
                        skin_.time);
    for (std::size_t b = 0; b < skin_.bodies.size(); ++b)
      out_ += fmt::format("comment body {} is {}\n", b, one_word(skin_.bodies[b].name));
    out_ += fmt::format("element vertex {}\n", skin_.vertex.size());
    add_properties(on_points_);
    out_ += fmt::format("element face {}\nproperty list {} int vertex_indices\n", skin_.ends.size(),
                        many_sides_ ? "uint" : "uchar");
    add_properties(on_faces_);
    out_ += "end_header\n";
  }

  void add_properties(const std::vector<Column>& columns) {
    for (const Column& column : columns)
      for (const char* name : column.names) out_ += fmt::format("property {} {}\n", column.type, name);
  }

  void add_row(const std::vector<Column>& columns, std::size_t row) {
    for (const Column& column : columns)
      append(static_cast<const char*>(column.values) + row * column.bytes, column.bytes);
  }

  void add_corners(std::size_t face) {
    const auto count = static_cast<std::uint32_t>(sides(face));
    append(&count, many_sides_ ? 4 : 1); // the first byte of a little-endian number is the lowest
    append(skin_.corners.data() + begin(face), count * sizeof(std::int32_t));
  }

  const Skin& skin_;
  std::vector<Column> on_points_, on_faces_;
  bool many_sides_ = false; // whether some face has more sides than a byte can count
  std::string out_;
};

class PlyExporter final : public Exporter {
public:
  PlyExporter(const Scene& scene, const SkinPictures& pictures)
      : world_(scene.world()), maker_(scene, pictures) {}
  std::string state() const override {
    Skin skin = maker_.skin();
    add_obstacles(skin, world_);
    std::vector<TexturePlace> places;
    if (!skin.texture.empty()) places = split_at_seams(skin);
    return PlyFile(skin, places).bytes();
  }

  std::string index(std::span<const ExportedFile> files) const override {
    std::string text = "{\n  \"file-series-version\": \"1.0\",\n  \"files\": [\n";
    for (const ExportedFile& file : files)
      text += fmt::format("    {{\"name\": \"{}\", \"time\": {}}}{}\n", file.name, file.time,
                          &file == &files.back() ? "" : ",");
    return text + "  ]\n}\n";
  }

private:
  const World& world_;
  SkinMaker maker_;
};

} // namespace

ExportFormat ply_format() {
  return {.name = "ply",
          .what = "the surface as polygons, with velocities, fragments and stress; binary, one file per frame",
          .extension = ".ply",
          .index_extension = ".ply.series",
          .every_frame = true,
          .make = &make_exporter<PlyExporter>};
}

} // namespace rend
