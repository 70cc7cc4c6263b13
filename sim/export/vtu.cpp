// VTK's XML file of an unstructured grid (.vtu), with the numbers as they are in memory, appended ("raw": 64-bit counts,
// little-endian, uncompressed), and its collection of files over time (.pvd). VTK User's Guide, "VTK File Formats";
// numbers of cell types and order of corners: vtkCellType.h and the classes of the cells.
//
// VTK counts corners as Gmsh does, but for the wedge: the first triangle of vtkWedge turns as seen from outside, that of
// all others as seen from inside.
#include "sim/export/format.h"
#include "sim/export/grid.h"

#include <fmt/format.h>

#include <bit>
#include <cstring>

namespace rend {
namespace {

static_assert(std::endian::native == std::endian::little, "the file says so");

// Of vtkCellType.h, in the order of GridCell.
constexpr std::array<std::uint8_t, 8> vtk_type{5, 9, 7, 10, 12, 13, 14, 42};

// The text of the file, and behind it the numbers.
class Parts {
public:
  void line(const std::string& text) { text_ += text + "\n"; }

  template <class T> void array(const std::string& name, int components, const std::vector<T>& values) {
    const std::string type = std::is_same_v<T, double>         ? "Float64"
                             : std::is_same_v<T, std::int64_t> ? "Int64"
                                                               : "UInt8";
    const std::string width = components == 1 ? "" : fmt::format(" NumberOfComponents=\"{}\"", components);
    line(fmt::format(R"(<DataArray type="{}" Name="{}"{} format="appended" offset="{}"/>)", type, name, width,
                     numbers_.size()));
    const std::uint64_t bytes = values.size() * sizeof(T);
    append(&bytes, sizeof bytes);
    append(values.data(), bytes);
  }

  void arrays(const char* element, const std::vector<GridArray>& all) {
    line(fmt::format("<{}>", element));
    for (const GridArray& one : all)
      std::visit([&](const auto& values) { array(one.name, one.components, values); }, one.values);
    line(fmt::format("</{}>", element));
  }

  std::string file() const {
    return text_ + "<AppendedData encoding=\"raw\">\n_" + numbers_ + "\n</AppendedData>\n</VTKFile>\n";
  }

private:
  void append(const void* from, std::size_t bytes) {
    if (bytes > 0) numbers_.append(static_cast<const char*>(from), bytes);
  }
  std::string text_, numbers_;
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

void add_cells(Parts& parts, const Grid& grid) {
  std::vector<std::uint8_t> types;
  for (const GridCell kind : grid.kinds) types.push_back(vtk_type[static_cast<std::size_t>(kind)]);
  parts.line("<Cells>");
  parts.array("connectivity", 1, vtk_corners(grid));
  parts.array("offsets", 1, grid.ends);
  parts.array("types", 1, types);
  if (!grid.faces.empty()) {
    parts.array("faces", 1, grid.faces);
    parts.array("faceoffsets", 1, grid.face_ends);
  }
  parts.line("</Cells>");
}

constexpr const char* head =
    R"(<VTKFile type="{}" version="1.0" byte_order="LittleEndian" header_type="UInt64">)";

class VtuExporter final : public Exporter {
public:
  explicit VtuExporter(const Scene& scene) : maker_(scene) {}

  std::string state() const override {
    const Grid grid = maker_.grid();
    Parts parts;
    parts.line("<?xml version=\"1.0\"?>");
    parts.line(fmt::format(fmt::runtime(head), "UnstructuredGrid"));
    parts.line("<UnstructuredGrid>");
    parts.line("<FieldData>");
    parts.line(fmt::format(
        R"(<DataArray type="Float64" Name="TimeValue" NumberOfTuples="1" format="ascii">{}</DataArray>)",
        grid.time));
    parts.line("</FieldData>");
    parts.line(fmt::format(R"(<Piece NumberOfPoints="{}" NumberOfCells="{}">)", grid.points.size() / 3,
                           grid.kinds.size()));
    parts.line("<Points>");
    parts.array("Points", 3, grid.points);
    parts.line("</Points>");
    add_cells(parts, grid);
    parts.arrays("PointData", grid.on_points);
    parts.arrays("CellData", grid.on_cells);
    parts.line("</Piece>\n</UnstructuredGrid>");
    return parts.file();
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
  return {"vtu", "VTK's unstructured grids, one a frame, and a .pvd that lists them", ".vtu", ".pvd",
          [](const Scene& scene) -> std::unique_ptr<Exporter> { return std::make_unique<VtuExporter>(scene); }};
}

} // namespace rend
