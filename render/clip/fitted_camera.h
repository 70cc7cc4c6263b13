// <camera fit="NAME">: a camera that has a body, or all of them, in its pictures over the whole clip.
//
// Where bodies go is known only when they have gone there: the clip is simulated once more before its pictures
// are made, in a session of its own, without pictures. Both runs have the same states, and so the camera is the
// same whichever frames are asked for, and whether the run is resumed or divided into shards.
#pragma once

#include "render/clip/session.h"

namespace rend {

// Sets the camera's room (CameraSettings) to the box of the vertices of those bodies in all frames of the clip;
// does nothing without `fit`. Of what becomes unstable the frames before that count. Interrupted: by a signal;
// the camera is then as it was.
Stopped fit_camera_to_clip(Session& session);

} // namespace rend
