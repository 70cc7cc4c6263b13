#include "render/files/video.h"
#include "render/files/video_format.h"

#include "sim/base/error.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <cmath>
#include <cstdio>
#include <fmt/format.h>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <sys/wait.h>
#include <unistd.h>

namespace rend::video_test {
namespace {

using namespace test;

class VideoTest : public testing::Test {
protected:
  void SetUp() override { NEEDS_VIDEO; }

  // Writes a video of `count` pictures that differ.
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

  // What ffprobe prints for `entries` of the stream, separated by commas; skips the test if it is not
  // installed.
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

struct Expected {
  const char *name, *stream, *colours;
};
constexpr std::array<Expected, 5> formats{{{"a.mp4", "h264,96,64,yuv420p", "tv,bt709,bt709,bt709"},
                                           {"a.webm", "vp9,96,64,yuv420p", "tv,bt709,bt709,bt709"},
                                           {"a.mkv", "ffv1,96,64,bgr0", "pc,gbr,iec61966-2-1,bt709"},
                                           {"a.gif", "gif,96,64,bgra", "unknown,unknown,unknown,unknown"},
                                           {"a.apng", "apng,96,64,rgb24", "pc,unknown,unknown,unknown"}}};

TEST_F(VideoTest, HasTheSizeTheRateAndAllThePicturesInEveryFormat) {
  if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffprobe";
  const Folder folder;
  ASSERT_EQ(video_formats().size(), formats.size());
  for (const Expected& each : formats) {
    SCOPED_TRACE(each.name);
    write(folder / each.name, 96, 64, 13);
    EXPECT_EQ(probe(folder / each.name, "codec_name,width,height,pix_fmt"), each.stream);
    EXPECT_EQ(probe(folder / each.name, "r_frame_rate"), "25/1");
    EXPECT_EQ(probe(folder / each.name, "nb_read_frames"), "13");
    EXPECT_EQ(probe(folder / each.name, "color_range,color_space,color_transfer,color_primaries"),
              each.colours);
  }
}

TEST_F(VideoTest, TheLosslessOneDecodesToThePicturesExactly) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffmpeg";
  const Folder folder;
  write(folder / "a.mkv", 95, 63, 4); // odd sides too
  const std::string command = fmt::format("ffmpeg -v error -i '{}' -f rawvideo -pix_fmt rgb24 '{}'",
                                          (folder / "a.mkv").string(), (folder / "raw").string());
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::string expected;
  for (int k = 0; k < 4; ++k) {
    const Image image = pattern(95, 63, 3, k);
    expected.append(image.pixels.begin(), image.pixels.end());
  }
  EXPECT_TRUE(bytes(folder / "raw") == expected);
}

// A disc that moves over nothing: 200 in its middle, half transparent in a ring, and nothing outside.
Image disc(int number) {
  Image image(96, 64, 4);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double away = std::hypot(x - 30 - 4 * number, y - 32);
      std::uint8_t* const pixel = image.row(y) + std::ptrdiff_t{4} * x;
      pixel[0] = away < 24 ? 200 : 0;
      pixel[1] = away < 24 ? 60 : 0;
      pixel[2] = away < 24 ? 40 : 0;
      pixel[3] = static_cast<std::uint8_t>(away < 16 ? 255 : away < 24 ? 128 : 0);
    }
  return image;
}

// Read back by another program; libvpx's own decoder is the one that knows alpha.
TEST_F(VideoTest, TransparentOnesHaveTheAlphaOfThePictures) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffmpeg";
  constexpr std::size_t count = 3, size = std::size_t{4} * 96 * 64;
  struct Reading {
    std::string name, decoder;
    int alpha, colour; // how far they may be off, in the middle of disc, ring and what is outside
  };
  for (const Reading& each : {Reading{"a.webm", "-c:v libvpx-vp9", 12, 16}, Reading{"a.mkv", "", 0, 0},
                              Reading{"a.apng", "", 0, 0}}) {
    SCOPED_TRACE(each.name);
    const Folder folder;
    VideoWriter video;
    video.open(folder / each.name, 96, 64, 25, true);
    for (std::size_t k = 0; k < count; ++k) video.add(disc(static_cast<int>(k)));
    video.close();
    const std::string command =
        fmt::format("ffmpeg -v error {} -i '{}' -f rawvideo -pix_fmt rgba '{}'", each.decoder,
                    (folder / each.name).string(), (folder / "raw").string());
    ASSERT_EQ(std::system(command.c_str()), 0);
    const std::string raw = bytes(folder / "raw");
    ASSERT_EQ(raw.size(), count * size);
    for (std::size_t k = 0; k < count; ++k)
      for (const int right : {0, 6, 20, 34}) { // from the middle of the disc
        const int x = 30 + 4 * static_cast<int>(k) + right;
        const Image expected = disc(static_cast<int>(k));
        const std::size_t at = k * size + std::size_t{4} * (32 * 96 + static_cast<std::size_t>(x));
        EXPECT_NEAR(static_cast<std::uint8_t>(raw[at + 3]), expected.at(x, 32)[3], each.alpha)
            << k << " " << right;
        for (std::size_t c = 0; right <= 20 && c < 3; ++c)
          EXPECT_NEAR(static_cast<std::uint8_t>(raw[at + c]), expected.at(x, 32)[c], each.colour)
              << k << " " << right;
      }
  }
}

