// rend render: pictures, and a video beside them.
#include "render/app/command.h"
#include "render/app/console.h"
#include "render/app/figures.h"
#include "render/app/film.h"
#include "render/app/output_folder.h"
#include "render/app/progress.h"
#include "render/app/session.h"
#include "render/png.h"
#include "render/video.h"
#include "render/video_format.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <filesystem>
#include <memory>

namespace rend {
namespace {

struct RenderOptions {
  SessionOptions session;
  std::string folder, frames, size, video; // empty: not given
  bool no_png = false, json = false;
};

PipelineOptions pipeline_options(const RenderOptions& options, const Session& session) {
  PipelineOptions out;
  const std::string& name = session.scene().name();
  out.folder = folder_for(options.folder, name);
  out.name = name;
  out.width = session.image().width;
  out.height = session.image().height;
  if (!options.size.empty()) {
    const PictureSize size = parse_size(options.size);
    out.width = size.width;
    out.height = size.height;
  }
  out.samples = session.image().samples;
  if (session.image().transparent && !options.video.empty())
    throw UserError(Exit::Usage, session.preset().child("image")->place("background"),
                    "a transparent background is for PNG files: videos have no alpha",
                    "leave --video out, or add --set image.background=#ffffff");
  out.fps = session.image().fps;
  out.png = !options.no_png;
  out.video = !options.video.empty();
  if (out.video) out.extension = "." + find_video_format(options.video)->name;
  return out;
}

std::string closing_words(const Film& film, const PipelineOptions& files, double seconds) {
  if (film.frames() == 0) return "no frame was written\n";
  std::string out = fmt::format("{} frame{}", film.frames(), film.frames() == 1 ? "" : "s");
  if (files.png) out += " in " + files.folder.string();
  if (files.video)
    out +=
        std::string(files.png ? ", and " : " in ") + (files.folder / (files.name + files.extension)).string();
  return out + fmt::format(", in {}\n", seconds_in_words(seconds));
}

Stopped shoot(Session& session, Film& film, long last) {
  Progress progress(session.quiet(), session.last_step(last), session.clock().time_of(last), last + 1);
  long frame = 0;
  Session::Calls calls;
  const auto tell = [&] { progress.update(session.scene().steps_done(), session.scene().time(), frame); };
  calls.frame = [&](long number) {
    film.take(number);
    frame = number + 1;
    tell();
  };
  calls.step = tell;
  const Stopped stopped = session.run(last, calls);
  if (stopped == Stopped::Unstable)
    film.abandon();
  else
    film.finish();
  return stopped;
}

// Before anything slow is done.
void check_output(const RenderOptions& options) {
  if (options.no_png && options.video.empty())
    throw UserError(Exit::Usage, {}, "--no-png without --video leaves nothing to write", "add --video mp4");
  if (!options.no_png) require_png();
  if (!options.video.empty()) require_video(options.video);
}

Exit render(const RenderOptions& options) {
  const double start = wall_clock();
  check_output(options);
  const FrameChoice choice = options.frames.empty() ? FrameChoice() : FrameChoice(options.frames);
  if (!options.size.empty()) parse_size(options.size);
  Session session(options.session);
  const long last = last_chosen(choice, session.clock());
  const PipelineOptions files = pipeline_options(options, session);
  Film film(session, files, choice);
  const Stopped stopped = shoot(session, film, last);
  const double total = wall_clock() - start;
  if (options.json) {
    nlohmann::ordered_json figures =
        figures_of(session, stopped, {total, film.picture_seconds(), film.seconds(), film.surface_bytes()});
    figures["frames"] = film.frames();
    print_result(figures.dump(2) + "\n");
  } else if (!session.quiet()) {
    print_result(closing_words(film, files, total));
  }
  return end_of(session, stopped);
}

std::string video_formats_in_words() {
  std::string out;
  for (const VideoFormat& format : video_formats())
    out += fmt::format("{}{} ({})", out.empty() ? "" : ", ", format.name, format.what);
  return out;
}

std::function<Exit()> declare(CLI::App& app) {
  auto options = std::make_shared<RenderOptions>();
  add_run_options(app, options->session);
  app.add_option("-o,--output", options->folder, "folder of the pictures; default: out/ and the scene's name")
      ->type_name("DIR");
  app.add_option("--frames", options->frames, "only these: 7, 0-100, 0-100x2, 10-, or several with commas")
      ->type_name("LIST");
  app.add_option("--size", options->size, "of the pictures in pixels, instead of the preset's")
      ->type_name("WxH");
  app.add_option("--video", options->video, "also a video, called as the scene is: " + video_formats_in_words())
      ->type_name("FORMAT");
  app.add_flag("--no-png", options->no_png, "the video alone");
  app.add_flag("--json", options->json, "the figures as one JSON object, instead of the closing words");
  return [options] { return render(*options); };
}

} // namespace

Command render_command() {
  return {"render", "simulate a preset and make pictures of it", declare};
}

} // namespace rend
