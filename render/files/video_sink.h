// A libavformat muxer that writes to an OutputFile. Only for builds with video.
#pragma once

#include "render/files/libav.h"
#include "render/files/output.h"

#include <exception>

namespace rend {

class VideoSink {
public:
  // The file is written as `part` until it is committed. Throws UserError (CannotCreate).
  VideoSink(const std::filesystem::path& path, const std::filesystem::path& part, const std::string& muxer);

  AVFormatContext* container() { return format_.get(); }
  void
  // after the streams were added: writes the header
  begin(const std::vector<std::pair<std::string, std::string>>& options);
  void write(AVPacket* packet); // as av_interleaved_write_frame
  void end();                   // writes the trailer, and flushes
  void commit() { file_.commit(); }
  void leave() { file_.leave(); } // under the name of its part
  const OutputFile& file() const { return file_; }

  // Throws a UserError for an error of libav; if writing to the file failed, the error of that instead, which
  // says more.
  void check(int result, const char* doing) const;

private:
  static int write_bytes(void* self, std::uint8_t* data, int count);
  static std::int64_t seek(void* self, std::int64_t offset, int whence);

  OutputFile file_;
  std::exception_ptr failure_; // thrown in write_bytes(), which libav calls
  Owned<AVIOContext> io_;      // declared before the muxer, which must be freed first
  Owned<AVFormatContext> format_;
};

// Copies the stream into a new file with its index in front. Throws UserError (ReadWrite).
void remux(const std::filesystem::path& from, const std::filesystem::path& to, const std::string& muxer);

} // namespace rend
