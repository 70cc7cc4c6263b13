// VTK's XML file of an unstructured grid (.vtu), and its collection of files over time (.pvd). VTK User's
// Guide, "VTK File Formats"; numbers of cell types and order of corners: vtkCellType.h and the classes of the
// cells.
//
// Arrays are the bytes in memory, in base64 ("binary": preceded by a 64-bit count of bytes, little-endian,
// uncompressed). Appended raw data would take a quarter less, but VTK 9.1 with the expat of Debian 12's updates
// fails to read it, even its own: "not well-formed" at the end of the document that it constructs.
//
// VTK numbers corners as Gmsh does, except for the wedge: the first triangle of vtkWedge is counter-clockwise
// as seen from outside, that of all other cells as seen from inside.
//
// Where a sheet has a picture, points have texture coordinates (v up), which the file declares to be such
// (TCoords), and points on a seam are split (seams.h). The format has no word for the picture itself.
#include "sim/base/base64.h"
#include "sim/export/format.h"
#include "sim/export/grid.h"
#include "sim/export/seams.h"

#include <fmt/format.h>

#include <bit>
#include <utility>

namespace rend {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says so");

// Of vtkCellType.h, in the order of GridCell.
constexpr std::array<std::uint8_t, 8> vtk_type{5, 9, 7, 10, 12, 13, 14, 42};

class Text {
public:
  void line(const std::string& text) { text_ += text + "\n"; }

  template <class T> void array(const std::string& name, int components, const std::vector<T>& values) {
    const std::string type = std::is_same_v<T, double>         ? "Float64"
                             : std::is_same_v<T, std::int64_t> ? "Int64"
                                                               : "UInt8";
    const std::string width = components == 1 ? "" : fmt::format(" NumberOfComponents=\"{}\"", components);
    const std::uint64_t bytes = values.size() * sizeof(T);
    std::string numbers(reinterpret_cast<const char*>(&bytes), sizeof bytes);
    if (bytes > 0) numbers.append(reinterpret_cast<const char*>(values.data()), bytes);
    text_ += fmt::format(R"(<DataArray type="{}" Name="{}"{} format="binary">)", type, name, width);
    text_ += base64(numbers) + "</DataArray>\n";
  }

  // attributes: of the element, each after a blank.
  void arrays(const char* element, const std::vector<GridArray>& all, const std::string& attributes = "") {
    line(fmt::format("<{}{}>", element, attributes));
    for (const GridArray& one : all)
      std::visit([&](const auto& values) { array(one.name, one.components, values); }, one.values);
    line(fmt::format("</{}>", element));
  }

  std::string whole() { return std::move(text_); }

private:
  std::string text_;
};

// Corners in VTK's order.
std::vector<std::int64_t> vtk_corners(const Grid& grid) {
  std::vector<std::int64_t> corners = grid.corners;
  for (std::size_t cell = 0; cell < grid.kinds.size(); ++cell) {
    if (grid.kinds[cell] != GridCell::Prism) continue;
    const auto first = static_cast<std::size_t>(grid.ends[cell] - 6);
    std::swap(corners[first + 1], corners[first + 2]);
    std::swap(corners[first + 4], corners[first + 5]);
  }
  return corners;
}

void add_cells(Text& text, const Grid& grid) {
  std::vector<std::uint8_t> types;
  for (const GridCell kind : grid.kinds) types.push_back(vtk_type[static_cast<std::size_t>(kind)]);
  text.line("<Cells>");
  text.array("connectivity", 1, vtk_corners(grid));
  text.array("offsets", 1, grid.ends);
  text.array("types", 1, types);
  if (!grid.faces.empty()) {
    text.array("faces", 1, grid.faces);
    text.array("faceoffsets", 1, grid.face_ends);
  }
  text.line("</Cells>");
}

constexpr const char* texture_name = "TextureCoordinates";

void add_texture_coordinates(Grid& grid) {
  std::vector<double> places; // u v of each point
  for (const TexturePlace& at : split_at_seams(grid)) places.insert(places.end(), {at.u, at.v});
  grid.on_points.push_back({texture_name, 2, std::move(places)});
}

constexpr const char* head =
    R"(<VTKFile type="{}" version="1.0" byte_order="LittleEndian" header_type="UInt64">)";

class VtuExporter final : public Exporter {
public:
  VtuExporter(const Scene& scene, const SkinPictures& pictures) : maker_(scene, pictures) {}

  std::string state() const override {
    Grid grid = maker_.grid();
    const bool textured = !grid.texture.empty();
    if (textured) add_texture_coordinates(grid);
    Text text;
    text.line("<?xml version=\"1.0\"?>");
    text.line(fmt::format(fmt::runtime(head), "UnstructuredGrid"));
    text.line("<UnstructuredGrid>");
    text.line("<FieldData>");
    text.line(fmt::format(
        R"(<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{}</DataArray>)",
        grid.time));
    text.line("</FieldData>");
    text.line(fmt::format(R"(<Piece NumberOfPoints="{}" NumberOfCells="{}">)", grid.points.size() / 3,
                          grid.kinds.size()));
    text.line("<Points>");
    text.array("Points", 3, grid.points);
    text.line("</Points>");
    add_cells(text, grid);
    text.arrays("PointData", grid.on_points, textured ? fmt::format(" TCoords=\"{}\"", texture_name) : "");
    text.arrays("CellData", grid.on_cells);
    text.line("</Piece>\n</UnstructuredGrid>\n</VTKFile>");
    return text.whole();
  }

  std::string index(std::span<const ExportedFile> files) const override {
    std::string text =
        "<?xml version=\"1.0\"?>\n" + fmt::format(fmt::runtime(head), "Collection") + "\n<Collection>\n";
    for (const ExportedFile& file : files)
      text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", file.time, file.name);
    return text + "</Collection>\n</VTKFile>\n";
  }

private:
  GridMaker maker_;
};

} // namespace

ExportFormat vtu_format() {
  return {.name = "vtu",
          .what = "VTK unstructured grids: whole cells with all their data; a .pvd lists the files",
          .extension = ".vtu",
          .index_extension = ".pvd",
          .every_frame = false,
          .make = &make_exporter<VtuExporter>};
}

} // namespace rend
