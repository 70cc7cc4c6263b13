// <camera fit="...">: what it names is in every picture, and fills them as far as it can, whichever pictures
// are asked for first.
#include "render/clip/fitted_camera.h"

#include "render/draw/camera.h"
#include "tests/render/clip/stopped_clip.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <fmt/format.h>

#include <fstream>

namespace rend::fitted_camera_test {
namespace {

// A cloth that flies up and away, and a block that stays.
std::string scene(const std::string& camera) {
  return R"(<scene name="clip">
  <body name="cloth">
    <sheet cells="4 4" size="1 1"/><place velocity="4 1 6"/><mass total="0.1"/>
    <springs><stretch k="60"/><shear kind="isotropic" k="43"/></springs>
  </body>
  <body name="block">
    <bar cells="1 1 1" size="0.5 0.5 0.5"/><place translate="-2 0 0"/><mass total="1"/>
    <springs><stretch k="60"/><shear kind="isotropic" where="volume" k="50"/></springs>
    <fix side="-z"/>
  </body>
  )" + camera +
         R"(<image size="160 90" fps="30" samples="1"/><time step="2e-3" duration="1"/></scene>)";
}

// The largest distance of a vertex of those bodies from the middle of a picture, in halves of its sides, over
// the clip; 1e300: it was behind the eye.
double farthest_out(const std::string& camera, const std::string& of, bool fitted) {
  const test::Folder folder;
  std::ofstream(folder / "clip.xml") << scene(camera);
  SessionOptions options;
  options.preset = (folder / "clip.xml").string();
  options.quiet = true;
  Session session(options);
  const Stopped found = fitted ? fit_camera_to_clip(session) : Stopped::No;
  EXPECT_EQ(found, Stopped::No);
  EXPECT_EQ(session.scene().steps_done(), 0) << "the run itself has not begun";
  const double aspect = session.image().aspect();
  const Viewpoint viewpoint(session.picture().camera, session.scene(), aspect, session.clock().duration());
  double farthest = 0;
  Session::Callbacks calls;
  calls.frame = [&](long frame) {
    const FrameCamera seen_from = viewpoint.at(session.clock().time_of(frame));
    for (const auto& body : session.scene().bodies()) {
      if (of != fit_all && of != body->name) continue;
      const Eigen::AlignedBox3d box = bounds_of(*body);
      const Eigen::Matrix4d to_clip = view_of(seen_from, box, aspect).world_to_clip();
      const CellIndex& cells = body->map->cells(Vertex);
      for (Slot v = 0; v < cells.slots(); ++v) {
        if (!cells.alive(v)) continue;
        const Eigen::Vector4d p = to_clip * body->map->position()[v].vec().homogeneous();
        farthest = p.w() > 0 ? std::max(farthest, p.head<2>().cwiseAbs().maxCoeff() / p.w()) : 1e300;
      }
    }
  };
  EXPECT_EQ(session.run(session.clock().frames() - 1, calls), Stopped::No);
  return farthest;
}

TEST(FittedCamera, KeepsTheBodyInEveryPictureAndAsLargeAsCanBe) {
  const std::string none, eye = R"( eye="5 -9 2")";
  for (const std::string& from : {none, eye})
    for (const std::string of : {"all", "cloth", "block"}) {
      const double out = farthest_out(fmt::format(R"(<camera{} fit="{}"/>)", from, of), of, true);
      EXPECT_LT(out, 1) << of;
      EXPECT_GT(out, 0.6) << of;
    }
  EXPECT_GT(farthest_out(R"(<camera frame="auto"/>)", fit_all, false), 1) << "an estimate does not hold it";
  EXPECT_GT(farthest_out(R"(<camera fit="block"/>)", "cloth", true), 1) << "nor what fits another body";
}

class FittedClip : public program::StoppedClip {};

TEST_F(FittedClip, HasTheSamePicturesWhicheverAreAskedForFirst) {
  NEEDS_PNG;
  place.write("clip.xml", scene(R"(<camera fit="all"/>)"));
  const program::Files all = alone();
  ASSERT_EQ(all.size(), 31U);
  EXPECT_EQ(place.rend("render clip.xml -q -o some --frames 4-6").code, 0);
  EXPECT_EQ(in("some").size(), 3U);
  expect_part_of(in("some"), all, "frames 4 to 6");
  EXPECT_EQ(place.rend("render clip.xml -q -o some --resume").code, 0);
  expect_same(in("some"), all, "the others later");
  for (const char* shard : {"1/2", "2/2"})
    EXPECT_EQ(place.rend(fmt::format("render clip.xml -q -o shards --shard {}", shard)).code, 0);
  expect_same(in("shards"), all, "in shards");
}

TEST_F(FittedClip, StoppedBeforeItsFirstPictureLeavesNone) {
  NEEDS_PNG;
  place.write("clip.xml", scene(R"(<camera fit="all"/>)"));
  // A hundred thousand times as many steps: it is stopped long before it knows where the camera stands.
  const program::Outcome stopped = this->stopped("TERM", 1, "render clip.xml -q -o out --set time.step=2e-8");
  EXPECT_EQ(stopped.code, 143);
  EXPECT_NE(stopped.err.find("stopped by a signal at 0 s"), std::string::npos) << stopped.err;
  EXPECT_TRUE(in("out").empty());
}

} // namespace
} // namespace rend::fitted_camera_test
