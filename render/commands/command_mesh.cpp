// rend mesh: facts about a mesh file, and its conversion to another format.
#include "render/clip/named_files.h"
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/console/json_text.h"
#include "render/console/signals.h"
#include "render/facts/mesh_facts.h"
#include "render/files/output.h"
#include "sim/base/wording.h"
#include "sim/mesh/moka.h"
#include "sim/mesh/msh_writer.h"
#include "sim/mesh/repair.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <memory>

namespace rend {
namespace {

struct MeshOptions {
  std::string in, out;
  bool json = false, repair = false;
};

Exit info(const MeshOptions& options) {
  const MeshFacts facts = mesh_facts(sew(read_mesh(std::filesystem::path(options.in))), options.in);
  // A file may call its groups by any bytes.
  print_result(options.json ? text_of(json_of(facts), 2) + "\n" : facts_in_words(facts));
  return Exit::Done;
}

Exit convert(const MeshOptions& options) {
  const std::filesystem::path out = options.out;
  const bool moka = out.extension() == ".moka";
  if (!moka && out.extension() != ".msh")
    throw UserError(Exit::Usage, {},
                    fmt::format("{} is not a format that rend can write", in_quotes(options.out)),
                    "end the name in .moka or .msh");
  const std::filesystem::path file = resolve_link(out);
  NamedFiles files;
  files.reads("the mesh", options.in);
  files.writes("the new one", file);
  MeshFile read = read_mesh(std::filesystem::path(options.in));
  if (options.repair) print_note(in_words(repair(read)));
  const MeshBody body = sew(std::move(read));
  for (const std::string& note : body.notes) print_note(note);
  if (moka && !body.groups.empty()) print_note("the groups of the mesh were left out: .moka cannot hold them");
  const std::string text = moka ? moka_text(*body.map) : msh_text(body, options.in);
  const GracefulStop graceful_stop;
  write_atomically(file, text);
  sync_folder(file.parent_path());
  return Exit::Done;
}

std::function<Exit()> declare_mesh(CLI::App& app) {
  auto options = std::make_shared<MeshOptions>();
  auto chosen = std::make_shared<Exit (*)(const MeshOptions&)>(nullptr);
  app.require_subcommand(1);
  CLI::App* tell = app.add_subcommand("info", "show the cells, sizes and groups of a mesh");
  tell->add_option("file", options->in, "a mesh")->required()->type_name("FILE");
  tell->add_flag("--json", options->json, "print the same as one JSON object on stdout");
  tell->callback([chosen] { *chosen = info; });
  CLI::App* change = app.add_subcommand("convert", "convert a mesh to .moka, or to .msh 2.2");
  change->add_option("in", options->in, "a mesh")->required()->type_name("IN");
  change->add_option("out", options->out, "the file to write; its ending tells the format")
      ->required()
      ->type_name("OUT");
  change->add_flag(
      "--repair", options->repair,
      "of a sheet: merge corners at the same point, drop polygons without area and copies of others");
  change->callback([chosen] { *chosen = convert; });
  return [options, chosen] { return (*chosen)(*options); };
}

} // namespace

Command mesh_command() {
  return {"mesh", "show what is in a mesh file, or convert it", declare_mesh};
}

} // namespace rend
