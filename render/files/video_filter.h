// The way of a picture to the encoder: a chain of libavfilter. Only for builds with video.
#pragma once

#include "render/files/image.h"
#include "render/files/libav.h"

#include <functional>

namespace rend {

class VideoFilter {
public:
  // width, height [pixels] of the pictures that will come, RGB; `chain` in libavfilter's own words; one thread,
  // so that the same comes out every time. `file` is what errors name.
  VideoFilter(const std::string& chain, int width, int height, AVRational rate,
              const std::filesystem::path& file);

  int width() const; // [pixels], of what comes out
  int height() const;
  AVPixelFormat pixels() const;
  AVRational time_base() const;

  // A picture goes in (null: no more), and what comes out goes to `take`.
  void push(const Image* image, const std::function<void(const AVFrame*)>& take);

private:
  std::filesystem::path file_;
  Owned<AVFilterGraph> graph_;
  AVFilterContext *source_ = nullptr, *sink_ = nullptr; // owned by graph_
  Owned<AVFrame> in_, out_;
  Owned<AVBufferPool> rooms_; // for pictures: made anew each time, they cost as much as their copying
  int stride_ = 0;            // [bytes], of their rows
  std::int64_t count_ = 0;    // pictures so far
};

} // namespace rend
