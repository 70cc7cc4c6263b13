// What --resume keeps: valid pictures, but not files that only look like pictures.
#include "render/files/png.h"
#include "tests/render/clip/stopped_clip.h"
#include "tests/render/needs.h"
#include "tests/render/pictures.h"
#include "tests/render/png_files.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>

namespace rend::resume_malformed_test {
namespace {

using namespace test;
using program::content;
using program::Files;
using program::Outcome;
using testing::HasSubstr;
namespace fs = std::filesystem;

class ResumeLies : public program::StoppedClip {
protected:
  void SetUp() override {
    NEEDS_PNG;
    all = alone();
    ASSERT_EQ(all.size(), 31u);
  }
  static std::string name_of(int frame) { return fmt::format("{:05d}.png", frame); }
  // A chunk of the picture of a frame, with its mark.
  std::string chunk(int frame, const std::string& name) const {
    const std::string& file = all.at(name_of(frame));
    PngBytes rest(reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
    rest = rest.subspan(png_signature_bytes);
    while (const auto found = take_png_chunk(rest))
      if (found->name == name) return png_chunk(name, data_of(*found));
    ADD_FAILURE() << "no " << name;
    return "";
  }
  static std::string data_of(const PngChunk& chunk) {
    return {reinterpret_cast<const char*>(chunk.data.data()), chunk.data.size()};
  }
  std::string data(int frame, const std::string& name) const {
    const std::string whole = chunk(frame, name);
    return whole.substr(8, whole.size() - 12);
  }
  void put(int frame, const PngHeader& says, const std::string& chunks) const {
    place.write("alone/" + name_of(frame), png_file(says, chunk(frame, "tEXt") + chunks));
  }
  static std::string idat(const std::string& of) { return png_chunk("IDAT", deflated(of)); }

  const PngHeader header = header_of(64, 48);
  const std::string rows = std::string(48 * (1 + 64 * 3), '\0');
  Files all;
};

TEST_F(ResumeLies, what_has_the_right_mark_and_is_no_picture_of_this_size_is_made_anew) {
  put(1, header, "");                                                    // no pixels
  put(2, header_of(32, 24), idat(std::string(24 * (1 + 32 * 3), '\0'))); // a smaller one
  put(3, header_of(48, 64), idat(std::string(64 * (1 + 48 * 3), '\0')));
  put(4, header_of(64, 48, 8, 6), idat(std::string(48 * (1 + 64 * 4), '\0'))); // with alpha
  put(5, header_of(64, 48, 16), idat(std::string(48 * (1 + 64 * 6), '\0')));
  put(6, header_of(64, 48, 8, 0), idat(std::string(48 * (1 + 64), '\0'))); // grey
  put(7, header_of(64, 48, 8, 2, true), idat(std::string(png_rows_bytes(header_of(64, 48, 8, 2, true)), '\0')));
  put(8, header, png_chunk("IDAT", "no zlib stream"));
  put(9, header, idat(rows.substr(1)));
  put(10, header, idat(rows + "x"));
  put(11, header, png_chunk("IDAT", deflated(rows) + "x"));
  std::string filter = rows;
  filter[47 * (1 + 64 * 3)] = 5; // of the last row
  put(12, header, idat(filter));
  std::string data = deflated(rows);
  data.back() = static_cast<char>(data.back() ^ 1); // breaks the checksum of the zlib stream
  put(13, header, png_chunk("IDAT", data));
  put(14, header, png_chunk("tRNS", std::string(6, '\0')) + idat(rows));
  put(15, header, png_chunk("NEED", "") + idat(rows));
  const std::string whole = deflated(rows);
  put(16, header,
      png_chunk("IDAT", whole.substr(0, 9)) + png_chunk("tIME", "") + png_chunk("IDAT", whole.substr(9)));
  put(17, header_of(16384, 16384, 16, 6), png_chunk("IDAT", deflated("")));
  fs::resize_file(place.path() / "alone" / name_of(18), std::uintmax_t{1} << 40); // mostly a hole (sparse)
  const Outcome outcome = place.rend("render clip.xml --resume -o alone --json");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.json()["frames"], 18);
  EXPECT_EQ(outcome.json()["kept"], 13);
  expect_same(in("alone"), all, "");
}

TEST_F(ResumeLies, the_same_pixels_in_other_chunks_are_kept) {
  const std::string stream = data(1, "IDAT");
  put(1, header,
      png_chunk("IDAT", stream.substr(0, 7)) + png_chunk("IDAT", "") + png_chunk("IDAT", stream.substr(7)));
  put(2, header, png_chunk("tIME", std::string(7, '\1')) + chunk(2, "IDAT") + png_chunk("zTXt", "a note"));
  fs::rename(place.path() / "alone" / name_of(3), place.path() / "elsewhere.png");
  fs::create_symlink("../elsewhere.png", place.path() / "alone" / name_of(3));
  const Files before = in("alone");
  for (const char* threads : {"1", "4"}) {
    const Outcome outcome =
        place.rend(std::string("render clip.xml --resume -o alone --json --threads ") + threads);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.json()["kept"], 31);
    EXPECT_TRUE(in("alone") == before);
    EXPECT_TRUE(fs::is_symlink(place.path() / "alone" / name_of(3)));
  }
}

// If the clip has alpha, a picture without alpha does not match.
TEST_F(ResumeLies, transparent_pictures_are_kept_too) {
  const std::string line = "render clip.xml -q --set image.background=none -o clear --frames 0-9 --json";
  EXPECT_EQ(place.rend(line).code, 0);
  const Files clear = in("clear");
  const std::string& first = clear.at("00000.png");
  const std::string text =
      first.substr(first.find("rend:scene"), first.find("IDAT") - 8 - first.find("rend:scene"));
  place.write("clear/00000.png", png_file(header, png_chunk("tEXt", text) + idat(rows)));
  const Outcome outcome = place.rend(line + " --resume");
  EXPECT_EQ(outcome.json()["kept"], 9);
  expect_same(in("clear"), clear, "");
}

// Something else at a picture's path is refused, as without --resume, and does not block the run.
TEST_F(ResumeLies, pipes_and_folders_are_no_pictures) {
  for (const char* made : {"mkfifo", "mkdir"}) {
    const fs::path path = place.path() / "alone" / name_of(5);
    fs::remove(path);
    EXPECT_EQ(place.shell(std::string(made) + " " + path.string()).code, 0);
    const Outcome outcome =
        place.shell(std::string("timeout 60 ") + test::rend_program + " render clip.xml -q --resume -o alone");
    EXPECT_EQ(outcome.code, 73) << made << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("00005.png"));
  }
}

} // namespace
} // namespace rend::resume_malformed_test
