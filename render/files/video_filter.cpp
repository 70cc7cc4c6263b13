#ifdef REND_VIDEO
#include "render/files/video_filter.h"

#include "sim/base/check.h"

#include <fmt/format.h>

#include <cstring>

extern "C" {
#include <libavfilter/buffersink.h>
#include <libavfilter/buffersrc.h>
}

namespace rend {

VideoFilter::VideoFilter(const std::string& chain, int width, int height, int channels, AVRational rate,
                         const std::filesystem::path& file)
    : file_(file), graph_(check_allocated(avfilter_graph_alloc())), in_(check_allocated(av_frame_alloc())),
      out_(check_allocated(av_frame_alloc())) {
  CHECK(channels == 3 || channels == 4);
  const AVPixelFormat pixels = channels == 4 ? AV_PIX_FMT_RGBA : AV_PIX_FMT_RGB24;
  graph_->nb_threads = 1;
  const std::string source =
      fmt::format("buffer=video_size={}x{}:pix_fmt={}:time_base={}/{}:frame_rate={}/{}:pixel_aspect=1/1", width,
                  height, static_cast<int>(pixels), rate.den, rate.num, rate.num, rate.den);
  const std::string text = source + "," + chain + ",buffersink";
  AVFilterInOut *inputs = nullptr, *outputs = nullptr;
  check_av(avfilter_graph_parse2(graph_.get(), text.c_str(), &inputs, &outputs), file_,
           "preparing the video's pictures");
  avfilter_inout_free(&inputs);
  avfilter_inout_free(&outputs);
  check_av(avfilter_graph_config(graph_.get(), nullptr), file_, "preparing the video's pictures");
  for (unsigned n = 0; n < graph_->nb_filters; ++n) {
    AVFilterContext* filter = graph_->filters[n];
    if (std::strcmp(filter->filter->name, "buffer") == 0) source_ = filter;
    if (std::strcmp(filter->filter->name, "buffersink") == 0) sink_ = filter;
  }
  CHECK(source_ && sink_);
  in_->format = pixels;
  in_->width = width;
  in_->height = height;
  constexpr int aligned = 64; // [bytes], row alignment that libav prefers
  stride_ = (channels * width + aligned - 1) / aligned * aligned;
  frame_pool_.reset(
      check_allocated(av_buffer_pool_init(static_cast<std::size_t>(stride_) * height + aligned, nullptr)));
}

int VideoFilter::width() const {
  return av_buffersink_get_w(sink_);
}
int VideoFilter::height() const {
  return av_buffersink_get_h(sink_);
}
AVPixelFormat VideoFilter::pixels() const {
  return static_cast<AVPixelFormat>(av_buffersink_get_format(sink_));
}
AVRational VideoFilter::time_base() const {
  return av_buffersink_get_time_base(sink_);
}

void VideoFilter::push(const Image* image, const std::function<void(const AVFrame*)>& take) {
  if (image != nullptr) {
    CHECK((image->channels == 4) == (in_->format == AV_PIX_FMT_RGBA) && image->width == in_->width &&
          image->height == in_->height);
    const Owned<AVFrame> copy(check_allocated(av_frame_alloc())); // the filter graph may keep a reference
    copy->format = in_->format;
    copy->width = in_->width;
    copy->height = in_->height;
    copy->color_range = AVCOL_RANGE_JPEG;
    copy->sample_aspect_ratio = {1, 1};
    copy->buf[0] = av_buffer_pool_get(frame_pool_.get());
    check_av(copy->buf[0] != nullptr ? 0 : AVERROR(ENOMEM), file_, "making room for a picture");
    copy->data[0] = copy->buf[0]->data;
    copy->linesize[0] = stride_;
    for (int y = 0; y < image->height; ++y)
      std::memcpy(copy->data[0] + static_cast<std::ptrdiff_t>(y) * copy->linesize[0], image->row(y),
                  image->stride());
    copy->pts = count_++;
    check_av(av_buffersrc_add_frame(source_, copy.get()), file_, "preparing a picture");
  } else {
    // the end time: the last picture has a duration, too
    check_av(av_buffersrc_close(source_, count_, 0), file_, "preparing a picture");
  }
  while (true) {
    const int result = av_buffersink_get_frame(sink_, out_.get());
    if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
    check_av(result, file_, "preparing a picture");
    take(out_.get());
    av_frame_unref(out_.get());
  }
}

} // namespace rend

#endif
