// A container that is being written to an OutputFile by libavformat. Only for builds with video.
#pragma once

#include "render/files/libav.h"
#include "render/files/output.h"

#include <exception>

namespace rend {

class VideoSink {
public:
  // The file is written under `part` until it is committed. Throws UserError (CannotCreate).
  VideoSink(const std::filesystem::path& path, const std::filesystem::path& part, const std::string& muxer);

  AVFormatContext* container() { return format_.get(); }
  void
  begin(const std::vector<std::pair<std::string, std::string>>& options); // the streams are there: the head
  void write(AVPacket* packet);                                           // as av_interleaved_write_frame
  void end();                                                             // the tail; all is in the file
  void commit() { file_.commit(); }
  const OutputFile& file() const { return file_; }

  // Turns an error of libav into one for the user; the file's own error, if there was one, says more.
  void must(int result, const char* doing) const;

private:
  static int write_bytes(void* self, std::uint8_t* data, int count);
  static std::int64_t seek(void* self, std::int64_t offset, int whence);

  OutputFile file_;
  std::exception_ptr failure_; // what stopped write_bytes()
  Owned<AVIOContext> io_;      // before the container: it is freed after it
  Owned<AVFormatContext> format_;
};

// The same stream in a new container, with its index in front. Throws UserError (ReadWrite).
void remux(const std::filesystem::path& from, const std::filesystem::path& to, const std::string& muxer);

} // namespace rend
