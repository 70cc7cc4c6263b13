// Which format a file has, and which are none.
#include "render/files/picture_file.h"

#include "render/files/jpeg.h"
#include "render/files/png.h"
#include "sim/base/error.h"
#include "tests/render/jpeg_files.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"

#include <fstream>
#include <gmock/gmock.h>

namespace rend::picture_file_test {
namespace {

using namespace test;
using testing::HasSubstr;

TEST(PictureFile, has_the_format_of_its_first_bytes_whatever_its_name) {
  NEEDS_PNG;
  NEEDS_JPEG;
  const Folder folder;
  const Image image = pattern(24, 16);
  write_png(folder / "a.jpg", image);
  EXPECT_EQ(read_picture(folder / "a.jpg"), image);
  std::ofstream(folder / "a.png", std::ios::binary) << jpeg_file(image);
  EXPECT_EQ(read_picture(folder / "a.png"), read_jpeg(folder / "a.png"));
  for (const char* name : {"a.jpg", "a.png"}) {
    EXPECT_EQ(picture_info(folder / name).width, 24);
    EXPECT_EQ(picture_info(folder / name).height, 16);
  }
}

TEST(PictureFile, of_another_kind_is_refused_with_the_name_of_that) {
  const Folder folder;
  const std::pair<std::string, std::string> kinds[] = {
      {"GIF89a and so on", "this is a GIF, not a PNG or JPEG file"},
      {"BM and so on", "this is a BMP, not a PNG or JPEG file"},
      {"RIFF1234WEBPVP8 ", "this is a WebP, not a PNG or JPEG file"},
      {std::string("II*\0 and so on", 14), "this is a TIFF, not a PNG or JPEG file"},
      {"text", "this is not a PNG or JPEG file"},
      {"", "the file is empty"}};
  for (const auto& [bytes, words] : kinds) {
    std::ofstream(folder / "a.png", std::ios::binary) << bytes;
    for (const bool whole : {false, true}) try {
        if (whole) read_picture(folder / "a.png");
        picture_info(folder / "a.png");
        ADD_FAILURE() << bytes;
      } catch (const UserError& error) {
        EXPECT_EQ(error.code, Exit::BadInput);
        EXPECT_EQ(error.what(), (folder / "a.png").string() + ": " + words);
      }
  }
}

// The file is sparse: no disk is taken.
TEST(PictureFile, that_is_too_long_is_refused_before_it_is_read) {
  const Folder folder;
  for (const std::string start : {"\x89PNG\r\n\x1a\n", "\xff\xd8\xff\xe0"}) {
    std::ofstream(folder / "a", std::ios::binary) << start;
    std::filesystem::resize_file(folder / "a", 3'000'000'000);
    try {
      read_picture(folder / "a");
      ADD_FAILURE();
    } catch (const UserError& error) {
      EXPECT_EQ(error.code, Exit::BadInput);
      EXPECT_THAT(error.what(), HasSubstr("the file has 3001 MB; at most 80 are read"));
    }
  }
}

} // namespace
} // namespace rend::picture_file_test
