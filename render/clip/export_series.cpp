#include "render/clip/export_series.h"

#include "render/clip/picture_on_skin.h"
#include "render/files/output.h"
#include "sim/base/wording.h"

#include <fmt/format.h>

namespace rend {

ExportSeries::ExportSeries(const Session& session, const ExportFormat& format,
                           const std::filesystem::path& folder, const FrameChoice& choice)
    : session_(session), format_(format), folder_(folder), choice_(choice),
      exporter_(
          format.make(session.scene(), pictures_on_skin(session.picture(), session.scene(), folder_.path()))),
      scene_file_(session, format.name) {}

void ExportSeries::name_files(NamedFiles& files) const {
  const std::string what = "--export " + format_.name;
  files.writes_frames(what, folder_.path(), format_.extension,
                      [this](long frame) { return frame < session_.clock().frames() && choice_.has(frame); });
  if (!index_name().empty()) files.writes(what, folder_.path() / index_name());
  files.writes(what, folder_.path() / scene_file_name());
  for (const FileBeside& file : exporter_->beside()) files.writes(what, folder_.path() / file.name);
}

void ExportSeries::take(long frame) {
  const double start = wall_clock();
  const long step = session_.scene().steps_done();
  if (step != held_step_) release();
  scene_file_.observe();
  if (choice_.has(frame)) hold(frame, step);
  seconds_ += wall_clock() - start;
}

void ExportSeries::hold(long frame, long step) {
  if (step != held_step_) held_ = exporter_->state();
  if (step != held_step_ || format_.every_frame)
    held_files_.push_back({session_.scene().time(), fmt::format("{:05d}{}", frame, format_.extension)});
  held_frames_.push_back(scene_file_.frame(frame, held_files_.back().name));
  held_step_ = step;
}

void ExportSeries::release() {
  for (nlohmann::ordered_json& frame : held_frames_) scene_file_.add(std::move(frame));
  held_frames_.clear();
  for (ExportedFile& file : held_files_) {
    write(file.name, held_);
    files_.push_back(std::move(file));
  }
  held_files_.clear();
}

void ExportSeries::write(const std::string& name, const std::string& bytes) {
  folder_.make();
  write_atomically(folder_.path() / name, bytes);
  bytes_ += bytes.size();
}

void ExportSeries::finish() {
  const double start = wall_clock();
  release();
  if (!files_.empty() && !index_name().empty()) write(index_name(), exporter_->index(files_));
  if (!files_.empty()) write(scene_file_name(), scene_file_.text());
  for (const FileBeside& file : exporter_->beside())
    if (!files_.empty()) write(file.name, file.bytes);
  folder_.sync();
  seconds_ += wall_clock() - start;
}

void ExportSeries::abandon() {
  held_files_.clear();
  held_frames_.clear();
  finish();
}

ExportFigures ExportSeries::figures() const {
  return {.format = format_.name,
          .folder = folder_.path().string(),
          .index = index_name(),
          .files = files_.size(),
          .bytes = bytes_,
          .seconds = seconds_};
}

const ExportFormat& export_format(const std::string& name) {
  if (const ExportFormat* format = find_export_format(name)) return *format;
  const std::vector<std::string> names = export_format_names();
  throw UserError(Exit::Usage, {}, fmt::format("--export {}: there is no such format", in_quotes(name)),
                  suggestion(name, names, "formats"));
}

} // namespace rend
