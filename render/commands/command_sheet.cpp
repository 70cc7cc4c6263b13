// rend sheet: a contact sheet, one row a preset: how it starts, tears and ends; or the ends of many presets
// side by side.
#include "render/clip/named_files.h"
#include "render/clip/session.h"
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/console/number_option.h"
#include "render/console/progress.h"
#include "render/console/signals.h"
#include "render/draw/device.h"
#include "render/draw/renderer.h"
#include "render/files/output.h"
#include "render/files/png.h"
#include "render/picture/scene_picture.h"
#include "render/picture/scene_preset.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace rend {
namespace {

constexpr int moments = 3; // that are shown of a preset
constexpr int gap = 6;     // [pixels]

struct SheetOptions {
  SessionOptions session;
  std::vector<std::string> presets;
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
Layout layout_of(const SheetOptions& options) {
  const int presets = static_cast<int>(options.presets.size());
  if (options.ends == 0) return {moments, moments, presets};
  const int columns = std::min(options.ends, presets);
  return {columns, 1, (presets + columns - 1) / columns};
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
  for (const std::string& preset : options.presets) {
    files.reads("the preset", preset);
    files.reads_files(*load_scene(preset, {})); // reports a bad preset before anything slow
  }
  const Layout layout = layout_of(options);
  Image sheet(layout.columns * (size.width + gap) - gap, layout.rows * (size.height + gap) - gap);
  std::fill(sheet.pixels.begin(), sheet.pixels.end(), std::uint8_t{255});
  for (std::size_t n = 0; n < options.presets.size(); ++n) {
    SessionOptions one = options.session;
    one.preset = options.presets[n];
    Session session(one);
    Row row(session.clock().frames(), layout.shown == 1);
    const Exit end = run(session, static_cast<double>(size.width) / size.height, row);
    if (end != Exit::Done) return end;
    const auto device = make_device();
    Renderer renderer(size.width, size.height, session.image().samples);
    for (int k = 0; k < layout.shown; ++k) {
      Frame frame = row.shown(k);
      frame.transparent = false; // the sheet itself is opaque
      renderer.draw(frame);
      paste(renderer.read(), layout.column(n, k) * (size.width + gap), layout.row(n) * (size.height + gap),
            sheet);
    }
  }
  const GracefulStop graceful_stop;
  write_png(file, sheet);
  sync_folder(file.parent_path());
  if (!options.session.quiet)
    print_result(fmt::format("{}: {} row{} of {} picture{}\n", printable(options.file), layout.rows,
                             layout.rows == 1 ? "" : "s", layout.columns, layout.columns == 1 ? "" : "s"));
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
      ->transform(whole_number(1, 64));
  app.add_option("--set", options->session.sets,
                 "replace an attribute of each preset, such as time.step=1e-4 (can be repeated)")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  app.add_option("--threads", options->session.threads,
                 "number of threads; default: as many as the machine has")
      ->transform(whole_number(1, 256));
  app.add_flag("-q,--quiet", options->session.quiet, "print no progress and no notes");
  return [options] { return make_sheet(*options); };
}

} // namespace

Command sheet_command() {
  return {"sheet", "make one picture that shows how presets start, tear and end", declare_sheet};
}

} // namespace rend
