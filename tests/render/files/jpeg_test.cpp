// JPEG files: against the pictures that they were encoded from, and against the words of EXIF.
#include "render/files/jpeg.h"

#include "sim/base/error.h"
#include "tests/render/jpeg_files.h"
#include "tests/render/needs.h"
#include "tests/render/peak_memory.h"
#include "tests/render/pictures.h"

#include <fstream>
#include <functional>
#include <gmock/gmock.h>

namespace rend::jpeg_test {
namespace {

using namespace test;
using testing::HasSubstr;

// What it is read as.
class Written {
public:
  explicit Written(const std::string& file) { std::ofstream(path(), std::ios::binary) << file; }
  Image image() const { return read_jpeg(path()); }
  JpegInfo info() const { return jpeg_info(path()); }
  std::filesystem::path path() const { return folder_ / "a.jpg"; }

  std::string error_message() const { // empty if it can be read
    try {
      image();
      return "";
    } catch (const UserError& error) {
      EXPECT_EQ(error.code, Exit::BadInput);
      EXPECT_THAT(error.what(), HasSubstr(path().string()));
      return error.what();
    }
  }

private:
  Folder folder_;
};

// Without steps, so that little is lost.
Image smooth(int width, int height) {
  Image image(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint8_t* pixel = image.row(y) + 3 * x;
      pixel[0] = static_cast<std::uint8_t>(40 + 160 * x / width);
      pixel[1] = static_cast<std::uint8_t>(200 - 150 * y / height);
      pixel[2] = static_cast<std::uint8_t>(60 + 60 * x / width + 60 * y / height);
    }
  return image;
}

Image grey(Image image) {
  for (std::size_t n = 0; n < image.pixels.size(); n += 3) {
    const double y = 0.299 * image.pixels[n] + 0.587 * image.pixels[n + 1] + 0.114 * image.pixels[n + 2];
    std::fill_n(image.pixels.begin() + static_cast<std::ptrdiff_t>(n), 3, static_cast<std::uint8_t>(y + 0.5));
  }
  return image;
}

TEST(Jpeg, is_read_as_the_picture_that_was_encoded) {
  NEEDS_JPEG;
  for (const auto& [width, height] : {std::pair{64, 48}, {61, 43}, {1, 1}, {7, 130}}) {
    const Image image = smooth(width, height);
    for (const bool progressive : {false, true}) {
      const auto difference = [&](const Image& expected, JpegKind kind) {
        kind.progressive = progressive;
        const Written file(jpeg_file(image, kind));
        EXPECT_EQ(file.info().width, width);
        EXPECT_EQ(file.info().height, height);
        const Image now = file.image();
        if (now.width != width || now.height != height || now.channels != 3) return 256;
        return largest_difference(now, expected);
      };
      EXPECT_LE(difference(image, {}), 4);
      EXPECT_LE(difference(image, {.colours = JpegColours::Rgb}), 3);
      EXPECT_LE(difference(grey(image), {.colours = JpegColours::Grey}), 2);
      if (std::min(width, height) < 40) continue; // chroma changes too fast in the others to be shared
      for (const auto& [across, down] : {std::pair{2, 1}, {1, 2}, {2, 2}, {4, 1}})
        EXPECT_LE(difference(image, {.across = across, .down = down}), 13) << across << " x " << down;
    }
  }
}

// Both hold the same coefficients.
TEST(Jpeg, progressive_and_baseline_files_of_one_picture_are_read_alike) {
  NEEDS_JPEG;
  const Image image = pattern(75, 53, 3, 1);
  for (const int quality : {30, 90})
    for (const auto& [across, down] : {std::pair{1, 1}, {2, 1}, {2, 2}}) {
      const JpegKind baseline{.quality = quality, .across = across, .down = down};
      JpegKind progressive = baseline;
      progressive.progressive = true;
      EXPECT_EQ(Written(jpeg_file(image, baseline)).image(), Written(jpeg_file(image, progressive)).image());
    }
}

// CIPA DC-008, Orientation: which side of the scene the file's first row and first column are.
TEST(Jpeg, is_turned_upright_as_its_exif_data_say) {
  NEEDS_JPEG;
  enum Side { Top, Bottom, Left, Right };
  const std::pair<Side, Side> rows_and_columns[] = {{Top, Left}, {Top, Right}, {Bottom, Right}, {Bottom, Left},
                                                    {Left, Top}, {Right, Top}, {Right, Bottom}, {Left, Bottom}};
  const Image scene = smooth(24, 40);
  for (int orientation = 1; orientation <= 8; ++orientation) {
    const auto [first_row, first_column] = rows_and_columns[orientation - 1];
    const bool on_side = first_row == Left || first_row == Right;
    Image stored(on_side ? scene.height : scene.width, on_side ? scene.width : scene.height);
    for (int row = 0; row < stored.height; ++row)
      for (int column = 0; column < stored.width; ++column) {
        int x = 0, y = 0;
        for (const auto& [side, from] : {std::pair{first_row, row}, {first_column, column}}) {
          if (side == Top) y = from;
          if (side == Bottom) y = scene.height - 1 - from;
          if (side == Left) x = from;
          if (side == Right) x = scene.width - 1 - from;
        }
        std::copy_n(scene.at(x, y), 3, stored.row(row) + 3 * column);
      }
    for (const bool little : {false, true}) {
      const Written file(jpeg_with(jpeg_file(stored), exif_segment(orientation, little)));
      EXPECT_EQ(file.info().width, scene.width) << orientation;
      EXPECT_EQ(file.info().height, scene.height) << orientation;
      const Image now = file.image();
      ASSERT_EQ(now.width, scene.width) << orientation;
      ASSERT_EQ(now.height, scene.height) << orientation;
      EXPECT_LE(largest_difference(now, scene), 4) << orientation;
    }
  }
}

TEST(Jpeg, is_left_as_it_is_where_its_exif_data_are_damaged) {
  NEEDS_JPEG;
  const Image image = smooth(24, 16);
  const std::string file = jpeg_file(image);
  const auto is_as_it_is = [&](const std::string& segment) {
    return Written(jpeg_with(file, segment)).image() == Written(file).image();
  };
  EXPECT_FALSE(is_as_it_is(exif_segment(6, true)));
  for (const int orientation : {0, 9, 700}) EXPECT_TRUE(is_as_it_is(exif_segment(orientation, true)));
  std::string lost = exif_segment(6, true); // the directory lies beyond the end
  lost[4 + 6 + 4 + 3] = '\x7f';
  EXPECT_TRUE(is_as_it_is(lost));
  std::string unknown = exif_segment(6, true); // neither order of bytes
  unknown[4 + 6] = 'X';
  EXPECT_TRUE(is_as_it_is(unknown));
  const std::string whole = exif_segment(6, true);
  for (std::size_t length = 0; length + 10 < whole.size(); ++length) { // cut off within the segment
    std::string part = whole.substr(0, 4 + length);
    if (part.size() >= whole.size() - 8) break;
    part[2] = static_cast<char>((length + 2) >> 8);
    part[3] = static_cast<char>(length + 2);
    EXPECT_TRUE(is_as_it_is(part)) << length;
  }
}

TEST(Jpeg, of_a_kind_that_is_not_read_is_refused_in_words) {
  NEEDS_JPEG;
  const std::string good = jpeg_file(smooth(24, 16));
  const auto message = [](const std::string& file) { return Written(file).error_message(); };
  EXPECT_EQ(message(good), "");
  EXPECT_THAT(message(jpeg_file(pattern(24, 16, 4), {.colours = JpegColours::Cmyk})), HasSubstr("(CMYK)"));
  std::string arithmetic = good;
  arithmetic.replace(good.find("\xff\xc0"), 2, "\xff\xc9"); // SOF9
  EXPECT_THAT(message(arithmetic), HasSubstr("arithmetic"));
  EXPECT_THAT(message(jpeg_claiming(good, 24, 16, 12)), HasSubstr("it has 12 bits a channel, not 8"));
  EXPECT_THAT(message(jpeg_claiming(good, 4097, 16)),
              HasSubstr("4097 x 16 pixels, but rend reads at most 4096"));
  EXPECT_THAT(message(jpeg_claiming(good, 65535, 65535)), HasSubstr("image dimension"));
  EXPECT_THAT(message(jpeg_claiming(good, 0, 0)), HasSubstr("cannot be read"));
  EXPECT_THAT(message("\xff\xd8\xff\xd9"), HasSubstr("cannot be read"));
  EXPECT_THAT(message("no JPEG"), HasSubstr("cannot be read"));
  EXPECT_THAT(message(""), HasSubstr("cannot be read"));
}

TEST(Jpeg, that_is_cut_off_anywhere_is_refused) {
  NEEDS_JPEG;
  for (const bool progressive : {false, true}) {
    const std::string file = jpeg_file(pattern(40, 24), {.quality = 80, .progressive = progressive});
    for (std::size_t left = 0; left < file.size(); ++left)
      ASSERT_NE(Written(file.substr(0, left)).error_message(), "") << left << " of " << file.size();
    EXPECT_THAT(Written(file.substr(0, file.size() - 2)).error_message(), HasSubstr("it is cut off"));
    EXPECT_EQ(Written(file + "more").error_message(), ""); // previews lie behind the pictures of phones
  }
}

TEST(Jpeg, has_at_most_a_hundred_scans) {
  NEEDS_JPEG;
  const Image image = smooth(24, 16);
  const auto with = [&](int scans) {
    return Written(jpeg_file(image, {.progressive = true, .scans = scans})).error_message();
  };
  EXPECT_EQ(with(100), "");
  EXPECT_THAT(with(101), HasSubstr("more than 100 scans"));
  EXPECT_THAT(with(190), HasSubstr("more than 100 scans"));
}

// One is as its header says, but of chroma as fine as its luma; the others lie.
TEST(Jpeg, that_would_take_more_memory_than_its_pixels_justify_is_refused_before_it_is_decoded) {
  NEEDS_JPEG;
  // The process itself, whose pages come and go, takes some megabytes; the pixels would take 50.
  const Written fine(jpeg_file(smooth(4096, 4096), {.quality = 50, .progressive = true}));
  EXPECT_THAT(fine.error_message(), HasSubstr("it is progressive, and decoding it takes 10"));
  EXPECT_LT(peak_of([&] { EXPECT_NE(fine.error_message(), ""); }), 8 * megabyte);
  for (const bool progressive : {false, true}) {
    const Written small(jpeg_claiming(jpeg_file(smooth(64, 64), {.progressive = progressive}), 4096, 4096));
    EXPECT_THAT(small.error_message(), HasSubstr("bytes cannot hold them"));
    EXPECT_LT(peak_of([&] { EXPECT_NE(small.error_message(), ""); }), 8 * megabyte);
  }
}

TEST(Jpeg, takes_the_memory_of_its_pixels_and_what_progressive_coefficients_take) {
  NEEDS_JPEG;
  constexpr std::int64_t pixels = 4096 * 4096, coefficients = 2 * pixels * 3 / 2; // of luma, and two quarters
  for (const bool progressive : {false, true}) {
    const Written file(
        jpeg_file(smooth(4096, 4096), {.quality = 90, .progressive = progressive, .across = 2, .down = 2}));
    const std::int64_t peak = peak_of([&] { file.image(); });
    EXPECT_GT(peak, 3 * pixels);
    EXPECT_LT(peak, 3 * pixels + (progressive ? coefficients : 0) + 4 * megabyte);
  }
}

} // namespace
} // namespace rend::jpeg_test
