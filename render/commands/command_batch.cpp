// rend batch: many presets in parallel.
#include "render/batch/available_memory.h"
#include "render/clip/frame_clock.h"
#include "render/clip/named_files.h"
#include "render/clip/session.h"
#include "render/clip/shard.h"
#include "render/commands/batch_run.h"
#include "render/commands/command.h"
#include "render/console/console.h"
#include "render/console/number_option.h"
#include "render/console/signals.h"
#include "render/files/output.h"
#include "render/files/output_folder.h"
#include "render/files/png.h"
#include "render/files/video.h"
#include "render/files/video_format.h"
#include "render/help/usage.h"
#include "render/pages/batch_page.h"
#include "render/pages/batch_parts.h"
#include "render/pages/batch_table.h"
#include "render/picture/scene_preset.h"
#include "sim/base/printable.h"
#include "sim/base/threads.h"
#include "sim/base/wording.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <memory>

namespace rend {
namespace {

namespace fs = std::filesystem;

struct BatchOptions {
  std::vector<std::string> inputs, sets, sweeps;
  std::string folder = "out/batch", shard, memory;
  std::string frames, size, fps, video, checkpoint_every;
  int jobs = 0, threads = 0; // 0: not given
  bool run = false;          // no pictures: figures alone
  bool no_png = false, allow_path = false, resume = false, json = false, quiet = false;
};

// "800M", "4G", "1.5G": bytes.
std::size_t parse_memory(const std::string& text) {
  const std::string units = "kMG";
  constexpr double most = 1e18; // [bytes], within what a size_t holds
  double bytes = 0;
  const char* const end = text.data() + text.size();
  const auto [after, error] = std::from_chars(text.data(), end, bytes, std::chars_format::fixed);
  const std::size_t unit = after + 1 == end ? units.find(*after) : std::string::npos;
  const bool whole = error == std::errc() && (after == end || unit != std::string::npos);
  for (std::size_t n = 0; unit != std::string::npos && n <= unit; ++n) bytes *= 1024;
  if (!whole || !(bytes >= 1 && bytes <= most)) // also refuses nan
    throw UserError(Exit::Usage, {}, fmt::format("--memory {} is not an amount of memory", in_quotes(text)),
                    "write it as 800M or 4G");
  return static_cast<std::size_t>(bytes);
}

BatchLimits limits_of(const BatchOptions& options) {
  BatchLimits limits;
  limits.jobs = options.jobs > 0 ? options.jobs : hardware_threads();
  limits.memory = options.memory.empty() ? available_memory() / 10 * 8 : parse_memory(options.memory);
  return limits;
}

// The jobs of this shard. With fewer jobs than shards every shard takes all jobs, and makes its part of their
// frames; without frames, some shards have nothing to do.
std::vector<BatchJob> jobs_of(const BatchOptions& options, const std::vector<BatchJob>& all, const Shard& shard,
                              bool& frames_are_shared) {
  frames_are_shared = !options.run && !shard.whole() && static_cast<long>(all.size()) < shard.count;
  if (frames_are_shared) return all;
  std::vector<BatchJob> ours;
  for (std::size_t n = 0; n < all.size(); ++n)
    if (static_cast<long>(n) % shard.count == shard.number - 1) ours.push_back(all[n]);
  return ours;
}

std::vector<std::string> arguments_of(const BatchOptions& options, const BatchSettings& settings,
                                      const BatchLimits& limits, const BatchJob& job, const Shard& frames,
                                      bool resume) {
  std::vector<std::string> words{options.run ? "run" : "render", job.preset, "--json"};
  if (!options.run)
    words.insert(words.end(), {"-o", (fs::path(options.folder) / job.name).string(), "--shard", frames.text()});
  const auto pass = [&](const char* name, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {name, value});
  };
  for (const std::string& set : settings.sets) pass("--set", set);
  for (const std::string& set : job.sets) pass("--set", set);
  pass("--frames", options.frames);
  pass("--size", options.size);
  pass("--fps", options.fps);
  pass("--video", options.video);
  pass("--checkpoint-every", options.checkpoint_every);
  const int threads = options.threads > 0 ? options.threads : limits.jobs > 1 ? 1 : 0;
  if (threads > 0) pass("--threads", std::to_string(threads));
  if (options.no_png) words.emplace_back("--no-png");
  if (options.allow_path) words.emplace_back("--allow-path");
  if (resume && !options.run) words.emplace_back("--resume");
  return words;
}

// --resume is no mistake: presets/slurm always gives it.
void check_run(const BatchOptions& options) {
  const std::pair<const char*, bool> pictures[]{{"--frames", !options.frames.empty()},
                                                {"--size", !options.size.empty()},
                                                {"--video", !options.video.empty()},
                                                {"--no-png", options.no_png},
                                                {"--checkpoint-every", !options.checkpoint_every.empty()}};
  for (const auto& [name, given] : pictures)
    if (given)
      throw UserError(Exit::Usage, {}, fmt::format("{} is for pictures, and --run makes none", name),
                      fmt::format("leave out {} or --run", name));
}

// Errors that every job would report are reported once, before any job starts.
void check(const BatchOptions& options) {
  if (options.run) return check_run(options);
  if (!options.frames.empty()) FrameChoice{options.frames};
  if (!options.size.empty()) parse_size(options.size);
  if (!options.video.empty()) require_video(options.video);
  if (!options.no_png) require_png();
  if (options.no_png && options.video.empty())
    throw UserError(Exit::Usage, {}, "--no-png without --video leaves nothing to write", "add --video mp4");
}

std::string closing_words(const BatchReport& report, const fs::path& page) {
  std::size_t done = 0;
  for (const BatchResult& result : report.results) done += result.done();
  std::string out = fmt::format("{} of {} job{} done, in {}; see {}\n", done, report.jobs.size(),
                                report.jobs.size() == 1 ? "" : "s", seconds_in_words(report.seconds),
                                printable(page.string()));
  for (std::size_t n = 0; n < report.jobs.size(); ++n) {
    const BatchResult& result = report.results[n];
    if (!result.failed()) continue;
    const std::string why = result.message.empty() ? "it printed no error" : result.message;
    out += printable(fmt::format("{}: {}: {}", name_of(result.state()), report.jobs[n].name, why)) + "\n";
  }
  return out;
}

Exit exit_code_of(const BatchReport& report) {
  if (stop_signal() != 0) return exit_code_of_signal();
  const bool all = std::all_of(report.results.begin(), report.results.end(),
                               [](const BatchResult& result) { return result.done(); });
  return all ? Exit::Done : Exit::CheckFailed;
}

void write_report(const BatchReport& report, const std::string& name) {
  write_atomically(report.folder / (name + ".html"), batch_page(report, name));
  if (report.runs) write_atomically(report.folder / csv_name(name), batch_csv(report));
}

// All that tells what the jobs make, besides their presets.
std::string key_of(const BatchOptions& options, const std::vector<BatchJob>& all) {
  std::vector<std::string> settings = options.sets;
  settings.insert(settings.end(), {options.frames, options.size, options.fps, options.video,
                                   options.run ? "run" : "render", options.no_png ? "no PNG" : "PNG"});
  return batch_key(all, settings);
}

// Results of the jobs that need not run again, one per job; without --resume, what is there of them is removed.
std::vector<std::optional<BatchResult>> kept_of(const BatchOptions& options, const std::vector<BatchJob>& jobs,
                                                const Shard& shard, const KeptResults& kept) {
  std::vector<std::optional<BatchResult>> there(jobs.size());
  if (!options.run) return there;
  if (!options.resume && shard.whole()) kept.remove_all();
  for (std::size_t n = 0; n < jobs.size(); ++n)
    if (options.resume)
      there[n] = kept.find(jobs[n]);
    else
      kept.remove(jobs[n]);
  const auto count = std::count_if(there.begin(), there.end(), [](const auto& one) { return one.has_value(); });
  if (count > 0 && !options.quiet)
    print_note(
        fmt::format("{} of {} jobs have their results already, and do not run again", count, jobs.size()));
  return there;
}

// With the rows of earlier batches into the same folder, which --resume keeps.
BatchReport with_others(BatchReport report, const BatchOptions& options, const Shard& shard,
                        const KeptResults& kept) {
  if (!options.run || !options.resume || !shard.whole()) return report;
  for (auto& [job, result] : kept.others(report.jobs)) {
    report.jobs.push_back(std::move(job));
    report.results.push_back(std::move(result));
  }
  return report;
}

// What changes the figures of all jobs.
std::vector<std::string> run_settings(const BatchOptions& options, const BatchSettings& settings) {
  std::vector<std::string> all = settings.sets;
  all.push_back("--fps " + options.fps);
  return all;
}

void write_parts(const BatchOptions& options, const BatchReport& report, const std::vector<BatchJob>& all,
                 const Shard& shard) {
  const std::string key = key_of(options, all);
  write_part(report, shard, key);
  auto whole = whole_batch(options.folder, all, shard.count, key);
  if (!whole) return;
  whole->runs = options.run;
  write_report(*whole, "index");
  if (!options.quiet)
    print_note(fmt::format("all {} parts are done; the page of all is {}", shard.count,
                           in_quotes((fs::path(options.folder) / "index.html").string())));
}

Exit batch(const BatchOptions& options) {
  const double start = wall_clock();
  check(options);
  const BatchSettings settings = batch_settings(scene_type(), options.sets, options.sweeps);
  const Shard shard = shard_for(options.shard);
  const std::vector<BatchJob> all = batch_jobs(options.inputs, settings.sweeps);
  bool frames_are_shared = false;
  BatchReport report{.folder = options.folder,
                     .jobs = jobs_of(options, all, shard, frames_are_shared),
                     .results = {},
                     .limits = limits_of(options),
                     .runs = options.run};
  if (frames_are_shared && !options.video.empty())
    throw UserError(
        Exit::Usage, {},
        "there are fewer jobs than parts (--shard), so each part makes some frames of each job, and no video",
        "use at most as many parts as jobs, or leave out --video");
  const Shard frames = frames_are_shared ? shard : Shard{};
  const std::string name = shard.whole() ? "index" : fmt::format("index.{}-of-{}", shard.number, shard.count);
  const fs::path page = fs::path(options.folder) / (name + ".html");
  NamedFiles files; // each job checks its own files
  files.writes("the page", page);
  for (const BatchJob& job : report.jobs) files.reads("the preset", job.preset);
  const OutputFolder folder(options.folder);
  const GracefulStop graceful_stop;
  folder.make();
  if (!shard.whole()) remove_part(options.folder, shard);
  const KeptResults kept(options.folder, run_settings(options, settings));
  BatchRun run(report, options.run ? &kept : nullptr,
               {.json = options.json, .quiet = options.quiet, .warns_of_memory = !options.memory.empty()},
               kept_of(options, report.jobs, shard, kept));
  run.run([&](const BatchJob& job, bool again) {
    return arguments_of(options, settings, report.limits, job, frames, options.resume || again);
  });
  report.seconds = wall_clock() - start;
  write_report(with_others(report, options, shard, kept), name);
  if (!shard.whole()) write_parts(options, report, all, shard);
  folder.sync();
  if (!options.json) print_result(closing_words(report, page));
  return exit_code_of(report);
}

void declare_passed_on(const CommandLine& app, BatchOptions& options) {
  app.add_option("--frames", options.frames,
                 "render only these frames, such as 7, 0-100, 0-100x5 (every fifth), 10- (to the end), or "
                 "several separated by commas")
      .type_name("LIST")
      .check(some_word());
  app.add_option("--size", options.size, "width and height of the pictures in pixels; default: the presets'")
      .type_name("WxH")
      .check(some_word());
  app.add_option("--fps", options.fps, "frames per second of the clip; default: the presets'")
      .type_name("N")
      .transform(real_number(1e-6, 1e6));
  app.add_option("--video", options.video, "also write a video of each job")
      .type_name(choices(video_format_names()));
  app.add_flag("--no-png", options.no_png, "write no PNG files, only the video");
  app.add_option("--threads", options.threads,
                 "threads of each job; default: 1, or with --jobs 1 all that the machine has")
      .type_name("N")
      .transform(whole_number(1, 256));
  app.add_option("--checkpoint-every", options.checkpoint_every,
                 "seconds between stored states, as for rend render")
      .type_name("S")
      .transform(real_number(0, 1e9));
  app.add_flag("--allow-path", options.allow_path,
               "allow presets to name meshes, rules and pictures outside of their folders");
}

std::function<Exit()> declare_batch(const CommandLine& app) {
  auto options = std::make_shared<BatchOptions>();
  app.add_option("inputs", options->inputs, "presets, and folders with presets")
      .required()
      .type_name("PRESET...");
  app.add_flag("--run", options->run,
               "make no pictures: simulate as rend run does, and write the figures of all jobs to figures.csv");
  app.add_option("-o,--output", options->folder,
                 "folder for the page index.html, one folder per job, and logs/")
      .type_name("DIR")
      .show_default();
  app.add_option("--set", options->sets,
                 "replace an attribute in all jobs (can be repeated); several values separated by commas make "
                 "one job each, unless the attribute is free text or an expression")
      .type_name("PATH=VALUE")
      .allow_extra_args(false);
  app.add_option(
         "--sweep", options->sweeps,
         "make one job for each of these values of an attribute, free text included; 1:10:2 is the range "
         "from 1 to 10 in steps of 2; several sweeps make all combinations")
      .type_name("PATH=V,V,...")
      .allow_extra_args(false);
  app.add_option("-j,--jobs", options->jobs,
                 "run at most N jobs at once; default: the number of the machine's threads")
      .type_name("N")
      .transform(whole_number(1, 1024));
  app.add_option("--memory", options->memory,
                 "memory for all jobs together, such as 4G; default: 80 % of what is available")
      .type_name("SIZE")
      .check(some_word());
  app.add_option("--shard", options->shard,
                 "run only part I of N of the jobs; default: the number of the Slurm array task, if there is "
                 "one. With fewer jobs than parts, each part renders some frames of each job")
      .type_name("I/N")
      .check(some_word());
  app.add_flag(
      "--resume", options->resume,
      "keep what is complete, and make the rest: pictures; with --run, results of jobs, and the table's "
      "rows of earlier batches into the same folder");
  declare_passed_on(app, *options);
  app.add_flag("--json", options->json,
               "print one JSON object per job on stdout, one a line, as each job ends");
  app.add_flag("-q,--quiet", options->quiet, "print no progress");
  return [options] { return batch(*options); };
}

} // namespace

Command batch_command() {
  return {"batch", "render many presets in parallel, and make a page of the results", declare_batch};
}

} // namespace rend
