#include "render/commands/gmsh.h"

#include "render/files/outside_program.h"
#include "render/files/work_folder.h"
#include "sim/base/error.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"
#include "sim/mesh/surface_crossing.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

namespace rend {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw UserError(Exit::ReadWrite, {}, in_quotes(path.string()) + " could not be written");
}

// One thread, so that the same surface gives the same solid. Sizes of edges within come from `size` alone: by
// default they would be those of the surface.
std::string script(double size) {
  return fmt::format("General.NumThreads = 1;\n"
                     "Mesh.CharacteristicLengthExtendFromBoundary = 0;\n"
                     "Mesh.CharacteristicLengthMin = {0:.17g};\n"
                     "Mesh.CharacteristicLengthMax = {0:.17g};\n"
                     "Merge \"surface.msh\";\n"
                     "Surface Loop(1) = {{1}};\n"
                     "Volume(1) = {{1}};\n"
                     "Physical Volume(1) = {{1}};\n",
                     size);
}

// The lines that tell what went wrong; all of it, where none does.
std::string errors_in(const std::string& said) {
  std::string errors;
  for (std::size_t at = 0; at < said.size();) {
    const std::size_t end = std::min(said.find('\n', at), said.size());
    const std::string line = said.substr(at, end - at);
    if (line.find("Error") != std::string::npos) errors += (errors.empty() ? "" : "; ") + line;
    at = end + 1;
  }
  constexpr std::size_t enough = 500;
  return printable((errors.empty() ? said : errors).substr(0, enough));
}

// The fault is the surface's where it crosses itself.
[[noreturn]] void fail(const std::string& what, const ClosedSurface& surface, const FillSettings& settings) {
  if (const auto at = crossing_of(surface))
    throw UserError(
        Exit::BadInput, {settings.file},
        fmt::format("the surface crosses or touches itself near ({:.6g}, {:.6g}, {:.6g}) m, so that it is "
                    "the boundary of no solid",
                    at->x(), at->y(), at->z()),
        "mend it there in a program for surfaces");
  throw UserError(Exit::ReadWrite, {}, "gmsh could not fill the surface: " + what,
                  "triangles may be too flat: `rend mesh info` tells the worst");
}

MeshFile checked(const fs::path& path, const ClosedSurface& surface, const std::string& said,
                 const FillSettings& settings) {
  if (!fs::exists(path)) fail(errors_in(said), surface, settings);
  MeshFile file = [&] {
    try {
      return read_mesh(path);
    } catch (const UserError& error) {
      fail(std::string("what it wrote cannot be read: ") + error.what(), surface, settings);
    }
  }();
  const auto* solid = std::get_if<CellMesh>(&file.mesh);
  if (!solid || solid->cells() == 0) fail("it made no tetrahedra. " + errors_in(said), surface, settings);
  if (const std::string flaw = flaw_of_filling(*solid, surface); !flaw.empty()) fail(flaw, surface, settings);
  file.groups.clear();
  return file;
}

} // namespace

std::optional<MeshFile> filled_by_gmsh(const ClosedSurface& surface, const FillSettings& settings) {
  const WorkFolder folder("rend-fill", "set TMPDIR to a folder that can be written to");
  write(folder.path() / "surface.msh", msh_text(surface));
  write(folder.path() / "fill.geo", script(settings.size));
  const auto outcome =
      run_outside_program({"gmsh", "fill.geo", "-3", "-format", "msh22", "-o", "solid.msh", "-v", "2"},
                          folder.path(), settings.limit.left(), settings.stop);
  if (!outcome)
    throw UserError(Exit::Usage, {}, "the program gmsh, which fills surfaces, is not installed",
                    "Debian has it in the package gmsh: apt-get install gmsh");
  if (outcome->end == ProgramOutcome::End::Asked) return {};
  if (outcome->end == ProgramOutcome::End::TimeLimit) settings.limit.fail();
  if (outcome->code != 0)
    fail(fmt::format("exit code {}. {}", outcome->code, errors_in(outcome->said)), surface, settings);
  return checked(folder.path() / "solid.msh", surface, outcome->said, settings);
}

} // namespace rend
