// rend sheet: a contact sheet, one row a preset: how it starts, tears and ends; or the ends of many presets
// side by side.
#include "render/batch/batch_jobs.h"
#include "render/clip/named_files.h"
#include "render/clip/session.h"
#include "render/commands/command.h"
#include "render/commands/sheet_row.h"
#include "render/console/console.h"
#include "render/console/number_option.h"
#include "render/console/signals.h"
#include "render/draw/device.h"
#include "render/draw/hud.h"
#include "render/draw/renderer.h"
#include "render/files/output.h"
#include "render/files/png.h"
#include "render/picture/scene_preset.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"
#include "sim/preset/override.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <memory>
#include <span>

namespace rend {
namespace {

constexpr int gap = 6; // [pixels]

struct SheetOptions {
  SessionOptions session; // of each preset: without its name and its attributes
  std::vector<std::string> presets, sets, sweeps;
  std::string file, size;
  int ends = 0; // pictures in a row, of the ends of so many presets; 0: a row shows one preset at three moments
};

// Which pictures there are, and where each stands.
struct Layout {
  int columns, shown; // pictures in a row, and of a preset
  int rows;
  int column(std::size_t preset, int k) const { return shown == 1 ? static_cast<int>(preset) % columns : k; }
  int row(std::size_t preset) const { return static_cast<int>(preset) / (shown == 1 ? columns : 1); }
};
Layout layout_of(const SheetOptions& options, std::size_t scenes) {
  const int count = static_cast<int>(scenes);
  if (options.ends == 0) return {SheetRow::moments, SheetRow::moments, count};
  const int columns = std::min(options.ends, count);
  return {columns, 1, (count + columns - 1) / columns};
}

// A preset, or one with a choice of values of a sweep.
struct SheetScene {
  std::string preset;
  std::size_t number;             // of the preset, among those of the command line
  std::vector<std::string> sets;  // PATH=VALUE
  std::vector<std::string> swept; // the values of the sweep, likewise; empty: there is none
};

std::vector<SheetScene> scenes_of(const SheetOptions& options) {
  const BatchSettings settings = batch_settings(scene_type(), options.sets, options.sweeps);
  std::vector<SheetScene> scenes;
  for (std::size_t n = 0; n < options.presets.size(); ++n) {
    const std::string& preset = options.presets[n];
    load_scene(preset, {}); // a name that is wrong is told with those that are near
    for (const BatchJob& job : batch_jobs({preset}, settings.sweeps)) {
      SheetScene scene{preset, n, settings.sets, job.sets};
      scene.sets.insert(scene.sets.end(), job.sets.begin(), job.sets.end());
      scenes.push_back(std::move(scene));
    }
  }
  return scenes;
}

bool is_number(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

// "body.tear.threshold=2 N": the unit of a threshold follows from its criterion.
std::string with_unit(const std::string& set, const SheetRow& row) {
  const Override one = parse_override(set);
  if (!is_number(one.value)) return set;
  const std::string unit =
      one.path.ends_with(".threshold") ? row.threshold_unit() : overridden(scene_type(), one).unit;
  return unit.empty() ? set : set + " " + unit;
}

std::string tears_in_words(const SheetRow& row) {
  return fmt::format("{} tear{}", row.tears(), row.tears() == 1 ? "" : "s");
}

// "body.tear.threshold=2 N: 12 tears"
std::string label_of(const SheetScene& scene, const SheetRow& row) {
  std::vector<std::string> values;
  for (const std::string& set : scene.swept) values.push_back(with_unit(set, row));
  return fmt::format("{}: {}", fmt::join(values, "  "), tears_in_words(row));
}

// Copies `tile` into `sheet` with its upper left corner at (x, y).
void paste(const Image& tile, int x, int y, Image& sheet) {
  for (int r = 0; r < tile.height; ++r)
    std::copy_n(tile.row(r), tile.stride(), sheet.row(y + r) + 3 * static_cast<std::size_t>(x));
}

// What a picture shows, in its lower left corner, large enough to be read where the sheet is shown small.
void write_label(Frame& frame, const std::string& label) {
  if (!label.empty())
    frame.hud.lines.push_back({.text = printable(label), .x = 0.02F, .y = 0.92F, .large = true});
}

// What stands where, a line for each scene.
std::string line_of(const SheetScene& scene, const SheetRow& row, std::size_t n, const Layout& layout) {
  const std::string picture = layout.shown == 1 ? fmt::format(", picture {}", layout.column(n, 0) + 1) : "";
  const auto [start, middle, end] = row.times();
  const std::string times = layout.shown == 1
                                ? fmt::format("at {:.4g} s", end)
                                : fmt::format("at {:.4g}, {:.4g} and {:.4g} s", start, middle, end);
  return fmt::format("  row {}{}: {}{}{}, {}\n", layout.row(n) + 1, picture, printable(scene.preset),
                     scene.swept.empty() ? ": " : " ",
                     scene.swept.empty() ? tears_in_words(row) : printable(label_of(scene, row)), times);
}

// The pictures of a row, in their places.
void draw(const SheetScene& scene, const SheetRow& row, std::size_t n, const Layout& layout,
          const PictureSize& size, Image& sheet) {
  const auto device = make_device();
  Renderer renderer(size.width, size.height, row.samples());
  Hud hud(size.width, size.height);
  for (int k = 0; k < layout.shown; ++k) {
    Frame frame = row.shown(k);
    frame.transparent = false; // the sheet itself is opaque
    renderer.draw(frame);
    frame.hud = {};
    if (k == 0 && !scene.swept.empty()) write_label(frame, label_of(scene, row));
    if (!frame.hud.empty()) hud.draw(frame.hud);
    paste(renderer.read(), layout.column(n, k) * (size.width + gap), layout.row(n) * (size.height + gap),
          sheet);
  }
}

// Simulates those of one preset, and draws them; adds a line for each.
Exit add_rows(const SheetOptions& options, std::span<const SheetScene> scenes, std::size_t first,
              const Layout& layout, Image& sheet, std::string& lines) {
  const PictureSize size = parse_size(options.size);
  std::vector<SheetRow> rows;
  for (const SheetScene& scene : scenes) {
    SessionOptions one = options.session;
    one.preset = scene.preset;
    one.sets = scene.sets;
    rows.emplace_back(one, static_cast<double>(size.width) / size.height, layout.shown == 1);
    if (const Exit end = rows.back().run(); end != Exit::Done) return end;
  }
  if (layout.shown > 1)
    if (const Exit end = set_middles(rows); end != Exit::Done) return end;
  for (std::size_t n = 0; n < rows.size(); ++n) {
    draw(scenes[n], rows[n], first + n, layout, size, sheet);
    lines += line_of(scenes[n], rows[n], first + n, layout);
  }
  return Exit::Done;
}

Exit make_sheet(const SheetOptions& options) {
  require_png(); // before anything slow
  if (std::filesystem::path(options.file).extension() != ".png")
    throw UserError(Exit::Usage, {},
                    fmt::format("-o {}: a contact sheet is one PNG file", in_quotes(options.file)),
                    "give a name that ends in .png");
  const PictureSize size = parse_size(options.size);
  const std::filesystem::path file = resolve_link(options.file);
  NamedFiles files;
  files.writes("the contact sheet", file);
  const std::vector<SheetScene> scenes = scenes_of(options);
  for (const SheetScene& scene : scenes) {
    std::vector<Override> overrides;
    for (const std::string& set : scene.sets) overrides.push_back(parse_override(set));
    files.reads("the preset", scene.preset);
    files.reads_files(*load_scene(scene.preset, overrides)); // reports a bad preset before anything slow
  }
  const Layout layout = layout_of(options, scenes.size());
  Image sheet(layout.columns * (size.width + gap) - gap, layout.rows * (size.height + gap) - gap);
  std::fill(sheet.pixels.begin(), sheet.pixels.end(), std::uint8_t{255});
  std::string lines;
  for (std::size_t first = 0, end = 0; first < scenes.size(); first = end) {
    while (end < scenes.size() && scenes[end].number == scenes[first].number) ++end;
    const std::span<const SheetScene> of_preset(scenes.data() + first, end - first);
    if (const Exit code = add_rows(options, of_preset, first, layout, sheet, lines); code != Exit::Done)
      return code;
  }
  const GracefulStop graceful_stop;
  write_png(file, sheet);
  sync_folder(file.parent_path());
  if (!options.session.quiet)
    print_result(fmt::format("{}: {} row{} of {} picture{}\n", printable(options.file), layout.rows,
                             layout.rows == 1 ? "" : "s", layout.columns, layout.columns == 1 ? "" : "s") +
                 lines);
  return Exit::Done;
}

std::function<Exit()> declare_sheet(const CommandLine& app) {
  auto options = std::make_shared<SheetOptions>();
  app.add_option("presets", options->presets,
                 "presets; each makes one row of pictures (with --ends, one picture)")
      .required()
      .type_name("PRESET...");
  app.add_option("-o,--output", options->file, "file of the contact sheet (a file, not a folder)")
      .required()
      .type_name("FILE.png");
  app.add_option("--size", options->size, "width and height of each picture in pixels")
      .type_name("WxH")
      .check(some_word())
      .default_word("480x270");
  app.add_option("--ends", options->ends, "show only the end of each preset, N pictures in a row")
      .type_name("N")
      .transform(whole_number(1, 64));
  app.add_option(
         "--set", options->sets,
         "replace an attribute of each preset, such as time.step=1e-4 (can be repeated); several values "
         "separated by commas make one row each, unless the attribute is free text or an expression; their "
         "middle pictures are at one time, when the row that tears first has just torn")
      .type_name("PATH=VALUE")
      .allow_extra_args(false);
  app.add_option(
         "--sweep", options->sweeps,
         "make one row (with --ends, one picture) for each of these values of an attribute, free text "
         "included; 1:10:2 is the range from 1 to 10 in steps of 2; several sweeps make all combinations")
      .type_name("PATH=V,V,...")
      .allow_extra_args(false);
  app.add_option("--threads", options->session.threads, "number of threads; default: all that the machine has")
      .type_name("N")
      .transform(whole_number(1, 256));
  app.add_flag("-q,--quiet", options->session.quiet, "print no progress and no notes");
  return [options] { return make_sheet(*options); };
}

} // namespace

Command sheet_command() {
  return {"sheet", "make one picture that shows how presets start, tear and end", declare_sheet};
}

} // namespace rend
