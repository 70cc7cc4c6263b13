// Whether pictures of a scene would show anything: asked before the first step, of the bodies as they are at
// the start.
//
// An eye inside of a solid sees nothing but the backs of its faces, which are not drawn: an error, where the
// clip begins there. A body that is not in sight at the start may come into it, and a moving camera may meet
// the place of a body that is there no more: these are told, and the clip is made.
#pragma once

#include "render/clip/frame_clock.h"
#include "render/picture/picture_settings.h"
#include "render/picture/viewpoint.h"

#include <string>
#include <vector>

namespace rend {

// UserError with the camera's place where there is no way to look, or the first picture's eye, if it is given,
// is inside of a solid. Cheap, and of no picture's size: asked of every preset.
void check_camera(const PictureSettings& picture, const Scene& scene, double aspect, const FrameClock& clock);

// What is to be told to who makes pictures. aspect: width / height.
std::vector<std::string> picture_notes(const PictureSettings& picture, const Scene& scene, double aspect,
                                       const FrameClock& clock);

} // namespace rend
