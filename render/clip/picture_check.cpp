#include "render/clip/picture_check.h"

#include "render/draw/camera.h"
#include "render/picture/texture_file.h"
#include "sim/base/wording.h"
#include "sim/export/skin.h"
#include "sim/topology/count.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace rend {
namespace {

using Bounds = Eigen::AlignedBox3d;

std::string in_words(const Vec3& x) {
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", x.x(), x.y(), x.z());
}

// The solid angle of a triangle seen from the origin (Van Oosterom and Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

// The bodies' surfaces at the start; built on first use, since most cameras are far from all bodies.
class InitialSurfaces {
public:
  explicit InitialSurfaces(const Scene& scene) : scene_(scene) {}

  // Calls f(corners of a face, one after another) for the faces of a body.
  template <class F> void each_face(std::size_t body, F&& f) {
    if (!surfaces_) surfaces_ = SkinMaker(scene_).skin();
    std::vector<Vec3> ring;
    for (std::size_t face = body == 0 ? 0 : surfaces_->bodies[body - 1].faces_end;
         face < surfaces_->bodies[body].faces_end; ++face) {
      ring.clear();
      for (auto c = static_cast<std::size_t>(face == 0 ? 0 : surfaces_->ends[face - 1]);
           c < static_cast<std::size_t>(surfaces_->ends[face]); ++c)
        ring.emplace_back(surfaces_->points.data() + 3 * static_cast<std::size_t>(surfaces_->corners[c]));
      f(ring);
    }
  }

  // Whether a solid encloses the eye: the solid angles of its faces then sum to 4π, otherwise to 0.
  bool surrounds(std::size_t body, const Vec3& eye) {
    double filled = 0;
    each_face(body, [&](const std::vector<Vec3>& ring) {
      for (std::size_t n = 1; n + 1 < ring.size(); ++n)
        filled += solid_angle(ring[0] - eye, ring[n] - eye, ring[n + 1] - eye);
    });
    return std::abs(filled) > 2 * std::numbers::pi;
  }

private:
  const Scene& scene_;
  std::optional<Skin> surfaces_;
};

// Outcode of a point: 1, 2, 4, 8 for the sides of the view volume that it lies beyond, and 16 behind the eye.
unsigned beyond(const Eigen::Matrix4d& world_to_clip, const Vec3& x) {
  const Eigen::Vector4d p = world_to_clip * x.homogeneous();
  return (p.x() < -p.w() ? 1u : 0u) | (p.x() > p.w() ? 2u : 0u) | (p.y() < -p.w() ? 4u : 0u) |
         (p.y() > p.w() ? 8u : 0u) | (p.w() <= 0 ? 16u : 0u);
}

class Check {
public:
  Check(const PictureSettings& picture, const Scene& scene, double aspect, const FrameClock& clock)
      : scene_(scene), picture_(picture), viewpoint_(picture.camera, scene, aspect, clock.duration()),
        clock_(clock), aspect_(aspect), surfaces_(scene) {
    if (has_eye())
      for (const auto& body : scene.bodies()) bounds_.push_back(bounds_of(*body));
  }

  void check_camera() {
    if (has_eye()) check_first_eye();
  }

  std::vector<std::string> notes() {
    if (has_eye()) {
      look_from_first();
      check_camera_path();
    }
    check_fragment_colours();
    check_frame_distance();
    return std::move(notes_);
  }

private:
  bool has_eye() const {
    const CameraSettings& camera = picture_.camera;
    return camera.fit.empty() && (camera.eye || !camera.keys.empty());
  }

  // The first solid that encloses the eye.
  std::optional<std::size_t> around(const Vec3& eye) {
    for (std::size_t n = 0; n < bounds_.size(); ++n)
      if (scene_.bodies()[n]->map->dimension() == 3 && bounds_[n].contains(eye) && surfaces_.surrounds(n, eye))
        return n;
    return {};
  }

  void check_first_eye() {
    const Vec3 eye = viewpoint_.at(0).eye;
    const std::optional<std::size_t> body = around(eye);
    if (!body) return;
    const std::vector<CameraKey>& keys = picture_.camera.keys;
    const SettingsSource& source = keys.empty() ? picture_.camera.source : keys.front().source;
    source.fail(
        "eye",
        fmt::format("the camera is inside the body '{}', and would see nothing", scene_.bodies()[*body]->name),
        fmt::format("move the eye out of the body, which lies between {} and {} m, or use frame=\"auto\"",
                    in_words(bounds_[*body].min()), in_words(bounds_[*body].max())));
  }

  // By vertices, which nearly always decides; then by faces, since a face can fill the picture with no vertex
  // in it.
  bool sees(const FrameCamera& camera, std::size_t n) {
    const Eigen::Matrix4d view = view_of(camera, bounds_[n], aspect_).world_to_clip();
    const EmbeddedMap& map = *scene_.bodies()[n]->map;
    const CellIndex& cells = map.cells(Vertex);
    for (Slot v = 0; v < cells.slots(); ++v)
      if (cells.alive(v) && beyond(view, map.position()[v].vec()) == 0) return true;
    bool seen = false;
    surfaces_.each_face(n, [&](const std::vector<Vec3>& ring) {
      unsigned all = ~0u; // outcode bits shared by all corners of the face
      for (const Vec3& x : ring) all &= beyond(view, x);
      seen = seen || all == 0;
    });
    return seen;
  }

  void look_from_first() {
    const FrameCamera camera = viewpoint_.at(0);
    for (std::size_t n = 0; n < bounds_.size(); ++n)
      if (sees(camera, n)) return;
    std::string where;
    for (std::size_t n = 0; n < std::min<std::size_t>(bounds_.size(), 3); ++n)
      where += fmt::format("{}body '{}' is between {} and {} m", n ? ", " : "", scene_.bodies()[n]->name,
                           in_words(bounds_[n].min()), in_words(bounds_[n].max()));
    notes_.push_back(fmt::format("at the start the camera sees no body: its eye is at {} and its target at {}; "
                                 "{}; frame=\"auto\" aims it at the bodies",
                                 in_words(camera.eye), in_words(camera.target), where));
  }

