// Files of pictures that somebody else has changed: bytes flipped, cut off, with false sizes, with parts twice,
// left out or exchanged, with hundreds of scans. As textures each is read, or refused in words that name the
// file and say what would work; none takes memory out of proportion.
#include "render/files/png.h"
#include "render/picture/texture_file.h"
#include "sim/base/error.h"
#include "tests/render/jpeg_files.h"
#include "tests/render/needs.h"
#include "tests/render/peak_memory.h"
#include "tests/render/pictures.h"
#include "tests/render/png_files.h"

#include <fstream>
#include <functional>
#include <gmock/gmock.h>
#include <random>

namespace rend::evil_picture_test {
namespace {

using namespace test;
using testing::HasSubstr;

constexpr int mutations = 200; // of each of PNG, baseline and progressive JPEG

// Whole numbers below a bound, the same on every machine.
class Dice {
public:
  explicit Dice(unsigned seed) : random_(seed) {}
  std::size_t below(std::size_t bound) { return random_() % bound; }
  char byte() { return static_cast<char>(below(256)); }
  template <class T> const T& one_of(const std::vector<T>& all) { return all[below(all.size())]; }

private:
  std::mt19937 random_;
};

constexpr std::pair<int, int> false_sizes[] = {{4096, 4096}, {65535, 65535}, {0, 0},    {0, 47},
                                               {61, 0},      {1, 65535},     {4096, 1}, {62, 48}};

// A file in parts: segments or chunks, which can be put together otherwise.
using Parts = std::vector<std::string>;

std::string joined(const Parts& parts) {
  std::string file;
  for (const std::string& part : parts) file += part;
  return file;
}

void flip_bytes(std::string& bytes, Dice& dice) {
  for (std::size_t n = 1 + dice.below(8); n > 0 && !bytes.empty(); --n)
    bytes[dice.below(bytes.size())] = dice.byte();
}

// What does not depend on the format. The first part, a signature, stays.
std::string rearranged(Parts parts, Dice& dice) {
  const std::size_t at = 1 + dice.below(parts.size() - 1), other = 1 + dice.below(parts.size() - 1);
  switch (dice.below(5)) {
  case 0:
    flip_bytes(parts[at], dice);
    break;
  case 1: {
    const std::string whole = joined(parts);
    return whole.substr(0, dice.below(whole.size()));
  }
  case 2:
    for (std::size_t n = 1 + dice.below(300); n > 0; --n)
      parts.insert(parts.begin() + static_cast<std::ptrdiff_t>(at), std::string(parts[at]));
    break;
  case 3:
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(at));
    break;
  default:
    std::swap(parts[at], parts[other]);
  }
  return joined(parts);
}

Parts png_parts(const std::string& file) {
  PngBytes rest{reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
  Parts parts{file.substr(0, png_signature_bytes)};
  rest = rest.subspan(png_signature_bytes);
  while (!rest.empty()) {
    const std::size_t before = rest.size();
    take_png_chunk(rest);
    parts.push_back(file.substr(file.size() - before, before - rest.size()));
  }
  return parts;
}

// Changes that a CRC would not tell.
std::string png_with_right_crcs(Parts parts, Dice& dice) {
  const auto change = [](std::string& part, const std::function<void(std::string&)>& how) {
    std::string data = part.substr(8, part.size() - 12);
    how(data);
    part = png_chunk(part.substr(4, 4), data);
  };
  if (dice.below(2) == 0) {
    const auto [width, height] = false_sizes[dice.below(std::size(false_sizes))];
    change(parts[1], [&](std::string& data) {
      data.replace(
          0, 8, png_number(static_cast<std::uint32_t>(width)) + png_number(static_cast<std::uint32_t>(height)));
    });
    return joined(parts);
  }
  change(parts[1 + dice.below(parts.size() - 1)], [&](std::string& data) { flip_bytes(data, dice); });
  return joined(parts);
}

std::string text_of(const std::vector<std::uint8_t>& bytes) {
  return {bytes.begin(), bytes.end()};
}

std::vector<std::string> evil_pngs() {
  const std::vector<std::string> good{text_of(encode_png(pattern(61, 47))),
                                      text_of(encode_png(pattern(61, 47, 4), {"Title", "a pattern"})),
                                      black_png(header_of(61, 47, 4, 3, true)),
                                      black_png(header_of(61, 47, 16, 6)), black_png(header_of(61, 47, 1, 0))};
  Dice dice(1);
  std::vector<std::string> files;
  while (files.size() < mutations) {
    const Parts parts = png_parts(dice.one_of(good));
    files.push_back(dice.below(2) == 0 ? rearranged(parts, dice) : png_with_right_crcs(parts, dice));
  }
  return files;
}

std::vector<std::string> evil_jpegs(bool progressive) {
  std::vector<std::string> good;
  for (const int shared : {1, 2})
    good.push_back(jpeg_file(pattern(61, 47),
                             {.quality = 80, .progressive = progressive, .across = shared, .down = shared}));
  good.push_back(jpeg_file(pattern(61, 47), {.progressive = progressive, .colours = JpegColours::Grey}));
  good.push_back(jpeg_with(good.back(), exif_segment(6, true)));
  if (progressive) good.push_back(jpeg_file(pattern(61, 47), {.progressive = true, .scans = 190}));
  Dice dice(progressive ? 2 : 3);
  std::vector<std::string> files;
  while (files.size() < mutations) {
    const std::string& file = dice.one_of(good);
    const auto [width, height] = false_sizes[dice.below(std::size(false_sizes))];
    files.push_back(dice.below(4) == 0 ? jpeg_claiming(file, width, height)
                                       : rearranged(jpeg_parts(file), dice));
  }
  return files;
}

// As a scene does: checked, read, and made into levels.
void use(const std::filesystem::path& folder, const std::string& file) {
  std::ofstream(folder / "picture", std::ios::binary) << file;
  LookSettings look;
  look.folder = folder;
  look.texture = "picture";
  check_textures(look, false);
  const LookTextures textures = TextureFiles().of(look);
  if (textures.front->levels.back().texels.size() < 3) throw std::logic_error("a texture without texels");
}

void expect_read_or_refused(const std::vector<std::string>& files) {
  const Folder folder;
  int read = 0, refused = 0;
  for (std::size_t n = 0; n < files.size(); ++n) try {
      use(folder.path(), files[n]);
      ++read;
    } catch (const UserError& error) {
      ++refused;
      EXPECT_EQ(error.code, Exit::BadInput) << n << ": " << error.what();
      EXPECT_THAT(error.what(), HasSubstr("picture")) << n;
      EXPECT_GT(std::string(error.what()).size(), 20U) << n << ": " << error.what();
      EXPECT_NE(error.hint, "") << n << ": " << error.what();
    }
  EXPECT_EQ(read + refused, mutations);
  EXPECT_GE(read, mutations / 20) << "the changes are too coarse";
  EXPECT_GE(refused, mutations / 3) << "the changes are too fine";
  const std::int64_t peak = peak_of([&] {
    for (const std::string& file : files) try {
        use(folder.path(), file);
      } catch (const UserError&) {
      }
  });
  EXPECT_GE(peak, 0);
  EXPECT_LE(peak, 100 * megabyte);
  testing::Test::RecordProperty("read", read);
  testing::Test::RecordProperty("peak_bytes", std::to_string(peak));
}

TEST(EvilPicture, that_was_a_png_is_read_or_refused) {
  NEEDS_PNG;
  expect_read_or_refused(evil_pngs());
}

TEST(EvilPicture, that_was_a_jpeg_is_read_or_refused) {
  NEEDS_JPEG;
  expect_read_or_refused(evil_jpegs(false));
}

TEST(EvilPicture, that_was_a_progressive_jpeg_is_read_or_refused) {
  NEEDS_JPEG;
  expect_read_or_refused(evil_jpegs(true));
}

// Honest files of the largest size, all the way to the levels.
TEST(EvilPicture, of_the_largest_size_takes_at_most_100_MB) {
  NEEDS_PNG;
  NEEDS_JPEG;
  const Folder folder;
  Image flat(largest_texture, largest_texture);
  std::fill(flat.pixels.begin(), flat.pixels.end(), std::uint8_t{90});
  const std::string files[] = {text_of(encode_png(flat)), jpeg_file(flat, {.across = 2, .down = 2})};
  for (const std::string& file : files) {
    const std::int64_t peak = peak_of([&] { use(folder.path(), file); });
    EXPECT_GT(peak, 50 * megabyte);
    EXPECT_LE(peak, 100 * megabyte);
    RecordProperty(file == files[0] ? "png" : "jpeg", std::to_string(peak));
  }
}

} // namespace
} // namespace rend::evil_picture_test
