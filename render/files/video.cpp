#include "render/files/video.h"

#include "render/files/video_format.h"
#include "sim/base/check.h"
#include "sim/base/error.h"
#include "sim/base/wording.h"

#ifdef REND_VIDEO
#include "render/files/video_filter.h"
#include "render/files/video_sink.h"
#include "sim/base/worker_threads.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

extern "C" {
#include <libavutil/log.h>
#include <libavutil/opt.h>
}

namespace rend {
namespace {

int even(int side) {
  return side + (side & 1);
}

// Of that size, with the last column and row repeated.
Image padded(const Image& image, int width, int height) {
  Image out(width, height, image.channels);
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* from = image.row(std::min(y, image.height - 1));
    std::uint8_t* to = out.row(y);
    for (int x = 0; x < width; ++x, to += image.channels)
      std::copy_n(from + static_cast<std::ptrdiff_t>(std::min(x, image.width - 1)) * image.channels,
                  image.channels, to);
  }
  return out;
}

// Gives pixels that are not seen the colour of the next seen one to the left, else to the right, else above.
// Smaller pictures and 4:2:0 mix colours of neighbours, whatever their alpha: black from outside would darken
// the edges.
void spread_colours(Image& image) {
  for (int y = 0; y < image.height; ++y) {
    std::uint8_t* const row = image.row(y);
    const std::uint8_t* seen = nullptr;
    for (int x = 0; x < image.width && !seen; ++x)
      if (row[4 * x + 3] != 0) seen = row + std::ptrdiff_t{4} * x;
    if (!seen && y == 0) continue;
    for (int x = 0; x < image.width; ++x) {
      std::uint8_t* const pixel = row + std::ptrdiff_t{4} * x;
      if (pixel[3] != 0)
        seen = pixel;
      else
        std::copy_n(seen ? seen : pixel - image.stride(), 3, pixel);
    }
  }
}

} // namespace

// A video that is being encoded.
struct VideoWriter::Encoder {
  Encoder(const std::filesystem::path& path, const VideoFormat& format, int width, int height, double fps,
          bool transparent);
  void add(const Image& image);
  void close();
  void stop();

private:
  void end();
  void open_codec(AVRational rate);
  void set_colours();
  void send(const AVFrame* frame); // null: flush

  const VideoFormat& kind_;
  int width_, height_, padded_width_, padded_height_; // [pixels], of the input, and padded
  int channels_;                                      // of the input
  VideoSink sink_;
  VideoFilter filter_;
  Owned<AVCodecContext> codec_;
  Owned<AVFrame> frame_;
  Owned<AVPacket> packet_;
  AVStream* stream_ = nullptr; // owned by the container
};

VideoWriter::Encoder::Encoder(const std::filesystem::path& path, const VideoFormat& format, int width,
                              int height, double fps, bool transparent)
    : kind_(format), width_(width), height_(height), padded_width_(format.even ? even(width) : width),
      padded_height_(format.even ? even(height) : height), channels_(transparent ? 4 : 3),
      sink_(path, partial_video(path), format.muxer),
      filter_(transparent ? format.alpha : format.chain, padded_width_, padded_height_, channels_,
              av_d2q(fps, 100000), path) {
  open_codec(av_d2q(fps, 100000));
  sink_.begin(format.writing);
}

void VideoWriter::Encoder::open_codec(AVRational rate) {
  require_encoder(kind_);
  const AVCodec* codec = avcodec_find_encoder_by_name(kind_.encoder.c_str());
  codec_.reset(check_allocated(avcodec_alloc_context3(codec)));
  codec_->width = filter_.width();
  codec_->height = filter_.height();
  codec_->pix_fmt = filter_.pixels();
  codec_->framerate = rate;
  codec_->time_base = filter_.time_base();
  codec_->sample_aspect_ratio = {1, 1};
  set_colours();
  // one key frame a second: a fragment of MP4
  codec_->gop_size = std::clamp(static_cast<int>(std::ceil(av_q2d(rate))), 1, 60);
  codec_->thread_count = 2; // fixed: an encoder's output may depend on it
  codec_->flags |= AV_CODEC_FLAG_BITEXACT;
  if ((sink_.container()->oformat->flags & AVFMT_GLOBALHEADER) != 0)
    codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  AvOptions quality(kind_.quality);
  const long refused = refused_thread_starts();
  const int result = avcodec_open2(codec_.get(), codec, quality.get());
  if (result < 0 && refused_thread_starts() > refused) refuse_without_thread("the encoder");
  sink_.check(result, "starting the encoder");
  CHECK(av_dict_count(*quality.get()) == 0); // none is unknown

  stream_ = check_allocated(avformat_new_stream(sink_.container(), nullptr));
  sink_.check(avcodec_parameters_from_context(stream_->codecpar, codec_.get()), "describing the video");
  stream_->time_base = codec_->time_base;
  stream_->avg_frame_rate = rate;
  packet_.reset(check_allocated(av_packet_alloc()));
}

