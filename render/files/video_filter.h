// Converts pictures for the encoder with a libavfilter graph. Only for builds with video.
#pragma once

#include "render/files/image.h"
#include "render/files/libav.h"

#include <functional>

namespace rend {

class VideoFilter {
public:
  // width, height [pixels] of the input pictures; channels: 3, RGB, or 4, RGBA; `chain` in libavfilter's
  // syntax; one thread, for reproducible output. `file` is named in errors.
  VideoFilter(const std::string& chain, int width, int height, int channels, AVRational rate,
              const std::filesystem::path& file);

  int width() const; // [pixels], of the output
  int height() const;
  AVPixelFormat pixels() const;
  AVRational time_base() const;

  // Filters a picture (null: flush) and passes each resulting frame to `take`.
  void push(const Image* image, const std::function<void(const AVFrame*)>& take);

private:
  std::filesystem::path file_;
  Owned<AVFilterGraph> graph_;
  AVFilterContext *source_ = nullptr, *sink_ = nullptr; // owned by graph_
  Owned<AVFrame> in_, out_;
  // reused frame buffers: allocating them each time costs as much as copying the pictures
  Owned<AVBufferPool> frame_pool_;
  int stride_ = 0;         // [bytes] per row
  std::int64_t count_ = 0; // pictures so far
};

} // namespace rend
