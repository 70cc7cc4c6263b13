// <camera>: where the pictures are taken from. Viewpoint makes a path of it (viewpoint.h).
#pragma once

#include "sim/base/settings.h"

#include <Eigen/Geometry>
#include <optional>
#include <string>
#include <vector>

namespace rend {

// Where the camera is at a time; between keys it moves smoothly.
struct CameraKey {
  double at = 0;                   // [s]
  Vec3 eye = Vec3::Zero();         // [m]
  std::optional<Vec3> target = {}; // [m]; none: the camera's
  std::optional<double> fov = {};  // [degrees]; none: the camera's
  std::optional<double> lens = {}; // [mm], in place of fov
  SettingsSource source = {};
};
template <> const Fields<CameraKey>& fields_of();

enum class Framing {
  Auto,  // as near as the bodies allow, seen from the direction of the eye
  Given, // from the eye
  Follow // after the bodies
};

struct CameraSettings {
  std::optional<Vec3> eye = {};    // [m]; none: as the framing has it
  std::optional<Vec3> target = {}; // [m]; none: the middle of the bodies at the start
  Vec3 up{0, 0, 1};
  double fov = 35;                   // from bottom to top of the picture [degrees]
  std::optional<double> lens = {};   // focal length, in place of fov [mm]: fov_of_lens()
  double turn = 0;                   // around the target over the clip [degrees]
  std::optional<Framing> frame = {}; // none: Given where there is an eye, else Auto
  std::vector<CameraKey> keys = {};  // in order of time; where there are some, the camera goes where they say
  // The name of the body that is to be in the picture over the whole clip, or fit_all; empty: an estimate does
  std::string fit = {};
  // What is to be in the picture [m], once it is known (fitted_camera.h); none: an estimate (viewpoint.h)
  std::optional<Eigen::AlignedBox3d> room = {};
  SettingsSource source = {};
};
template <> const Fields<CameraSettings>& fields_of();

constexpr double least_fov = 1, most_fov = 170; // [degrees]
constexpr const char* fit_all = "all";          // of CameraSettings::fit

// UserError for what cannot be together: an up of no direction, keys with a framing of another kind, a given
// frame without an eye, an eye at its target.
void check_framing(const CameraSettings& camera);

// The angle of view from bottom to top [degrees] with that focal length [mm]; aspect: the picture's width over
// its height. The longer side of the sensor is 36 mm.
double fov_of_lens(double lens, double aspect);

} // namespace rend
