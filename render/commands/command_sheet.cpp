// rend sheet: a contact sheet, one row a preset: how it starts, tears and ends; or the ends of many presets
// side by side.
#include "render/batch/batch_jobs.h"
#include "render/clip/named_files.h"
#include "render/clip/session.h"
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/console/number_option.h"
#include "render/console/progress.h"
#include "render/console/signals.h"
#include "render/draw/device.h"
#include "render/draw/hud.h"
#include "render/draw/renderer.h"
#include "render/files/output.h"
#include "render/files/png.h"
#include "render/picture/scene_picture.h"
#include "render/picture/scene_preset.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"
#include "sim/preset/override.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

namespace rend {
namespace {

constexpr int moments = 3; // that are shown of a preset
constexpr int gap = 6;     // [pixels]

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
  if (options.ends == 0) return {moments, moments, count};
  const int columns = std::min(options.ends, count);
  return {columns, 1, (count + columns - 1) / columns};
}

// A preset, or one with a choice of values of a sweep.
struct SheetScene {
  std::string preset;
  std::vector<std::string> sets; // PATH=VALUE
  std::string label;             // the values of the sweep; empty: there is none
};

std::vector<SheetScene> scenes_of(const SheetOptions& options) {
  const BatchSettings settings = batch_settings(scene_type(), options.sets, options.sweeps);
  std::vector<SheetScene> scenes;
  for (const std::string& preset : options.presets) {
    load_scene(preset, {}); // a name that is wrong is told with those that are near
    for (const BatchJob& job : batch_jobs({preset}, settings.sweeps)) {
      SheetScene scene{preset, settings.sets, fmt::format("{}", fmt::join(job.sets, "  "))};
      scene.sets.insert(scene.sets.end(), job.sets.begin(), job.sets.end());
      scenes.push_back(std::move(scene));
    }
  }
  return scenes;
}

// The three frames of a row, chosen while the clip runs: the first; the one a twentieth of the clip after the
// first tear (the middle one if nothing has torn by then); the last.
class Row {
public:
  Row(long frames, bool end_alone)
      : end_alone_(end_alone), middle_(frames / 2), last_(frames - 1), lag_(frames / 20) {}

