#include "render/files/jpeg.h"

#include "sim/base/error.h"

#ifdef REND_JPEG
#include "render/files/input_file.h"

#include <algorithm>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <new>
#include <span>
#include <utility>

#include <jpeglib.h> // needs <cstdio> before

#include <jerror.h>

// libjpeg reports errors by longjmp: the functions below that call setjmp have no local objects with
// destructors, and nothing else lies between them and the library.

namespace rend {
namespace {

struct JpegReader {
  explicit JpegReader(const std::filesystem::path& path) : place{path.string()}, file(open_input(path)) {
    cinfo.err = jpeg_std_error(&errors);
    errors.error_exit = on_error;
    errors.emit_message = on_message;
    monitor.progress_monitor = on_progress;
    cinfo.client_data = this;
  }
  ~JpegReader() { jpeg_destroy_decompress(&cinfo); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  UserError refusal() const; // what stopped the library

  Place place;
  InputFile file;
  jpeg_decompress_struct cinfo{};
  jpeg_error_mgr errors{};
  jpeg_progress_mgr monitor{};
  std::jmp_buf back{};
  char message[JMSG_LENGTH_MAX] = {};

private:
  static void on_error(j_common_ptr common) {
    auto* reader = static_cast<JpegReader*>(common->client_data);
    common->err->format_message(common, reader->message);
    std::longjmp(reader->back, 1);
  }
  static void on_message(j_common_ptr common, int level) {
    if (level < 0) on_error(common); // a warning
  }
  static void on_progress(j_common_ptr common) {
    auto* reader = static_cast<JpegReader*>(common->client_data);
    if (reader->cinfo.input_scan_number <= max_jpeg_scans) return;
    std::snprintf(reader->message, sizeof reader->message, "it has more than %d scans", max_jpeg_scans);
    reader->errors.msg_code = 0;
    std::longjmp(reader->back, 1);
  }
};

UserError JpegReader::refusal() const {
  if (std::ferror(file.get())) return {Exit::ReadWrite, place, "it cannot be read"};
  if (errors.msg_code == JERR_OUT_OF_MEMORY) throw std::bad_alloc();
  std::string why = message;
  if (errors.msg_code == JWRN_JPEG_EOF) why = "it is cut off";
  if (errors.msg_code == JERR_BAD_PRECISION)
    why = fmt::format("it has {} bits a channel, not 8", errors.msg_parm.i[0]);
  return {Exit::BadInput, place, "the JPEG cannot be read: " + why};
}

// Reads up to the first scan. False on error; likewise below.
bool read_jpeg_header(JpegReader& reader) {
  if (setjmp(reader.back) != 0) return false;
  jpeg_create_decompress(&reader.cinfo);
  jpeg_stdio_src(&reader.cinfo, reader.file.get());
  jpeg_save_markers(&reader.cinfo, JPEG_APP0 + 1, 0xffff); // EXIF
  jpeg_read_header(&reader.cinfo, TRUE);
  return true;
}

// Of a progressive picture this reads all scans.
bool start_jpeg(JpegReader& reader) {
  if (setjmp(reader.back) != 0) return false;
  jpeg_decompress_struct& cinfo = reader.cinfo;
  cinfo.progress = &reader.monitor;
  cinfo.out_color_space = JCS_RGB;
  cinfo.dct_method = JDCT_ISLOW;
  cinfo.do_fancy_upsampling = FALSE;
  cinfo.do_block_smoothing = FALSE;
  jpeg_start_decompress(&cinfo);
  return true;
}

bool read_jpeg_row(JpegReader& reader, std::uint8_t* row) {
  if (setjmp(reader.back) != 0) return false;
  jpeg_read_scanlines(&reader.cinfo, &row, 1);
  return true;
}

bool finish_jpeg(JpegReader& reader) {
  if (setjmp(reader.back) != 0) return false;
  jpeg_finish_decompress(&reader.cinfo);
  return true;
}

// The numbers of a TIFF structure, in its order of bytes; 0 beyond its end.
struct TiffNumbers {
  std::span<const std::uint8_t> bytes;
  bool little;

