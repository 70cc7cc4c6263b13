// PNG files whose headers claim more than the files contain.
#include "render/files/png_reader.h"

#include "render/files/input_file.h"
#include "render/files/png.h"
#include "sim/base/error.h"
#include "tests/render/needs.h"
#include "tests/render/peak_memory.h"
#include "tests/render/pictures.h"
#include "tests/render/png_files.h"

#include <fstream>
#include <gmock/gmock.h>

namespace rend::malformed_png_test {
namespace {

using namespace test;
using testing::HasSubstr;

std::span<const std::uint8_t> bytes_of(const std::string& file) {
  return {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
}

// The error message; empty if it can be read.
std::string error_message_of(const std::string& file) {
  try {
    read_high_depth_png(bytes_of(file), "a.png");
    check_png(bytes_of(file), "a.png");
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    try {
      check_png(bytes_of(file), "a.png");
    } catch (const UserError& same) {
      EXPECT_STREQ(same.what(), error.what());
      return error.what();
    }
    ADD_FAILURE() << "check_png() finds nothing wrong";
  }
  return "";
}

// Peak memory of either reader.
std::int64_t peak_of_reading(const std::string& file) {
  const Folder folder;
  std::ofstream(folder / "a.png", std::ios::binary) << file;
  const auto whatever = [](const auto& read) {
    try {
      read();
    } catch (const UserError&) {
    }
  };
  return peak_of([&] {
    whatever([&] { read_high_depth_png(bytes_of(file), "a.png"); });
    whatever([&] { read_png(folder / "a.png"); });
  });
}

TEST(PngLies, what_the_data_cannot_hold_is_refused_before_there_is_room_for_it) {
  NEEDS_PNG;
  for (const bool interlaced : {false, true})
    for (const auto& [bits, colour] : {std::pair{16, 6}, {8, 2}, {1, 0}}) {
      const std::string file =
          png_file(header_of(16384, 16384, bits, colour, interlaced), png_chunk("IDAT", deflated("")));
      EXPECT_LT(file.size(), 70u);
      EXPECT_THAT(error_message_of(file), HasSubstr("bytes of data cannot hold them"));
      EXPECT_LT(peak_of_reading(file), 10 * megabyte);
      EXPECT_GE(peak_of_reading(file), 0);
    }
}

TEST(PngLies, of_a_file_that_is_cut_off_that_is_said) {
  NEEDS_PNG;
  const std::string file = black_png(header_of(2000, 2000));
  for (const std::size_t left : {file.size() - 12, file.size() / 2, png_header_bytes + 9, png_header_bytes})
    EXPECT_THAT(error_message_of(file.substr(0, left)), HasSubstr("it is cut off")) << left;
}

TEST(PngLies, memory_grows_with_the_rows_that_are_there) {
  NEEDS_PNG;
  const PngHeader header = header_of(8192, 8192, 16, 6); // 537 MB
  const std::string ten_rows = deflated(std::string(10 * (1 + 8192 * 8), '\0'));
  const std::string file = png_file(header, png_chunk("IDAT", ten_rows + std::string(1'000'000, '\0')));
  EXPECT_THAT(error_message_of(file), HasSubstr("cannot be read"));
  const std::int64_t peak = peak_of_reading(file);
  EXPECT_GE(peak, 0);
  EXPECT_LT(peak, 20 * megabyte);
}

// libpng decides: with one byte fewer it reports missing data.
TEST(PngLies, the_size_of_the_rows_is_that_of_the_format) {
  NEEDS_PNG;
  const std::pair<int, int> kinds[] = {{1, 0},  {2, 0}, {4, 0}, {16, 0}, {8, 2},
                                       {16, 2}, {1, 3}, {4, 3}, {8, 4},  {16, 6}};
  for (const bool interlaced : {false, true})
    for (const auto& [bits, colour] : kinds)
      for (std::uint32_t width = 1; width <= 9; ++width)
        for (std::uint32_t height = 1; height <= 9; ++height) {
          const PngHeader header = header_of(width, height, bits, colour, interlaced);
          const std::size_t size = png_rows_bytes(header);
          const auto with = [&](std::size_t count) {
            const std::string palette = colour == 3 ? png_chunk("PLTE", std::string(3, '\0')) : "";
            return error_message_of(
                png_file(header, palette + png_chunk("IDAT", deflated(std::string(count, '\0')))));
          };
          ASSERT_EQ(with(size), "") << width << " x " << height << ", " << bits << " bits of " << colour;
          ASSERT_THAT(with(size - 1), HasSubstr("ot enough")) << width << " x " << height;
        }
}

TEST(PngLies, what_readers_forgive_is_read_and_the_rest_is_not) {
  NEEDS_PNG;
  const PngHeader header = header_of(5, 4);
  const std::string rows(png_rows_bytes(header), '\0'), data = deflated(rows);
  const std::string idat = png_chunk("IDAT", data);
  const auto file = [&](const std::string& chunks) { return png_file(header, chunks); };
  EXPECT_EQ(error_message_of(file(idat)), "");
  EXPECT_EQ(error_message_of(file(png_chunk("IDAT", data.substr(0, 3)) + png_chunk("IDAT", data.substr(3)))),
            "");
  EXPECT_EQ(error_message_of(file(png_chunk("IDAT", deflated(rows + "more")))), "");
  EXPECT_EQ(error_message_of(file(png_chunk("IDAT", data + "more"))), "");
  EXPECT_EQ(error_message_of(file(idat) + "more"), "");
  EXPECT_EQ(error_message_of(file(png_chunk("gAMA", "no number") + png_chunk("iCCP", "no profile") + idat)),
            "");
  const std::string whole = file(idat);
  EXPECT_THAT(error_message_of(whole.substr(0, whole.size() - 12)), HasSubstr("cut off")); // no IEND
  EXPECT_THAT(error_message_of(file("")), HasSubstr("cannot be read"));                    // no IDAT
  EXPECT_THAT(error_message_of(file(png_chunk("IDAT", "no zlib stream at all"))), HasSubstr("cannot be read"));
  // critical, unknown
  EXPECT_THAT(error_message_of(file(png_chunk("NEED", "") + idat)), HasSubstr("cannot be read"));
  std::string filter = rows;
  filter[0] = 9;
  EXPECT_THAT(error_message_of(file(png_chunk("IDAT", deflated(filter)))), HasSubstr("cannot be read"));
}

// Each text chunk of 8 kB would inflate to megabytes.
TEST(PngLies, texts_are_not_inflated) {
  NEEDS_PNG;
  const std::string text = png_chunk("zTXt", std::string("a\0\0", 3) + deflated(std::string(7'000'000, ' ')));
  std::string many;
  for (int n = 0; n < 50; ++n) many += text;
  const PngHeader header = header_of(5, 4);
  const std::string file =
      png_file(header, many + png_chunk("IDAT", deflated(std::string(png_rows_bytes(header), '\0'))));
  EXPECT_EQ(error_message_of(file), "");
  const std::int64_t peak = peak_of_reading(file);
  EXPECT_GE(peak, 0);
  EXPECT_LT(peak, 20 * megabyte);
}

TEST(PngLies, a_header_tells_what_reading_will_take) {
  NEEDS_PNG;
  const Folder folder;
  for (const auto& [bits, colour] : {std::pair{16, 6}, {8, 6}, {8, 2}, {1, 0}})
    for (const auto& [width, height] : {std::pair{1500u, 1500u}, {2'250'000u, 1u}}) {
      const PngHeader header = header_of(width, height, bits, colour);
      std::ofstream(folder / "a.png", std::ios::binary) << black_png(header);
      const PngInfo head = png_info(folder / "a.png");
      EXPECT_EQ(head.width, static_cast<int>(width));
      EXPECT_EQ(head.file_bytes, std::filesystem::file_size(folder / "a.png"));
      const std::int64_t peak = peak_of([&] {
        const std::vector<std::uint8_t> bytes = file_bytes(folder / "a.png");
        read_high_depth_png(bytes, "a.png");
      });
      EXPECT_GT(peak, 2250000 * 6); // the returned image
      EXPECT_LT(peak, static_cast<std::int64_t>(head.decoding_bytes()) + 5 * megabyte) << bits << " " << width;
      const std::int64_t checked = peak_of([&] { check_png(file_bytes(folder / "a.png"), "a.png"); });
      EXPECT_GE(checked, 0);
      EXPECT_LT(checked, static_cast<std::int64_t>(head.checking_bytes()) + 5 * megabyte)
          << bits << " " << width;
    }
  const std::string file = black_png(header_of(3, 2));
  EXPECT_EQ(png_info(bytes_of(file), "a.png").file_bytes, file.size());
  EXPECT_EQ(png_info(bytes_of(png_file(header_of(0, 2), "")), "a.png").width, 0);
}

} // namespace
} // namespace rend::malformed_png_test