  bool wants(long frame, bool torn) {
    if (end_alone_) return frame == last_;
    if (torn && !tear_) tear_ = std::min(frame + lag_, last_);
    return frame == 0 || frame == last_ || frame == middle_ || frame == tear_;
  }
  void put(long frame, const Frame& picture) {
    if (frame == 0) frames_[0] = picture;
    if (frame == (tear_ ? *tear_ : middle_)) frames_[1] = picture;
    if (frame == last_) frames_[2] = picture;
  }
  // The k-th of those that are shown.
  const Frame& shown(int k) const { return frames_[static_cast<std::size_t>(end_alone_ ? moments - 1 : k)]; }

private:
  bool end_alone_;
  long middle_, last_, lag_;
  std::optional<long> tear_;
  std::array<Frame, moments> frames_;
};

Exit run(Session& session, double aspect, Row& row) {
  FrameBuilder maker(session.picture(), session.scene(), aspect, session.clock().duration(),
                     session.clock().frames());
  const long last = session.clock().frames() - 1;
  const GracefulStop graceful_stop; // a signal only ends the time loop; it is handled afterwards
  Progress progress(session.quiet(), session.last_step(last), session.clock().duration(), 0);
  Session::Callbacks calls;
  calls.frame = [&](long frame) {
    maker.observe();
    if (row.wants(frame, session.scene().tears() > 0))
      row.put(frame, maker.draw(frame, session.clock().time_of(frame)));
  };
  calls.step = [&] { progress.update(session.scene().steps_done(), session.scene().time(), 0); };
  return exit_code_of(session, session.run(last, calls));
}

// Copies `tile` into `sheet` with its upper left corner at (x, y).
void paste(const Image& tile, int x, int y, Image& sheet) {
  for (int r = 0; r < tile.height; ++r)
    std::copy_n(tile.row(r), tile.stride(), sheet.row(y + r) + 3 * static_cast<std::size_t>(x));
}

// What a picture shows, in its lower left corner.
void write_label(Frame& frame, const std::string& label) {
  if (!label.empty()) frame.hud.lines.push_back({.text = printable(label), .x = 0.02F, .y = 0.93F});
}

// The scenes of the sheet as lines, where they are told apart by values.
std::string list_of(const std::vector<SheetScene>& scenes, const Layout& layout) {
  std::string out;
  for (std::size_t n = 0; n < scenes.size(); ++n)
    if (!scenes[n].label.empty())
      out += fmt::format("  row {}{}: {} {}\n", layout.row(n) + 1,
                         layout.shown == 1 ? fmt::format(", picture {}", layout.column(n, 0) + 1) : "",
                         printable(scenes[n].preset), printable(scenes[n].label));
  return out;
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
  for (std::size_t n = 0; n < scenes.size(); ++n) {
    SessionOptions one = options.session;
    one.preset = scenes[n].preset;
    one.sets = scenes[n].sets;
    Session session(one);
    Row row(session.clock().frames(), layout.shown == 1);
    const Exit end = run(session, static_cast<double>(size.width) / size.height, row);
    if (end != Exit::Done) return end;
    const auto device = make_device();
    Renderer renderer(size.width, size.height, session.image().samples);
    Hud hud(size.width, size.height);
    for (int k = 0; k < layout.shown; ++k) {
      Frame frame = row.shown(k);
      frame.transparent = false; // the sheet itself is opaque
      renderer.draw(frame);
      frame.hud = {};
      if (k == 0) write_label(frame, scenes[n].label);
      if (!frame.hud.empty()) hud.draw(frame.hud);
      paste(renderer.read(), layout.column(n, k) * (size.width + gap), layout.row(n) * (size.height + gap),
            sheet);
    }
  }
  const GracefulStop graceful_stop;
  write_png(file, sheet);
  sync_folder(file.parent_path());
  if (!options.session.quiet)
    print_result(fmt::format("{}: {} row{} of {} picture{}\n", printable(options.file), layout.rows,
                             layout.rows == 1 ? "" : "s", layout.columns, layout.columns == 1 ? "" : "s") +
                 list_of(scenes, layout));
  return Exit::Done;
}

std::function<Exit()> declare_sheet(CLI::App& app) {
  auto options = std::make_shared<SheetOptions>();
  app.add_option("presets", options->presets,
                 "presets; each makes one row of pictures (with --ends, one picture)")
      ->required()
      ->type_name("PRESET...");
  app.add_option("-o,--output", options->file, "file of the contact sheet (a file, not a folder)")
      ->required()
      ->type_name("FILE.png");
  app.add_option("--size", options->size, "width and height of each picture in pixels")
      ->type_name("WxH")
      ->check(some_word())
      ->default_val("480x270");
  app.add_option("--ends", options->ends, "show only the end of each preset, N pictures in a row")
      ->type_name("N")
      ->transform(whole_number(1, 64));
  app.add_option(
         "--set", options->sets,
         "replace an attribute of each preset, such as time.step=1e-4 (can be repeated); several values "
         "separated by commas make one row each, unless the attribute is free text")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  app.add_option(
         "--sweep", options->sweeps,
         "make one row (with --ends, one picture) for each of these values of an attribute, free text "
         "included; 1:10:2 is the range from 1 to 10 in steps of 2; several sweeps make all combinations")
      ->type_name("PATH=V,V,...")
      ->allow_extra_args(false);
  app.add_option("--threads", options->session.threads, "number of threads; default: all that the machine has")
      ->type_name("N")
      ->transform(whole_number(1, 256));
  app.add_flag("-q,--quiet", options->session.quiet, "print no progress and no notes");
  return [options] { return make_sheet(*options); };
}

} // namespace

Command sheet_command() {
  return {"sheet", "make one picture that shows how presets start, tear and end", declare_sheet};
}

} // namespace rend
