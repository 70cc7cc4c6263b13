// Mesh files for tests: our own meshes as text, and Gmsh to convert them.
#pragma once

#include "sim/mesh/bar.h"
#include "sim/mesh/msh_writer.h"
#include "sim/mesh/reader.h"
#include "sim/mesh/sheet.h"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <random>
#include <stdexcept>
#include <string>

namespace rend::files {

namespace fs = std::filesystem;

// A temporary folder, removed at the end of the test.
class Folder {
public:
  Folder() : path_(fs::temp_directory_path() / ("rend-mesh-" + std::to_string(std::random_device()()))) {
    fs::create_directories(path_);
  }
  ~Folder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  // Runs Gmsh in this folder.
  void gmsh(const std::string& arguments) const {
    const std::string command = "cd '" + path_.string() + "' && gmsh " + arguments + " -v 1 >gmsh.log 2>&1";
    if (std::system(command.c_str()) != 0) throw std::runtime_error("failed: gmsh " + arguments);
  }
  const fs::path& path() const { return path_; }

private:
  fs::path path_;
};

inline std::string content(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline MeshBody read(const std::string& name, const std::string& text) {
  return sew(read_mesh(MeshSource(name, text)));
}

inline std::string text_of(std::unique_ptr<EmbeddedMap> map) {
  MeshBody body;
  body.map = std::move(map);
  return msh_text(body, "a test");
}

inline std::unique_ptr<EmbeddedMap> mixed_bar() {
  return solid_from(bar_cells({BarPattern::Mixed, 3, 2, 1, Vec3(3, 2, 1)}));
}

inline std::unique_ptr<EmbeddedMap> mixed_sheet() {
  SheetShape shape;
  shape.pattern = SheetPattern::Mixed;
  shape.nx = 3;
  shape.ny = 2;
  shape.size = {3, 2};
  return sheet_from(sheet_polygons(shape));
}

// "1 5 2": the corners of a polygon, counted from `base`.
inline std::string corners_text(const PolygonMesh& mesh, std::size_t polygon, std::uint32_t base) {
  std::string text;
  for (std::uint32_t c = mesh.first[polygon]; c < mesh.first[polygon + 1]; ++c)
    text += fmt::format(" {}", mesh.corners[c] + base);
  return text;
}

inline std::string obj_text(const PolygonMesh& mesh) {
  std::string text;
  for (const Vec3& x : mesh.points) text += fmt::format("v {} {} {}\n", x.x(), x.y(), x.z());
  for (std::size_t p = 0; p < mesh.polygons(); ++p) text += fmt::format("f{}\n", corners_text(mesh, p, 1));
  return text;
}

inline std::string off_text(const PolygonMesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.points.size(), mesh.polygons());
  for (const Vec3& x : mesh.points) text += fmt::format("{} {} {}\n", x.x(), x.y(), x.z());
  for (std::size_t p = 0; p < mesh.polygons(); ++p)
    text += fmt::format("{}{}\n", mesh.first[p + 1] - mesh.first[p], corners_text(mesh, p, 0));
  return text;
}

} // namespace rend::files
