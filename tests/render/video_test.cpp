#include "render/video.h"

#include "sim/base/error.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

namespace rend {
namespace {

using namespace test;

class VideoTest : public testing::Test {
protected:
  void SetUp() override { NEEDS_VIDEO; }

  // A video of `count` pictures that change.
  static void write(const std::filesystem::path& path, int width, int height, int count, double fps = 25) {
    VideoWriter video;
    video.open(path, width, height, fps);
    for (int k = 0; k < count; ++k) video.add(pattern(width, height, 3, k));
    video.close();
  }

  static std::string bytes(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  // What ffprobe says of the stream's `entries`, one after another, split by commas; skips the test without it.
  static std::string probe(const std::filesystem::path& path, const std::string& entries) {
    const std::string command = fmt::format("ffprobe -v error -count_frames -select_streams v:0 -show_entries "
                                            "stream={} -of csv=p=0 '{}' 2>/dev/null",
                                            entries, path.string());
    std::FILE* pipe = popen(command.c_str(), "r");
    std::string text(200, '\0');
    text.resize(std::fread(text.data(), 1, text.size(), pipe));
    pclose(pipe);
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
  }
};

TEST_F(VideoTest, HasTheSizeTheRateAndAllThePicturesInBothContainers) {
  if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffprobe";
  const Folder folder;
  for (const char* name : {"a.mp4", "a.mkv"}) {
    write(folder / name, 96, 64, 13);
    EXPECT_EQ(probe(folder / name, "codec_name,width,height,pix_fmt"), "h264,96,64,yuv420p");
    EXPECT_EQ(probe(folder / name, "r_frame_rate"), "25/1");
    EXPECT_EQ(probe(folder / name, "nb_read_frames"), "13");
    EXPECT_EQ(probe(folder / name, "color_range,color_space,color_transfer,color_primaries"),
              "tv,bt709,bt709,bt709");
  }
}

TEST_F(VideoTest, AnOddPictureIsPaddedToAnEvenOne) {
  if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffprobe";
  const Folder folder;
  write(folder / "a.mp4", 95, 63, 3);
  EXPECT_EQ(probe(folder / "a.mp4", "width,height"), "96,64");
}

TEST_F(VideoTest, TheSamePicturesGiveTheSameBytes) {
  const Folder folder;
  for (const char* name : {"a.mp4", "b.mp4"}) write(folder / name, 320, 200, 20);
  EXPECT_FALSE(bytes(folder / "a.mp4").empty());
  EXPECT_EQ(bytes(folder / "a.mp4"), bytes(folder / "b.mp4"));
  for (const char* name : {"a.mkv", "b.mkv"}) write(folder / name, 64, 64, 5);
  EXPECT_EQ(bytes(folder / "a.mkv"), bytes(folder / "b.mkv"));
}

TEST_F(VideoTest, TheIndexStandsInFrontOfThePictures) {
  const Folder folder;
  write(folder / "a.mp4", 64, 64, 5);
  const std::string file = bytes(folder / "a.mp4");
  EXPECT_LT(file.find("moov"), file.find("mdat"));
}

TEST_F(VideoTest, AWriterThatIsNotClosedLeavesNoFile) {
  const Folder folder;
  {
    VideoWriter video;
    video.open(folder / "a.mp4", 64, 64, 25);
    video.add(pattern(64, 64));
    EXPECT_FALSE(std::filesystem::exists(folder / "a.mp4"));
  }
  EXPECT_EQ(folder.files(), 0);
}

TEST_F(VideoTest, AFileThatCannotBeMadeOrIsNotKnownIsTheUsersError) {
  const Folder folder;
  VideoWriter video;
  try {
    video.open(folder / "missing/a.mp4", 64, 64, 25);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::CannotCreate);
  }
  try {
    video.open(folder / "a.avi", 64, 64, 25);
    FAIL();
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::Usage);
  }
  EXPECT_FALSE(video.is_open());
  EXPECT_EQ(folder.files(), 0);
}

} // namespace
} // namespace rend
