#include "render/pipeline/pipeline.h"

#include "render/files/png.h"
#include "render/files/video.h"
#include "sim/base/check.h"
#include "sim/base/error.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <gtest/gtest.h>

namespace rend::pipeline_test {
namespace {

using namespace test;

PipelineOptions small(const std::filesystem::path& folder) {
  PipelineOptions options;
  options.folder = folder;
  options.name = "clip";
  options.width = 64;
  options.height = 48;
  options.samples = 1;
  return options;
}

// A red square whose size grows with the number.
Frame numbered(int number) {
  Frame frame = front_view();
  frame.number = number;
  frame.bodies.push_back(screen(0, 0.1f + 0.1f * static_cast<float>(number), red));
  return frame;
}

int red_pixels(const Image& image) {
  int count = 0;
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) count += image.at(x, y)[0] > image.at(x, y)[1] + 60;
  return count;
}

TEST(Pipeline, WritesEveryFrameUnderItsNumber) {
  NEEDS_PNG;
  const Folder folder;
  for (const int writers : {1, 2}) {
    PipelineOptions options = small(folder / "new/folder"); // created by the pipeline
    options.png_writers = writers;
    Pipeline pipeline(options);
    for (const int number : {0, 2, 4, 6}) pipeline.push(numbered(number));
    pipeline.finish();
    int last = 0;
    for (const char* name : {"00000.png", "00002.png", "00004.png", "00006.png"}) {
      const int count = red_pixels(read_png(folder / "new/folder" / name));
      EXPECT_GT(count, last);
      last = count;
    }
    EXPECT_GT(pipeline.seconds().draw, 0);
    EXPECT_GT(pipeline.seconds().png, 0);
  }
}

TEST(Pipeline, WritesAVideoBesideThePicturesOrAlone) {
  NEEDS_PNG;
  NEEDS_VIDEO;
  for (const bool png : {true, false}) {
    const Folder folder;
    PipelineOptions options = small(folder.path());
    options.video = true;
    options.png = png;
    Pipeline pipeline(options);
    for (int number = 0; number < 5; ++number) pipeline.push(numbered(number));
    pipeline.finish();
    EXPECT_TRUE(std::filesystem::exists(folder / "clip.mp4"));
    EXPECT_EQ(folder.files(), png ? 6 : 1);
  }
}

TEST(Pipeline, WithoutFinishKeepsPicturesAndRemovesTheVideo) {
  NEEDS_PNG;
  const Folder folder;
  PipelineOptions options = small(folder.path());
  options.video = video_available();
  {
    Pipeline pipeline(options);
    for (int number = 0; number < 12; ++number) pipeline.push(numbered(number));
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "clip.mp4"));
  EXPECT_FALSE(std::filesystem::exists(folder / "clip.mp4.part"));
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(read_png(entry.path()).width, 64) << entry.path();
}

TEST(Pipeline, AnErrorOfAWriterComesOutOfPushOrFinish) {
  NEEDS_PNG;
  const Folder folder;
  std::filesystem::create_directory(folder / "00001.png"); // blocks the name of a picture
  try {
    Pipeline pipeline(small(folder.path())); // its destructor waits for the other writer
    for (int number = 0; number < 50; ++number) pipeline.push(numbered(number));
    pipeline.finish();
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::CannotCreate);
  }
  EXPECT_EQ(read_png(folder / "00000.png").height, 48);
}

TEST(Pipeline, AFrameThatIsNotFiniteIsNotWritten) {
  const Folder folder;
  Pipeline pipeline(small(folder.path()));
  Frame frame = numbered(0);
  frame.bodies[0].corners[0].position[2] = std::nanf("");
  EXPECT_THROW(
      {
        pipeline.push(std::move(frame));
        pipeline.finish();
      },
      InternalError);
  EXPECT_EQ(folder.files(), 0);
}

TEST(Pipeline, AFolderThatCannotBeMadeIsTheUsersError) {
  NEEDS_PNG;
  const Folder folder;
  write_png(folder / "file", pattern(2, 2));
  try {
    Pipeline pipeline(small(folder / "file/below"));
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::CannotCreate);
  }
}

} // namespace
} // namespace rend::pipeline_test
