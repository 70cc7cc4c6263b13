#include "render/commands/gmsh.h"

#include "render/files/outside_program.h"
#include "render/files/temporaries.h"
#include "sim/base/error.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <utility>

namespace rend {
namespace {

namespace fs = std::filesystem;

constexpr const char* may_cross = "the surface may cross itself, or have triangles that are too flat: "
                                  "`rend mesh info` tells the worst";

// For its input and output.
class WorkFolder {
public:
  WorkFolder() {
    std::string name = (fs::temp_directory_path() / "rend-fill-XXXXXX").string();
    if (!mkdtemp(name.data()))
      throw UserError(Exit::CannotCreate, {},
                      "no temporary folder can be made in " + in_quotes(fs::temp_directory_path().string()),
                      "set TMPDIR to a folder that can be written to");
    path_ = name;
    temporary_.register_path(path_.c_str());
    temporary_.remove_contents();
  }
  ~WorkFolder() {
    std::error_code error;
    fs::remove_all(path_, error);
  }
  WorkFolder(const WorkFolder&) = delete;
  WorkFolder& operator=(const WorkFolder&) = delete;
  const fs::path& path() const { return path_; }

  void write(const char* name, const std::string& text) const {
    std::ofstream file(path_ / name, std::ios::binary);
    file << text;
    if (!file.flush())
      throw UserError(Exit::ReadWrite, {}, in_quotes((path_ / name).string()) + " could not be written");
  }

private:
  fs::path path_;
  TemporaryPath temporary_; // path_
};

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

[[noreturn]] void fail(const std::string& what) {
  throw UserError(Exit::ReadWrite, {}, "gmsh could not fill the surface: " + what, may_cross);
}

MeshFile checked(const fs::path& path, const ClosedSurface& surface, const std::string& said) {
  if (!fs::exists(path)) fail(errors_in(said));
  MeshFile file = [&] {
    try {
      return read_mesh(path);
    } catch (const UserError& error) {
      fail(std::string("what it wrote cannot be read: ") + error.what());
    }
  }();
  const auto* solid = std::get_if<CellMesh>(&file.mesh);
  if (!solid || solid->cells() == 0) fail("it made no tetrahedra. " + errors_in(said));
  if (const std::string flaw = flaw_of_filling(*solid, surface); !flaw.empty()) fail(flaw);
  file.groups.clear();
  return file;
}

} // namespace

std::optional<MeshFile> filled_by_gmsh(const ClosedSurface& surface, const FillSettings& settings) {
  const WorkFolder folder;
  folder.write("surface.msh", msh_text(surface));
  folder.write("fill.geo", script(settings.size));
  const auto outcome =
      run_outside_program({"gmsh", "fill.geo", "-3", "-format", "msh22", "-o", "solid.msh", "-v", "2"},
                          folder.path(), settings.most_seconds, settings.stop);
  if (!outcome)
    throw UserError(Exit::Usage, {}, "the program gmsh, which fills surfaces, is not installed",
                    "Debian has it in the package gmsh: apt-get install gmsh");
  if (outcome->end == ProgramOutcome::End::Asked) return {};
  if (outcome->end == ProgramOutcome::End::TimeLimit)
    throw UserError(Exit::OutOfBudget, {}, fmt::format("gmsh took longer than {:g} s", settings.most_seconds),
                    "take a larger --size, or a longer --max-time");
  if (outcome->code != 0) fail(fmt::format("exit code {}. {}", outcome->code, errors_in(outcome->said)));
  return checked(folder.path() / "solid.msh", surface, outcome->said);
}

} // namespace rend
