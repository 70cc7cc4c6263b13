// JPEG files for tests, encoded by libjpeg and taken apart by markers.
#pragma once

#include "render/files/image.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#ifdef REND_JPEG
#include <jpeglib.h> // needs <cstdio> before
#endif

namespace rend::test {

enum class JpegColours { Ycc, Grey, Rgb, Cmyk };

struct JpegKind {
  int quality = 100;
  bool progressive = false;
  int across = 1, down = 1; // pixels that share a sample of chroma
  JpegColours colours = JpegColours::Ycc;
  int scans = 0; // progressive: so many, where not 0
};

#ifdef REND_JPEG
// The first has the lowest coefficient of all channels, each other one coefficient of one channel.
inline std::vector<jpeg_scan_info> jpeg_scans(int channels, int count) {
  jpeg_scan_info first{};
  first.comps_in_scan = channels;
  for (int c = 0; c < channels; ++c) first.component_index[c] = c;
  std::vector<jpeg_scan_info> scans{first};
  for (int n = 0; n + 1 < count; ++n) {
    jpeg_scan_info one{};
    one.comps_in_scan = 1;
    one.component_index[0] = n / 63;
    one.Ss = one.Se = 1 + n % 63;
    scans.push_back(one);
  }
  return scans;
}

inline void set_jpeg_kind(jpeg_compress_struct& cinfo, const JpegKind& kind) {
  jpeg_set_defaults(&cinfo);
  if (kind.colours == JpegColours::Grey) jpeg_set_colorspace(&cinfo, JCS_GRAYSCALE);
  if (kind.colours == JpegColours::Rgb) jpeg_set_colorspace(&cinfo, JCS_RGB);
  jpeg_set_quality(&cinfo, kind.quality, TRUE);
  cinfo.comp_info[0].h_samp_factor = kind.across;
  cinfo.comp_info[0].v_samp_factor = kind.down;
  if (kind.progressive) jpeg_simple_progression(&cinfo);
}

inline std::string jpeg_file(const Image& image, const JpegKind& kind = {}) {
  jpeg_compress_struct cinfo{};
  jpeg_error_mgr errors{};
  cinfo.err = jpeg_std_error(&errors); // which ends the program
  jpeg_create_compress(&cinfo);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&cinfo, &bytes, &size);
  const bool cmyk = kind.colours == JpegColours::Cmyk; // of an image of four channels
  cinfo.image_width = static_cast<JDIMENSION>(image.width);
  cinfo.image_height = static_cast<JDIMENSION>(image.height);
  cinfo.input_components = image.channels;
  cinfo.in_color_space = cmyk ? JCS_CMYK : JCS_RGB;
  set_jpeg_kind(cinfo, kind);
  const auto scans = jpeg_scans(cinfo.num_components, kind.scans);
  if (kind.scans > 0) {
    cinfo.scan_info = scans.data();
    cinfo.num_scans = static_cast<int>(scans.size());
  }
  jpeg_start_compress(&cinfo, TRUE);
  for (int y = 0; y < image.height; ++y) {
    auto* row = const_cast<std::uint8_t*>(image.row(y)); // which it only reads
    jpeg_write_scanlines(&cinfo, &row, 1);
  }
  jpeg_finish_compress(&cinfo);
  std::string file(reinterpret_cast<const char*>(bytes), size);
  jpeg_destroy_compress(&cinfo);
  std::free(bytes);
  return file;
}
#else // tests that need it skip themselves
inline std::string jpeg_file(const Image&, const JpegKind& = {}) {
  return "";
}
#endif

// The file in parts: SOI; each marker with its segment and, of SOS, the data that follow; EOI.
inline std::vector<std::string> jpeg_parts(const std::string& file) {
  const auto byte = [&](std::size_t n) { return static_cast<std::uint8_t>(file[n]); };
  std::vector<std::string> parts{file.substr(0, 2)};
  std::size_t at = 2;
  while (at + 4 <= file.size()) {
    std::size_t end = at + 2 + 256u * byte(at + 2) + byte(at + 3);
    if (byte(at + 1) == 0xda) // of the data 0xff 0x00 and restart markers are parts
      while (end + 2 < file.size() &&
             (byte(end) != 0xff || byte(end + 1) == 0 || (byte(end + 1) & 0xf8) == 0xd0))
        ++end;
    parts.push_back(file.substr(at, end - at));
    at = end;
  }
  parts.push_back(file.substr(at));
  return parts;
}

inline bool is_jpeg_frame_header(const std::string& part) { // SOF0 to SOF2
  return part.size() > 9 && part[0] == '\xff' && part[1] >= '\xc0' && part[1] <= '\xc2';
}

// With other numbers in its frame header: whether the file has so many pixels or not.
inline std::string jpeg_claiming(const std::string& file, int width, int height, int bits = 8) {
  std::string out;
  for (std::string part : jpeg_parts(file)) {
    if (is_jpeg_frame_header(part)) {
      part[4] = static_cast<char>(bits);
      part[5] = static_cast<char>(height >> 8);
      part[6] = static_cast<char>(height);
      part[7] = static_cast<char>(width >> 8);
      part[8] = static_cast<char>(width);
    }
    out += part;
  }
  return out;
}

// With a segment (marker and length included) after SOI.
inline std::string jpeg_with(const std::string& file, const std::string& segment) {
  return file.substr(0, 2) + segment + file.substr(2);
}

// An APP1 segment of EXIF that has a width and an orientation.
inline std::string exif_segment(int orientation, bool little) {
  const auto number = [&](int value, int size) {
    std::string out;
    for (int n = 0; n < size; ++n) out += static_cast<char>(value >> 8 * (little ? n : size - 1 - n));
    return out;
  };
  const std::string tiff = (little ? "II" : "MM") + number(42, 2) + number(8, 4) + number(2, 2) +
                           number(0x100, 2) + number(4, 2) + number(1, 4) + number(3, 4) + // ImageWidth
                           number(0x112, 2) + number(3, 2) + number(1, 4) + number(orientation, 2) +
                           number(0, 2) + number(0, 4);
  const std::string content = std::string("Exif\0\0", 6) + tiff;
  const int length = static_cast<int>(content.size()) + 2;
  return std::string("\xff\xe1") + static_cast<char>(length >> 8) + static_cast<char>(length) + content;
}

} // namespace rend::test