  void check_camera_path() {
    constexpr long most = 1000; // camera positions tested along its path
    const long stride = std::max(1L, clock_.frames() / most);
    for (long frame = stride; frame < clock_.frames(); frame += stride) {
      const double time = clock_.time_of(frame);
      const std::optional<std::size_t> body = around(viewpoint_.at(time).eye);
      if (!body) continue;
      notes_.push_back(fmt::format("at {:.3g} s the camera may be inside the body '{}' (it is where the body "
                                   "is at the start) and see nothing",
                                   time, scene_.bodies()[*body]->name));
      return;
    }
  }

  void check_fragment_colours() {
    for (std::size_t n = 0; n < picture_.looks.size(); ++n) {
      const auto& body = scene_.bodies()[n];
      if (picture_.looks[n].by != ColourBy::Fragment || body->tears()) continue;
      if (count_cells(body->map->map()).fragments > 1) continue;
      notes_.push_back(
          fmt::format("body '{}' is coloured by fragment, but has no <tear>: it keeps one colour", body->name));
    }
  }

  // Real time keeps quiet: there few steps are as long as a frame, and those that are were meant so.
  void check_frame_distance() {
    const double apart = clock_.playback().slowest() / clock_.fps(); // [s]
    if (clock_.playback().is_real_time() || apart >= scene_.step_size()) return;
    notes_.push_back(
        fmt::format("where the clip is slowest its frames are {:.3g} s apart, and a step takes {:.3g} "
                    "s: some frames show the same state; --set time.step={:.1g} avoids that",
                    apart, scene_.step_size(), apart));
  }

  const Scene& scene_;
  const PictureSettings& picture_;
  Viewpoint viewpoint_;
  const FrameClock& clock_;
  double aspect_; // width / height
  InitialSurfaces surfaces_;
  std::vector<Bounds> bounds_; // of each body
  std::vector<std::string> notes_;
};

// The rim of a thick sheet is made for flat triangles; exploded cells and darts are polyhedra as they are.
void check_curves(const LookSettings& look) {
  if (look.smooth == 1) return;
  if (look.thickness)
    look.source.fail("smooth",
                     "smooth cannot be used together with thickness: the rim of a sheet has flat sides",
                     "leave out one of them");
  if (look.as == DrawStyle::Darts || look.as == DrawStyle::Exploded)
    look.source.fail("smooth",
                     fmt::format("smooth has no use on a body that is shown as=\"{}\", cell by cell",
                                 look.as == DrawStyle::Darts ? "darts" : "exploded"),
                     "leave it out, or show the body as=\"surface\" or \"wires\"");
}

void check_fit(const CameraSettings& camera, const Scene& scene) {
  if (camera.fit.empty() || camera.fit == fit_all) return;
  std::vector<std::string> names;
  for (const auto& body : scene.bodies()) names.push_back(body->name);
  if (std::ranges::find(names, camera.fit) != names.end()) return;
  names.emplace_back(fit_all);
  camera.source.fail("fit", "there is no body " + in_quotes(camera.fit),
                     suggestion(camera.fit, names, "there are"));
}

} // namespace

void check_camera(const PictureSettings& picture, const Scene& scene, double aspect, const FrameClock& clock) {
  check_fit(picture.camera, scene);
  Check(picture, scene, aspect, clock).check_camera();
}

void check_looks(const PictureSettings& picture, const Scene& scene) {
  if (picture.image.floor_shadow && !scene.world().floor)
    picture.image.source.fail("floor-shadow", "floor-shadow has no use in a scene without a floor",
                              "add <floor z=\"0\"/>, or leave floor-shadow out");
  for (std::size_t n = 0; n < std::min(picture.looks.size(), scene.bodies().size()); ++n) {
    const SettingsSource& look = picture.looks[n].source;
    const Body& body = *scene.bodies()[n];
    const bool solid = body.map->map().dimension() == 3;
    check_textures(picture.looks[n], solid);
    check_curves(picture.looks[n]);
    if (look.given("thickness") && (solid || picture.looks[n].as != DrawStyle::Surface))
      look.fail("thickness",
                solid ? fmt::format("the body {} is a solid, whose thickness is that of its shape",
                                    in_quotes(body.name))
                      : std::string("thickness cannot be seen on a sheet that is not shown as=\"surface\""),
                "leave it out");
    if (!solid && look.given("finish-inside"))
      look.fail("finish-inside",
                fmt::format("the body {} is a sheet, which has no inside", in_quotes(body.name)),
                "finish is that of both of its sides");
    if (look.given("finish-inside") && picture.looks[n].as != DrawStyle::Surface)
      look.fail("finish-inside", "finish-inside can be seen only on a body that is shown as=\"surface\"",
                "leave it out");
    const char* wrong = solid ? "back" : "inside";
    if (!look.given(wrong)) continue;
    if (solid)
      look.fail(wrong, fmt::format("the body {} is a solid, which shows no back", in_quotes(body.name)),
                "colour is that of its outside, inside that of the faces that tearing exposes");
    look.fail(wrong, fmt::format("the body {} is a sheet, which has no inside", in_quotes(body.name)),
              "colour and back are those of its sides, torn that of the line along torn edges");
  }
}

std::vector<std::string> picture_notes(const PictureSettings& picture, const Scene& scene, double aspect,
                                       const FrameClock& clock) {
  return Check(picture, scene, aspect, clock).notes();
}

} // namespace rend
