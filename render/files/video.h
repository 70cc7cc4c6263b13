// Video, by libav: the formats of video_format.h.
//
// The same pictures give the same file, byte for byte: a fixed number of threads, bit-exact flags for codec,
// muxer and colour conversion, no dates and no program names.
//
// During encoding the video is NAME.part.EXT in the same folder, flushed after every packet, so that a killed
// run leaves a file that plays. At the end it is renamed; a video that is cut short keeps that name. An .mp4 is
// written in fragments first, and at the end remuxed with its index in front (fast start), so that browsers
// start playing at once.
#pragma once

#include "render/files/image.h"

#include <filesystem>
#include <memory>
#include <string>

namespace rend {

// False if rend was built without REND_VIDEO; VideoWriter::open then throws UserError (Usage).
bool video_available();

// Checks that a video format, given by its name or file extension, can be written. Throws UserError: Usage for
// an unknown format or a build without video, CannotCreate where this machine's FFmpeg libraries lack the
// encoder, muxer or filters.
void require_video(const std::string& name);
struct VideoFormat;
void require_encoder(const VideoFormat& format); // only the check of the FFmpeg libraries

class VideoWriter {
public:
  VideoWriter();
  ~VideoWriter(); // without close() the file is removed
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;

  // width, height [pixels], fps [1/s]. transparent: pictures have alpha, and so has the video; CHECK: the
  // format has it. Throws UserError: Usage for an unknown file type or a build without video, CannotCreate
  // where the file cannot be created.
  void open(const std::filesystem::path& path, int width, int height, double fps, bool transparent = false);
  void add(const Image& image); // CHECK: of the size and channels given to open. Throws UserError (ReadWrite)
  void close();                 // renames the finished file. Throws UserError (ReadWrite)
  void
  stop(); // ends the video before its last frame: it plays, and stays partial_video(path). Throws as close()
  bool is_open() const;

private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

} // namespace rend
