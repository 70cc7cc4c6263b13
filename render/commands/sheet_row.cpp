#include "render/commands/sheet_row.h"

#include "render/clip/fitted_camera.h"
#include "render/console/progress.h"
#include "render/console/signals.h"
#include "render/picture/scene_picture.h"

#include <algorithm>
#include <cmath>

namespace rend {
namespace {

// Of a clip that is about to run.
class Choice {
public:
  Choice(long frames, bool end_alone)
      : end_alone_(end_alone), middle_(frames / 2), last_(frames - 1), lag_(frames / 20) {}

  bool wants(long frame, bool torn) {
    if (end_alone_) return frame == last_;
    if (torn && !tear_) tear_ = std::min(frame + lag_, last_);
    return frame == 0 || frame == last_ || frame == middle_ || frame == tear_;
  }
  bool is(int moment, long frame) const {
    return frame == (moment == 0 ? 0 : moment == 1 ? tear_.value_or(middle_) : last_);
  }
  std::optional<long> tear() const { return tear_; }

private:
  bool end_alone_;
  long middle_, last_, lag_;
  std::optional<long> tear_;
};

// The unit of the thresholds of all laws, if it is one.
std::string unit_of_thresholds(const Scene& scene) {
  std::optional<std::string> unit;
  for (const auto& body : scene.bodies())
    for (const TearLaw& law : body->tear_laws) {
      if (unit && *unit != law.settings().unit) return "";
      unit = law.settings().unit;
    }
  return unit.value_or("");
}

} // namespace

SheetRow::SheetRow(const SessionOptions& options, double aspect, bool end_alone)
    : options_(options), aspect_(aspect), end_alone_(end_alone) {}

Exit SheetRow::simulate(Session& session, long last, const std::function<void(long, FrameBuilder&)>& frame) {
  const GracefulStop graceful_stop; // a signal only ends the time loop; it is handled afterwards
  if (const Stopped stopped = fit_camera_to_clip(session); stopped != Stopped::No)
    return exit_code_of(session, stopped);
  FrameBuilder maker(session.picture(), session.scene(), aspect_, session.clock().duration(),
                     session.clock().frames());
  Progress progress(options_.quiet, session.last_step(last), session.clock().duration(), 0);
  Session::Callbacks calls;
  calls.frame = [&](long number) {
    maker.observe();
    frame(number, maker);
  };
  calls.step = [&] { progress.update(session.scene().steps_done(), session.scene().time(), 0); };
  return exit_code_of(session, session.run(last, calls));
}

Exit SheetRow::run() {
  Session session(options_);
  const FrameClock& clock = session.clock();
  Choice choice(clock.frames(), end_alone_);
  const Exit end = simulate(session, clock.frames() - 1, [&](long number, FrameBuilder& maker) {
    if (!choice.wants(number, session.scene().tears() > 0)) return;
    const Frame picture = maker.draw(number, clock.time_of(number));
    for (int k = 0; k < moments; ++k) {
      if (!choice.is(k, number)) continue;
      frames_[static_cast<std::size_t>(k)] = picture;
      times_[static_cast<std::size_t>(k)] = clock.time_of(number);
    }
  });
  if (choice.tear()) tear_time_ = clock.time_of(*choice.tear());
  tears_ = session.scene().tears();
  samples_ = session.image().samples;
  unit_ = unit_of_thresholds(session.scene());
  return end;
}

Exit SheetRow::set_middle(double time) {
  constexpr double slack = 1e-9; // times are products of rounded numbers
  if (std::abs(times_[1] - time) <= slack * time) return Exit::Done;
  SessionOptions again = options_;
  again.quiet = true; // its notes have been printed
  Session session(again);
  const FrameClock& clock = session.clock();
  long wanted = 0;
  while (wanted + 1 < clock.frames() && clock.time_of(wanted) < (1 - slack) * time) ++wanted;
  times_[1] = clock.time_of(wanted);
  return simulate(session, wanted, [&](long number, FrameBuilder& maker) {
    if (number == wanted) frames_[1] = maker.draw(number, clock.time_of(number));
  });
}

Exit set_middles(std::span<SheetRow> rows) {
  std::optional<double> first;
  for (const SheetRow& row : rows)
    if (row.tear() && (!first || *row.tear() < *first)) first = row.tear();
  if (!first) return Exit::Done;
  for (SheetRow& row : rows)
    if (const Exit end = row.set_middle(*first); end != Exit::Done) return end;
  return Exit::Done;
}

} // namespace rend
