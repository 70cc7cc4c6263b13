#include "render/picture/camera_settings.h"

namespace rend {

template <> const Fields<CameraKey>& fields_of() {
  using S = CameraKey;
  static const Fields<S> fields{
      field(&S::at, number("at", "s", "when").at_least(0).is_required()),
      field(&S::eye, numbers("eye", 3, "m", "where the camera stands").is_required()),
      field(&S::target, numbers("target", 3, "m", "what it looks at; default: the camera's")),
      field(&S::fov, number("fov", "degrees", "default: the camera's").at_least(1).at_most(170))};
  return fields;
}

template <> const Fields<CameraSettings>& fields_of() {
  using S = CameraSettings;
  static const Fields<S> fields{
      field(&S::eye, numbers("eye", 3, "m", "where the camera stands")),
      field(&S::target,
            numbers("target", 3, "m", "what it looks at; default: the middle of the bodies at the start")),
      field(&S::up, numbers("up", 3, "", "what is up in the picture")),
      field(&S::fov,
            number("fov", "degrees", "the angle from bottom to top of the picture").at_least(1).at_most(170)),
      field(&S::turn, number("turn", "degrees", "how far it goes around the target over the clip")),
      field(&S::frame, word("frame", {"auto", "given", "follow"},
                            "auto: as near as the bodies allow, seen from the direction of the eye; default "
                            "where there is no "
                            "eye; follow: after the bodies, never losing one out of sight"))};
  return fields;
}

void check_framing(const CameraSettings& camera) {
  if (camera.up.norm() == 0)
    camera.source.fail("up", "the camera's up has no direction", "up=\"0 0 1\" is usual");
  if (!camera.keys.empty() && camera.frame && camera.frame != Framing::Given)
    camera.source.fail("frame", "a camera with keys goes where they say", "leave frame out, or the keys");
  if (!camera.eye && camera.frame == Framing::Given)
    camera.source.fail("frame", "a given frame needs an eye", "eye=\"0 -3 1\", or frame=\"auto\"");
  if (camera.eye && camera.target && *camera.eye == *camera.target)
    camera.source.fail("eye", "the camera's eye stands at its target", "move it away from there");
}

} // namespace rend
