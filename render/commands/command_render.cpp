// rend render: pictures, and a video beside them.
#include "render/clip/clip_run.h"
#include "render/clip/figures.h"
#include "render/clip/frame_output.h"
#include "render/clip/named_files.h"
#include "render/clip/session.h"
#include "render/clip/shard.h"
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/console/json_text.h"
#include "render/console/number_option.h"
#include "render/console/signals.h"
#include "render/files/output_folder.h"
#include "render/files/png.h"
#include "render/files/video.h"
#include "render/files/video_format.h"
#include "render/help/usage.h"
#include "sim/base/printable.h"
#include "sim/base/wording.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <memory>

namespace rend {
namespace {

namespace fs = std::filesystem;

struct RenderOptions {
  SessionOptions session;
  std::string folder, frames, size, video; // empty: not given
  std::string shard;                       // i/n; empty: not given
  double checkpoint_every = ClipRunOptions{}.checkpoint_every;
  bool no_png = false, json = false, resume = false;
};

PipelineOptions pipeline_options(const RenderOptions& options, const Session& session) {
  PipelineOptions out;
  const std::string& name = session.scene().name();
  out.folder = folder_for(options.folder, name);
  out.name = name;
  out.width = session.image().width();
  out.height = session.image().height();
  if (!options.size.empty()) {
    const PictureSize size = parse_size(options.size);
    out.width = size.width;
    out.height = size.height;
  }
  out.samples = session.image().samples;
  out.transparent = session.image().transparent();
  if (out.transparent && !options.video.empty() && find_video_format(options.video)->alpha.empty())
    throw UserError(Exit::Usage, session.image().source.place("background"),
                    fmt::format("{} videos cannot have a transparent background", options.video),
                    fmt::format("formats that can: {}; or add --set image.background=#ffffff",
                                listed(transparent_format_names())));
  out.fps = session.image().fps;
  out.png = !options.no_png;
  out.video = !options.video.empty();
  if (out.video) out.extension = "." + find_video_format(options.video)->name;
  return out;
}

std::string closing_words(const ClipRun& clip_run, Stopped stopped, const PipelineOptions& files,
                          double seconds) {
  if (clip_run.frames_made() + clip_run.frames_kept() == 0) return "no frame was written\n";
  std::string out = fmt::format("{} frame{}", clip_run.frames_made(), clip_run.frames_made() == 1 ? "" : "s");
  if (files.png) out += " in " + printable(files.folder.string());
  const fs::path video = files.folder / (files.name + files.extension);
  if (files.video && stopped != Stopped::Interrupted)
    out += (files.png ? ", and " : " in ") + printable(video.string());
  else if (std::error_code error; files.video && fs::exists(partial_video(video), error))
    out += fmt::format("{} {}, a video that ends early", files.png ? ", and" : " in",
                       printable(partial_video(video).string()));
  if (const long kept = clip_run.frames_kept(); kept > 0)
    out += fmt::format("; {} {} already there", kept, kept == 1 ? "was" : "were");
  return out + fmt::format(", in {}\n", seconds_in_words(seconds));
}

// Reports errors before anything slow is done.
void check_output(const RenderOptions& options) {
  if (options.no_png && options.video.empty())
    throw UserError(Exit::Usage, {}, "--no-png without --video leaves nothing to write", "add --video mp4");
  if (!options.no_png) require_png();
  if (!options.video.empty()) require_video(options.video);
  if (!options.frames.empty()) FrameChoice{options.frames};
  if (!options.size.empty()) parse_size(options.size);
  if (!shard_for(options.shard).whole() && !options.video.empty())
    throw UserError(Exit::Usage, {}, "--shard makes some of the pictures, but a video needs all of them",
                    "leave out --video; when all parts are done, --shard 1/1 --resume --video " +
                        options.video + " makes the video");
}

ClipRunOptions clip_run_options(const RenderOptions& options, const Session& session) {
  ClipRunOptions out;
  out.files = pipeline_options(options, session);
  if (!options.frames.empty()) out.choice = FrameChoice(options.frames);
  out.shard = shard_for(options.shard);
  out.resume = options.resume;
  out.checkpoint_every = options.checkpoint_every;
  if (!out.shard.whole() && options.shard.empty() && !session.quiet())
    print_note(fmt::format(
        "this is a task of a Slurm array: it renders part {} of the frames (--shard 1/1: all of them)",
        out.shard.text()));
  return out;
}

// No input may be overwritten.
void check_files(const Session& session, const ClipRunOptions& options) {
  const PipelineOptions& out = options.files;
  NamedFiles files;
  files.reads("the preset", session.preset_path());
  files.reads_files(session.preset());
  if (out.video) files.writes("the video", out.folder / (out.name + out.extension));
  if (!out.png) return;
  files.writes("the stored state", checkpoint_path(out.folder, out.name, options.shard));
  files.writes_frames("a picture", out.folder, ".png", [&](long frame) {
    return frame < session.clock().frames() && options.choice.has(frame);
  });
}

void print_figures(const RenderOptions& options, const Session& session, const ClipRun& clip_run,
                   Stopped stopped, const PipelineOptions& files, double total) {
  if (options.json) {
    const FrameOutput& output = clip_run.output();
    Figures figures = figures_of(session, stopped,
                                 {total, output.picture_seconds(), output.seconds(), output.surface_bytes()});
    figures.simulated = clip_run.simulates();
    figures.pictures = PictureFigures{.made = clip_run.frames_made(), .kept = clip_run.frames_kept()};
    print_result(text_of(json_of(figures), 2) + "\n");
  } else if (!session.quiet()) {
    print_result(closing_words(clip_run, stopped, files, total));
  }
}

Exit render(const RenderOptions& options) {
  const double start = wall_clock();
  check_output(options);
  Session session(options.session);
  const ClipRunOptions wanted = clip_run_options(options, session);
  check_files(session, wanted);
  const GracefulStop graceful_stop; // a signal only ends the time loop; it is handled afterwards
  ClipRun clip_run(session, wanted);
  const Stopped stopped = clip_run.run();
  print_figures(options, session, clip_run, stopped, wanted.files, wall_clock() - start);
  const Exit end = exit_code_of(session, stopped);
  if (clip_run.left_checkpoint() && !session.quiet())
    print_note("to go on from here, repeat the command with --resume");
  return end;
}

std::string video_formats_in_words() {
  std::string out;
  for (const VideoFormat& format : video_formats())
    out += fmt::format("{}{} ({})", out.empty() ? "" : ", ", format.name, format.what);
  return out;
}

std::function<Exit()> declare_render(const CommandLine& app) {
  auto options = std::make_shared<RenderOptions>();
  add_run_options(app, options->session);
  app.add_option("-o,--output", options->folder, "folder for the pictures and the video; default: out/SCENE")
      .type_name("DIR");
  app.add_option("--frames", options->frames,
                 "render only these frames, such as 7, 0-100, 0-100x2 (every second), 10- (to the end), or "
                 "several separated by commas; the first and the last moment are both shown, so that 2 s at 30 "
                 "a second have frames 0 to 60")
      .type_name("LIST")
      .check(some_word());
  app.add_option("--size", options->size, "width and height of the pictures in pixels; default: the preset's")
      .type_name("WxH")
      .check(some_word());
  app.add_option("--video", options->video,
                 "also write SCENE.mp4 (or another format): " + video_formats_in_words())
      .type_name(choices(video_format_names()));
  app.add_flag("--no-png", options->no_png, "write no PNG files, only the video");
  app.add_flag("--resume", options->resume,
               "keep pictures that are complete, and go on from where an earlier run was stopped");
  app.add_option(
         "--shard", options->shard,
         "render only block I of N of the frames; default: the number of the Slurm array task, if there is one")
      .type_name("I/N")
      .check(some_word());
  app.add_option("--checkpoint-every", options->checkpoint_every,
                 "store the run's state for --resume every S seconds of real time; 0: only when the run is "
                 "stopped by a signal")
      .type_name("S")
      .transform(real_number(0, 1e9))
      .show_default();
  app.add_flag("--json", options->json, "print the results as one JSON object on stdout");
  return [options] { return render(*options); };
}

} // namespace

Command render_command() {
  return {"render", "simulate a preset and make pictures and a video of it", declare_render};
}

} // namespace rend