void VideoWriter::Encoder::set_colours() {
  codec_->color_primaries = AVCOL_PRI_BT709;
  if (kind_.even) {
    codec_->color_range = AVCOL_RANGE_MPEG;
    codec_->color_trc = AVCOL_TRC_BT709;
    codec_->colorspace = AVCOL_SPC_BT709;
    codec_->chroma_sample_location = AVCHROMA_LOC_LEFT;
  } else {
    codec_->color_range = AVCOL_RANGE_JPEG;
    codec_->color_trc = AVCOL_TRC_IEC61966_2_1;
    codec_->colorspace = AVCOL_SPC_RGB;
  }
}

void VideoWriter::Encoder::add(const Image& image) {
  CHECK(image.width == width_ && image.height == height_ && image.channels == channels_);
  const bool spreads = channels_ == 4 && !kind_.lossless;
  const bool fits = !spreads && padded_width_ == width_ && padded_height_ == height_;
  Image copy = fits ? Image() : padded(image, padded_width_, padded_height_);
  if (spreads) spread_colours(copy);
  filter_.push(fits ? &image : &copy, [this](const AVFrame* frame) { send(frame); });
}

void VideoWriter::Encoder::send(const AVFrame* frame) {
  sink_.check(avcodec_send_frame(codec_.get(), frame), "encoding");
  while (true) {
    const int result = avcodec_receive_packet(codec_.get(), packet_.get());
    if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
    sink_.check(result, "encoding");
    packet_->duration = 1;
    av_packet_rescale_ts(packet_.get(), codec_->time_base, stream_->time_base);
    packet_->stream_index = stream_->index;
    sink_.write(packet_.get());
  }
}

void VideoWriter::Encoder::end() {
  filter_.push(nullptr, [this](const AVFrame* frame) { send(frame); });
  send(nullptr);
  sink_.end();
}

void VideoWriter::Encoder::stop() {
  end();
  sink_.leave();
}

void VideoWriter::Encoder::close() {
  end();
  if (kind_.remuxed)
    // the temporary file of the first pass is removed with this object
    remux(sink_.file().temporary(), sink_.file().path(), kind_.muxer);
  else
    sink_.commit();
}

bool video_available() {
  return true;
}

namespace {

bool can_encode(const VideoFormat& format) {
  return avcodec_find_encoder_by_name(format.encoder.c_str()) &&
         av_guess_format(format.muxer.c_str(), nullptr, nullptr);
}

} // namespace

void require_encoder(const VideoFormat& format) {
  if (can_encode(format)) return;
  std::vector<std::string> others;
  for (const VideoFormat& other : video_formats())
    if (can_encode(other)) others.push_back(other.name);
  throw UserError(
      Exit::CannotCreate, {},
      fmt::format("this machine's FFmpeg libraries cannot write {}: they lack {}", format.name, format.encoder),
      others.empty()
          ? "install a libavcodec that has it, or make only PNG files"
          : "install a libavcodec that has it, or choose a format that it can write: " + listed(others));
}

void require_video(const std::string& name) {
  if (const VideoFormat* format = find_video_format(name)) return require_encoder(*format);
  throw UserError(Exit::Usage, {}, fmt::format("rend writes no videos of the format {}", in_quotes(name)),
                  suggestion(name, video_format_names(), "there are"));
}

VideoWriter::VideoWriter() = default;
VideoWriter::~VideoWriter() = default;
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

void VideoWriter::open(const std::filesystem::path& path, int width, int height, double fps, bool transparent) {
  CHECK(encoder_ == nullptr && width > 0 && height > 0 && std::isfinite(fps) && fps > 0);
  av_log_set_level(AV_LOG_QUIET);
  require_video(path.extension().string());
  const VideoFormat* format = find_video_format(path.extension().string());
  CHECK(!transparent || !format->alpha.empty());
  encoder_ = std::make_unique<Encoder>(path, *format, width, height, fps, transparent);
}

void VideoWriter::add(const Image& image) {
  CHECK(is_open());
  encoder_->add(image);
}

void VideoWriter::close() {
  CHECK(is_open());
  const std::unique_ptr<Encoder> last = std::move(encoder_); // ends the encoder even if closing throws
  last->close();
}

void VideoWriter::stop() {
  CHECK(is_open());
  const std::unique_ptr<Encoder> last = std::move(encoder_);
  last->stop();
}

bool VideoWriter::is_open() const {
  return encoder_ != nullptr;
}

} // namespace rend

#else

namespace rend {

struct VideoWriter::Encoder {};

bool video_available() {
  return false;
}
void require_video(const std::string&) {
  throw UserError(Exit::Usage, {}, "this rend was built without video",
                  "leave --video out, or build with -DREND_VIDEO=ON");
}

void require_encoder(const VideoFormat&) {
  require_video({});
}

VideoWriter::VideoWriter() = default;
VideoWriter::~VideoWriter() = default;
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

void VideoWriter::open(const std::filesystem::path&, int, int, double, bool) {
  require_video({});
}

void VideoWriter::add(const Image&) {
  CHECK(is_open());
}
void VideoWriter::close() {
  CHECK(is_open());
}
void VideoWriter::stop() {
  CHECK(is_open());
}
bool VideoWriter::is_open() const {
  return encoder_ != nullptr;
}

} // namespace rend

#endif