TEST_F(VideoTest, ATransparentGifHasOneBitOfAlphaAndForgetsWhatMovedAway) {
  if (std::system("ffmpeg -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffmpeg";
  const Folder folder;
  VideoWriter video;
  video.open(folder / "a.gif", 96, 64, 25, true);
  for (int k = 0; k < 3; ++k) video.add(disc(5 * k));
  video.close();
  const std::string command = fmt::format("ffmpeg -v error -i '{}' -f rawvideo -pix_fmt rgba '{}'",
                                          (folder / "a.gif").string(), (folder / "raw").string());
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string raw = bytes(folder / "raw");
  constexpr std::size_t size = std::size_t{4} * 96 * 64;
  ASSERT_EQ(raw.size(), 3 * size);
  int wrong = 0;
  for (int k = 0; k < 3; ++k) {
    const Image expected = disc(5 * k);
    for (std::size_t n = 3; n < size; n += 4)
      wrong += static_cast<std::uint8_t>(raw[static_cast<std::size_t>(k) * size + n]) ==
                       (expected.pixels[n] >= 128 ? 255 : 0)
                   ? 0
                   : 1;
  }
  EXPECT_EQ(wrong, 0);
}

TEST_F(VideoTest, FormatsWithTransparencyAreNamed) {
  EXPECT_EQ(transparent_format_names(), (std::vector<std::string>{"webm", "mkv", "gif", "apng"}));
}

TEST_F(VideoTest, PreviewsAreSmall) {
  if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffprobe";
  const Folder folder;
  for (const char* name : {"a.gif", "a.apng"}) {
    write(folder / name, 960, 540, 2);
    EXPECT_EQ(probe(folder / name, "width,height"), "480,270");
  }
}

// With B-frames decoding starts earlier, but the first frame is shown at 0: videos can be concatenated.
TEST_F(VideoTest, EveryVideoStartsAtZero) {
  if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffprobe";
  for (const VideoFormat& format : video_formats()) {
    SCOPED_TRACE(format.name);
    const Folder folder;
    const std::string name = "a." + format.name;
    write(folder / name, 64, 64, 10, 20);
    EXPECT_EQ(std::atof(probe(folder / name, "start_time").c_str()), 0);
  }
}

TEST_F(VideoTest, AGifOfMoreThanFiftyPicturesASecondIsSlowedDown) {
  if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffprobe";
  const Folder folder;
  write(folder / "a.gif", 64, 64, 100, 200); // half a second
  EXPECT_EQ(probe(folder / "a.gif", "r_frame_rate"), "50/1");
  EXPECT_EQ(probe(folder / "a.gif", "nb_read_frames"), "25");
}

// The file that a killed program leaves can be played, except for about its last second.
TEST_F(VideoTest, WhatAKilledRunLeavesCanBePlayed) {
  if (std::system("ffprobe -version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no ffprobe";
  for (const VideoFormat& format : video_formats()) {
    SCOPED_TRACE(format.name);
    const Folder folder;
    const pid_t child = fork();
    if (child == 0) {
      VideoWriter video;
      video.open(folder / ("a." + format.name), 64, 64, 25);
      for (int k = 0; k < 120; ++k) video.add(pattern(64, 64, 3, k));
      _exit(0); // without closing anything
    }
    ASSERT_GT(child, 0);
    int status = 0;
    waitpid(child, &status, 0);
    ASSERT_EQ(status, 0);
    EXPECT_FALSE(std::filesystem::exists(folder / ("a." + format.name)));
    const std::string pictures = probe(folder / ("a.part." + format.name), "nb_read_frames");
    EXPECT_GE(std::atoi(pictures.c_str()), 50) << pictures;
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
  for (const VideoFormat& format : video_formats()) {
    for (const char* stem : {"a.", "b."}) write(folder / (stem + format.name), 320, 200, 20);
    EXPECT_FALSE(bytes(folder / ("a." + format.name)).empty());
    EXPECT_TRUE(bytes(folder / ("a." + format.name)) == bytes(folder / ("b." + format.name))) << format.name;
  }
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

TEST_F(VideoTest, AnEncoderThatIsNotThereIsSaidWithThoseThatAre) {
  VideoFormat lacking = video_formats().front();
  lacking.encoder = "libnothing";
  try {
    require_encoder(lacking);
    FAIL() << "it was not refused";
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::CannotCreate);
    EXPECT_NE(std::string(error.what()).find("cannot write mp4: they lack libnothing"), std::string::npos);
    EXPECT_NE(error.hint.find("mkv"), std::string::npos);
  }
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
} // namespace rend::video_test
