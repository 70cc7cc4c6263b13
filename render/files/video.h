// Video, by libav: the formats of video_format.h.
//
// The same pictures give the same file, byte for byte: a fixed number of threads, the bit-exact flags of codec,
// container and colour conversion, no dates and no names of programs.
//
// While pictures come the video stands beside its place as NAME.part.EXT, written through picture by picture,
// so that a run that is killed leaves something that plays. At the end it appears under its name, whole: an
// .mp4, written in fragments until then, once more with its index in front, since a browser then starts at
// once.
#pragma once

#include "render/files/image.h"

#include <filesystem>
#include <memory>
#include <string>

namespace rend {

// False where rend was built without REND_VIDEO; VideoWriter::open then throws UserError (Usage).
bool video_available();

// Whether a kind of video, by its name or its file's extension, can be written. Throws UserError: Usage where
// there is no such kind or rend was built without video, CannotCreate where this machine's FFmpeg libraries
// lack what it takes.
void require_video(const std::string& name);
struct VideoFormat;
void require_encoder(const VideoFormat& format); // the last part of that

class VideoWriter {
public:
  VideoWriter();
  ~VideoWriter(); // without close() nothing is left behind
  VideoWriter(VideoWriter&&) noexcept;
  VideoWriter& operator=(VideoWriter&&) noexcept;

  // width, height [pixels], fps [1/s]. Throws UserError: Usage for a file type that is not known or a rend
  // without video, CannotCreate where the file cannot be made.
  void open(const std::filesystem::path& path, int width, int height, double fps);
  void add(const Image& image); // CHECK: of the size given to open. Throws UserError (ReadWrite)
  void close();                 // the file appears under its name. Throws UserError (ReadWrite)
  bool is_open() const;

private:
  struct Encoder;
  std::unique_ptr<Encoder> encoder_;
};

} // namespace rend
