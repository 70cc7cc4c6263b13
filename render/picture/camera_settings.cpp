#include "render/picture/camera_settings.h"

#include "sim/base/math.h"
#include "sim/base/reach.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

constexpr double sensor = 36; // [mm]

AttributeType lens_type() {
  return number("lens", "mm",
                "focal length, in place of fov, for a sensor whose longer side is 36 mm: 24 is "
                "wide, 50 normal, 85 narrow")
      .at_least(1)
      .at_most(2000);
}

void refuse_both(const SettingsSource& source) {
  if (source.given("fov") && source.given("lens"))
    source.fail("lens", "fov and lens both say how wide the angle of view is", "leave out one of them");
}

} // namespace

double fov_of_lens(double lens, double aspect) {
  return 360 / pi * arc_tangent(sensor / 2 / std::max(aspect, 1.0), lens);
}

template <> const Fields<CameraKey>& fields_of() {
  using S = CameraKey;
  static const Fields<S> fields{
      field(&S::at, number("at", "s", "when").at_least(0).is_required()),
      field(&S::eye, position("eye", "position of the camera").is_required()),
      field(&S::target, position("target", "the point that it looks at; default: that of the camera")),
      field(&S::fov, number("fov", "degrees", "angle of view from bottom to top; default: that of the camera")
                         .at_least(least_fov)
                         .at_most(most_fov)),
      field(&S::lens, lens_type())};
  return fields;
}

template <> const Fields<CameraSettings>& fields_of() {
  using S = CameraSettings;
  static const Fields<S> fields{
      field(&S::eye, position("eye", "position of the camera")),
      field(&S::target,
            position("target", "the point that it looks at; default: the middle of the bodies at the start")),
      field(&S::up, within(numbers("up", 3, "", "the direction that is up in the picture"), farthest)),
      field(&S::fov,
            number("fov", "degrees", "angle of view from bottom to top").at_least(least_fov).at_most(most_fov)),
      field(&S::lens, lens_type()),
      field(&S::turn, within(number("turn", "degrees",
                                    "the angle by which the camera moves around the target during the clip"),
                             most_degrees)),
      field(&S::frame,
            word("frame", {"auto", "given", "follow"},
                 "how the camera is placed\nauto: in the direction of the eye, so near that all bodies at the "
                 "start fill the picture; the default without an eye\ngiven: exactly at the eye; the default "
                 "with an eye\nfollow: it moves along with the bodies, and keeps all of them in the picture")),
      field(&S::fit,
            text("fit",
                 "name of the body that is to be in the picture over the whole clip, or all: the camera "
                 "stands as with frame=\"auto\", as near as that allows. Where bodies go has to be found "
                 "out first: the simulation runs twice"))};
  return fields;
}

void check_framing(const CameraSettings& camera) {
  refuse_both(camera.source);
  for (const CameraKey& key : camera.keys) refuse_both(key.source);
  if (camera.up.norm() == 0)
    camera.source.fail("up", "the camera's up has no direction", "up=\"0 0 1\" is usual");
  if (!camera.keys.empty() && camera.frame && camera.frame != Framing::Given)
    camera.source.fail("frame", "frame cannot be used together with <key>: the keys place the camera",
                       "leave out frame, or the keys");
  if (!camera.fit.empty() && (!camera.keys.empty() || camera.frame.value_or(Framing::Auto) != Framing::Auto))
    camera.source.fail("fit",
                       fmt::format("fit cannot be used together with {}",
                                   camera.keys.empty() ? "a frame of another kind" : "<key>"),
                       "leave out one of them: fit places the camera itself");
  if (!camera.eye && camera.frame == Framing::Given)
    camera.source.fail("frame", "frame=\"given\" needs an eye", "add eye=\"0 -3 1\", or use frame=\"auto\"");
  if (camera.eye && camera.target && *camera.eye == *camera.target)
    camera.source.fail("eye", "the camera's eye stands at its target", "move it away from there");
}

} // namespace rend
