// JPEG, read by libjpeg-turbo: baseline and progressive, grey, YCbCr and RGB, 8 bits a channel.
//
// The same file gives the same bytes on every machine. The inverse transform is JDCT_ISLOW, and chroma is
// repeated over the pixels that share it: both are integer arithmetic, of which the library's vector code is an
// exact copy (JSIMD_FORCENONE=1 chooses the C code; tests/render/commands/jpeg_command_test.cpp compares them).
// JDCT_FLOAT depends on the machine; interpolated chroma ("fancy") and the smoothing of pictures whose last
// scans are missing have changed between versions of the library, and are switched off.
//
// Cameras store a photograph as the sensor saw it, and in EXIF how it is to be turned: that is done here, so
// that pictures are upright. What libjpeg only warns of, such as data that are cut off, is an error.
//
// What a small file can ask for is bounded before anything is decoded. Each block of 8 x 8 samples takes at
// least a bit, so a header that states more than the file can hold is refused. A progressive file can have any
// number of scans, each of a few bytes and over the whole picture: more than max_jpeg_scans are refused. Its
// coefficients are all held, 2 bytes for each sample: files are refused where these, and the file, whose EXIF
// data are held, would take more than max_jpeg_held bytes. That is so for 4096 x 4096 pixels whose chroma is as
// fine as their luma, but not where 2 x 2 pixels share it, as in photographs. Else memory is that of the
// picture, which grows as rows are read, and of a second one while it is turned. Arithmetic coding, which few
// programs write, is refused: it goes on without data and without a warning.
//
// Source: ITU-T T.81 (JPEG); CIPA DC-008 (EXIF 2.32), 4.6.4, Orientation.
#pragma once

#include "render/files/image.h"

#include <cstddef>
#include <filesystem>

namespace rend {

// False if rend was built without REND_JPEG; the functions below then throw UserError (Usage).
bool jpeg_available();

constexpr int max_jpeg_side = 4096; // [pixels]: read_jpeg() refuses more
constexpr int max_jpeg_scans = 100;
constexpr std::size_t max_jpeg_held = 96'000'000; // [bytes] besides the pixels

// What the header says, before anything is decoded.
struct JpegInfo {
  int width = 0, height = 0; // [pixels], upright
};

// Both throw UserError, at the path. NoInput, ReadWrite; BadInput: it is no JPEG, is damaged, too large or of a
// kind that is not read (CMYK, 12 bits, lossless, arithmetic coding); OutOfBudget: there is not enough memory.
JpegInfo jpeg_info(const std::filesystem::path& path);
Image read_jpeg(const std::filesystem::path& path); // RGB, upright

} // namespace rend