  std::size_t at(std::size_t place, std::size_t size) const {
    if (place > bytes.size() || bytes.size() - place < size) return 0;
    std::size_t number = 0;
    for (std::size_t n = 0; n < size; ++n) number = number << 8 | bytes[place + (little ? size - 1 - n : n)];
    return number;
  }
};

// From the content of an APP1 marker: 1 (upright) to 8; 0 where it says nothing.
int orientation_of(std::span<const std::uint8_t> marker) {
  if (marker.size() < 14 || std::memcmp(marker.data(), "Exif\0\0", 6) != 0) return 0;
  const TiffNumbers tiff{marker.subspan(6), marker[6] == 'I'};
  if (std::memcmp(tiff.bytes.data(), tiff.little ? "II*\0" : "MM\0*", 4) != 0) return 0;
  const std::size_t directory = tiff.at(4, 4), count = tiff.at(directory, 2);
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t entry = directory + 2 + 12 * n;
    constexpr std::size_t orientation = 0x112, one_short = 3;
    if (tiff.at(entry, 2) != orientation || tiff.at(entry + 2, 2) != one_short) continue;
    const std::size_t value = tiff.at(entry + 8, 2);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 0;
  }
  return 0;
}

int orientation_of(const jpeg_decompress_struct& cinfo) {
  for (const jpeg_marker_struct* marker = cinfo.marker_list; marker != nullptr; marker = marker->next)
    if (const int orientation = orientation_of(std::span(marker->data, marker->data_length)))
      return orientation;
  return 1;
}

// Rows of the file are then columns of the picture.
bool is_on_its_side(int orientation) {
  return orientation >= 5;
}

Image upright(Image image, int orientation) {
  if (orientation == 1) return image;
  const bool on_side = is_on_its_side(orientation);
  const bool from_right = orientation == 2 || orientation == 3 || orientation == 7 || orientation == 8;
  const bool from_below = orientation == 3 || orientation == 4 || orientation == 6 || orientation == 7;
  Image out(on_side ? image.height : image.width, on_side ? image.width : image.height, image.channels);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x) {
      const int column = on_side ? y : x, row = on_side ? x : y;
      const std::uint8_t* from =
          image.at(from_right ? image.width - 1 - column : column, from_below ? image.height - 1 - row : row);
      std::copy_n(from, image.channels, out.row(y) + x * out.channels);
    }
  return out;
}

void check_kind(const JpegReader& reader) {
  if (reader.cinfo.arith_code != 0)
    throw UserError(Exit::BadInput, reader.place, "the JPEG cannot be read: its coding is arithmetic",
                    "save it as a usual JPEG, baseline or progressive");
  const J_COLOR_SPACE space = reader.cinfo.jpeg_color_space;
  if (space == JCS_GRAYSCALE || space == JCS_YCbCr || space == JCS_RGB) return;
  const std::string what = space == JCS_CMYK || space == JCS_YCCK
                               ? "its colours are those of a printer (CMYK), not RGB"
                               : fmt::format("it has {} channels, not 1 or 3", reader.cinfo.num_components);
  throw UserError(Exit::BadInput, reader.place, "the JPEG cannot be read: " + what);
}

std::size_t blocks_of(const jpeg_decompress_struct& cinfo) { // of 8 x 8 samples
  std::size_t sum = 0;
  for (int n = 0; n < cinfo.num_components; ++n)
    sum += std::size_t{cinfo.comp_info[n].width_in_blocks} * cinfo.comp_info[n].height_in_blocks;
  return sum;
}

// What decoding takes, against what there is. Each block has a code for its lowest coefficient (T.81, F.1.2.1).
void check_needs(JpegReader& reader) {
  const std::size_t file = size_of_file(reader.place.file), blocks = blocks_of(reader.cinfo);
  if (blocks > 8 * file)
    throw UserError(Exit::BadInput, reader.place,
                    fmt::format("the JPEG cannot be read: its header says {} x {} pixels, but its {} bytes "
                                "cannot hold them",
                                reader.cinfo.image_width, reader.cinfo.image_height, file));
  const std::size_t held = file + blocks * sizeof(JBLOCK);
  if (jpeg_has_multiple_scans(&reader.cinfo) != 0 && held > max_jpeg_held)
    throw UserError(Exit::BadInput, reader.place,
                    fmt::format("the JPEG cannot be read: it is progressive, and decoding it takes {} MB "
                                "besides the picture; at most {} are allowed",
                                held / 1'000'000 + 1, max_jpeg_held / 1'000'000),
                    "save it as a baseline JPEG, or smaller");
}

// As it lies in the file.
Image decoded(JpegReader& reader) {
  const JDIMENSION width = reader.cinfo.image_width, height = reader.cinfo.image_height;
  if (std::max(width, height) > JDIMENSION{max_jpeg_side})
    throw UserError(Exit::BadInput, reader.place,
                    fmt::format("its header says {} x {} pixels, but rend reads at most {} x {} of a JPEG",
                                width, height, max_jpeg_side, max_jpeg_side));
  check_needs(reader);
  if (!start_jpeg(reader)) throw reader.refusal();
  Image image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  const std::size_t stride = image.stride();
  image.pixels.reserve(stride * height); // the system gives pages as rows are written
  for (std::size_t y = 0; y < height; ++y) {
    image.pixels.resize(stride * (y + 1));
    if (!read_jpeg_row(reader, image.pixels.data() + stride * y)) throw reader.refusal();
  }
  if (!finish_jpeg(reader)) throw reader.refusal();
  return image;
}

// What read(reader) makes of a file whose header has been read.
template <class F> auto with_header(const std::filesystem::path& path, F&& read) {
  try {
    JpegReader reader(path);
    if (!read_jpeg_header(reader)) throw reader.refusal();
    check_kind(reader);
    return read(reader);
  } catch (const std::bad_alloc&) {
    throw UserError(Exit::OutOfBudget, {path.string()}, "there is not enough memory to read this picture");
  }
}

} // namespace

bool jpeg_available() {
  return true;
}

JpegInfo jpeg_info(const std::filesystem::path& path) {
  return with_header(path, [](const JpegReader& reader) {
    JpegInfo info{static_cast<int>(reader.cinfo.image_width), static_cast<int>(reader.cinfo.image_height)};
    if (is_on_its_side(orientation_of(reader.cinfo))) std::swap(info.width, info.height);
    return info;
  });
}

Image read_jpeg(const std::filesystem::path& path) {
  int orientation = 1;
  Image image = with_header(path, [&](JpegReader& reader) {
    orientation = orientation_of(reader.cinfo);
    return decoded(reader);
  });
  try {
    return upright(std::move(image), orientation);
  } catch (const std::bad_alloc&) {
    throw UserError(Exit::OutOfBudget, {path.string()}, "there is not enough memory to turn this picture");
  }
}

} // namespace rend

#else

namespace rend {
namespace {

[[noreturn]] void refuse_jpeg() {
  throw UserError(Exit::Usage, {}, "this rend was built without JPEG",
                  "save the picture as a PNG file, or build rend with -DREND_JPEG=ON");
}

} // namespace

bool jpeg_available() {
  return false;
}
JpegInfo jpeg_info(const std::filesystem::path&) {
  refuse_jpeg();
}
Image read_jpeg(const std::filesystem::path&) {
  refuse_jpeg();
}

} // namespace rend

#endif
