#include "render/clip/fitted_camera.h"

#include "render/console/progress.h"
#include "render/picture/viewpoint.h"

namespace rend {

Stopped fit_camera_to_clip(Session& session) {
  const std::string& fit = session.picture().camera.fit;
  if (fit.empty()) return Stopped::No;
  SessionOptions options = session.options();
  options.quiet = true; // its notes have been printed
  options.profile = options.count_fragments = false;
  Session rehearsal(options);
  const long last = rehearsal.clock().frames() - 1;
  Eigen::AlignedBox3d room;
  Progress progress(session.quiet(), rehearsal.last_step(last), rehearsal.clock().duration(), 0);
  Session::Callbacks calls;
  calls.frame = [&](long) {
    for (const auto& body : rehearsal.scene().bodies())
      if (fit == fit_all || fit == body->name) room.extend(bounds_of(*body));
  };
  calls.step = [&] { progress.update(rehearsal.scene().steps_done(), rehearsal.scene().time(), 0); };
  const Stopped stopped = rehearsal.run(last, calls);
  if (stopped == Stopped::Interrupted) return stopped;
  session.set_camera_room(room);
  return Stopped::No;
}

} // namespace rend
