// rend mesh: facts about a mesh file, its conversion to another format, and solids from closed surfaces.
#include "render/clip/named_files.h"
#include "render/commands/command.h"
#include "render/commands/gmsh.h"
#include "render/console/console.h"
#include "render/console/json_text.h"
#include "render/console/number_option.h"
#include "render/console/signals.h"
#include "render/console/time_limit.h"
#include "render/facts/mesh_facts.h"
#include "render/files/output.h"
#include "sim/base/wording.h"
#include "sim/mesh/moka.h"
#include "sim/mesh/msh_writer.h"
#include "sim/mesh/repair.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>
#include <tuple>

namespace rend {
namespace {

namespace fs = std::filesystem;

struct MeshOptions {
  std::string in, out;
  bool json = false, repair = false;
  double size = 0;           // [m], of a tetrahedron
  double most_seconds = 600; // for filling
};

Exit info(const MeshOptions& options) {
  const MeshFacts facts = mesh_facts(sew(read_mesh(std::filesystem::path(options.in))), options.in);
  // A file may call its groups by any bytes.
  print_result(options.json ? text_of(json_of(facts), 2) + "\n" : facts_in_words(facts));
  return Exit::Done;
}

// UserError (Usage): the ending of its name is that of no format.
void check_format(const std::string& name) {
  const fs::path extension = fs::path(name).extension();
  if (extension != ".moka" && extension != ".msh")
    throw UserError(Exit::Usage, {},
                    fmt::format("{}: its ending names no format that rend can write", in_quotes(name)),
                    "end the name in .moka or .msh");
}

// What a file of this text would be, with the name that the options give it.
MeshFacts facts_of_text(const std::string& text, const MeshOptions& options) {
  try {
    return mesh_facts(sew(read_mesh(MeshSource(options.out, text))), options.out);
  } catch (const UserError& error) {
    throw UserError(Exit::BadInput, {options.in},
                    fmt::format("rend cannot read what it would be converted to: {}", error.what()),
                    error.hint);
  }
}

// UserError: who reads the file would get another mesh.
void check_reads_back(const MeshBody& body, const std::string& text, const MeshOptions& options, bool groups) {
  const MeshFacts ours = mesh_facts(body, options.in), theirs = facts_of_text(text, options);
  const auto cells = [](const MeshFacts& facts) {
    const CellCounts& c = facts.counts;
    return std::tuple(facts.dimension, facts.elements, c.vertices, c.edges, c.faces, c.volumes, c.fragments);
  };
  if (cells(ours) != cells(theirs))
    throw UserError(Exit::BadInput, {options.in},
                    fmt::format("{} would not hold the same cells", in_quotes(options.out)),
                    "write it in the other format: .msh or .moka");
  if (groups && ours.groups != theirs.groups)
    throw UserError(Exit::BadInput, {options.in},
                    fmt::format("{} would not hold the same groups", in_quotes(options.out)),
                    "give each group a name of its own, of letters, digits, - and _");
}

// As the options name it; `file`: where that leads.
void write(const MeshBody& body, const MeshOptions& options, const fs::path& file) {
  const bool moka = fs::path(options.out).extension() == ".moka";
  if (moka && !body.groups.empty()) print_note("the groups of the mesh were left out: .moka cannot hold them");
  if (moka && body.map->dimension() == 2 && is_solid_in_moka(body.map->map()))
    throw UserError(Exit::BadInput, {options.in},
                    "a sheet without a border would be a solid in .moka, which cannot tell the two apart",
                    "write it as .msh; `rend mesh fill` makes a solid of it");
  const std::string text = moka ? moka_text(*body.map) : msh_text(body, options.in);
  check_reads_back(body, text, options, !moka);
  write_atomically(file, text);
  sync_folder(file.parent_path());
}

Exit convert(const MeshOptions& options) {
  check_format(options.out);
  const fs::path file = resolve_link(options.out);
  NamedFiles files;
  files.reads("the mesh", options.in);
  files.writes("the new one", file);
  MeshFile read = read_mesh(fs::path(options.in));
  if (options.repair) print_note(in_words(repair(read)));
  const MeshBody body = sew(std::move(read));
  for (const std::string& note : body.notes) print_note(note);
  const GracefulStop graceful_stop;
  write(body, options, file);
  return Exit::Done;
}

Exit fill(const MeshOptions& options) {
  check_format(options.out);
  const fs::path file = resolve_link(options.out);
  NamedFiles files;
  files.reads("the surface", options.in);
  files.writes("the solid", file);
  const TimeLimit limit(options.most_seconds, "filling the surface",
                        "take a larger --size, or a longer --max-time");
  ClosedSurface surface = closed_surface(read_mesh(fs::path(options.in)));
  check_cells_to_fill(surface, options.size);
  divide_edges(surface, 1.5 * options.size);
  const GracefulStop graceful_stop;
  limit.check();
  auto filled = filled_by_gmsh(surface, {options.in, options.size, limit, [] { return stop_signal() != 0; }});
  if (!filled) return exit_code_of_signal();
  const MeshBody body = sew(std::move(*filled));
  print_note(fmt::format("{} tetrahedra, {:.6g} m3", count_cells(body.map->map()).volumes, surface.volume()));
  print_note(slivers_in_words(*body.map));
  write(body, options, file);
  return Exit::Done;
}

std::function<Exit()> declare_mesh(const CommandLine& app) {
  auto options = std::make_shared<MeshOptions>();
  auto chosen = std::make_shared<Exit (*)(const MeshOptions&)>(nullptr);
  app.require_command();
  const CommandLine tell = app.add_command("info", "show the cells, sizes and groups of a mesh");
  tell.add_option("file", options->in, "a mesh: .msh, .obj, .off or .moka").required().type_name("FILE");
  tell.add_flag("--json", options->json, "print the same as one JSON object on stdout");
  tell.on_parsed([chosen] { *chosen = info; });
  const CommandLine change = app.add_command("convert", "convert a mesh to .moka, or to .msh 2.2");
  change.add_option("in", options->in, "a mesh: .msh, .obj, .off or .moka").required().type_name("IN");
  change.add_option("out", options->out, "the file to write, .moka or .msh: its ending tells the format")
      .required()
      .type_name("OUT");
  change.add_flag(
      "--repair", options->repair,
      "of a sheet: merge corners at the same point, drop polygons without area and copies of others");
  change.on_parsed([chosen] { *chosen = convert; });
  const CommandLine full =
      app.add_command("fill", "fill a closed surface with tetrahedra, by the program gmsh");
  full.add_option("file", options->in, "a closed surface: .obj, .off or .msh").required().type_name("FILE");
  full.add_option("--size", options->size, "length of the edges of tetrahedra, about [m]")
      .required()
      .transform(real_number(1e-9, 1e9))
      .type_name("METRES");
  full.add_option("-o,--output", options->out, "the file to write: .msh or .moka").required().type_name("FILE");
  full.add_option("--max-time", options->most_seconds,
                  "give up after so many seconds, with all that the command does")
      .transform(real_number(0, 1e9))
      .show_default()
      .type_name("SECONDS");
  full.on_parsed([chosen] { *chosen = fill; });
  return [options, chosen] { return (*chosen)(*options); };
}

} // namespace

Command mesh_command() {
  return {"mesh", "show what is in a mesh file, convert it, or fill a surface", declare_mesh};
}

} // namespace rend
