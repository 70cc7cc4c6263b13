// Whether pictures of a scene would show anything: checked before the first step, with the bodies in their
// initial positions.
//
// An eye inside a solid sees only back faces, which are culled: an error if the clip begins there. A body that
// is out of sight at the start may come into view, and a moving camera may pass through a place that a body has
// left by then: these give notes, and the clip is made.
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

// UserError at a <look> that gives a sheet the colour of an inside, or a solid that of a back: neither has one;
// for a thickness of what is not drawn as a sheet; for curves of what has none; for pictures that cannot be
// shown (texture_file.h); and for the shadow of a floor that is not there.
void check_looks(const PictureSettings& picture, const Scene& scene);

// What is to be told to who makes pictures. aspect: width / height.
std::vector<std::string> picture_notes(const PictureSettings& picture, const Scene& scene, double aspect,
                                       const FrameClock& clock);

} // namespace rend
