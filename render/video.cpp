#include "render/video.h"

#include "sim/base/check.h"
#include "sim/base/error.h"

#ifdef REND_VIDEO
#include "render/output.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <utility>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavformat/avformat.h>
#include <libavutil/imgutils.h>
#include <libavutil/log.h>
#include <libavutil/opt.h>
#include <libswscale/swscale.h>
}

namespace rend {
namespace {

struct Free {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVFormatContext* format) const { avformat_free_context(format); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(SwsContext* scaler) const { sws_freeContext(scaler); }
  void operator()(AVIOContext* io) const {
    av_freep(&io->buffer);
    avio_context_free(&io);
  }
};
template <class T> using Owned = std::unique_ptr<T, Free>;

int even(int side) {
  return side + (side & 1);
}

std::string reason(int error) {
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(error, text.data(), text.size());
  return text.data();
}

} // namespace

// One file under way. The order of members is the order of destruction, backwards: the container before its
// file.
struct VideoWriter::Encoder {
  Encoder(const std::filesystem::path& path, int width, int height, double fps);
  void add(const Image& image);
  void close();

private:
  void open_container(const char* container);
  void open_codec(double fps);
  void open_scaler();
  void send(const AVFrame* frame); // null: no more frames
  void must(int result, const char* doing);
  Image padded(const Image& image) const;
  static int write(void* self, std::uint8_t* data, int count);
  static std::int64_t seek(void* self, std::int64_t offset, int whence);

  int width_, height_; // [pixels], of the pictures given
  OutputFile file_;
  std::exception_ptr failure_; // what stopped write()
  Owned<AVIOContext> io_;
  Owned<AVFormatContext> format_;
  Owned<AVCodecContext> codec_;
  Owned<SwsContext> scaler_;
  Owned<AVFrame> frame_;
  Owned<AVPacket> packet_;
  AVStream* stream_ = nullptr; // owned by format_
  std::int64_t count_ = 0;     // pictures so far
};

VideoWriter::Encoder::Encoder(const std::filesystem::path& path, int width, int height, double fps)
    : width_(width), height_(height), file_(path) {
  av_log_set_level(AV_LOG_QUIET);
  open_container(path.extension() == ".mkv" ? "matroska" : "mp4");
  open_codec(fps);
  open_scaler();
  AVDictionary* options = nullptr;
  if (path.extension() != ".mkv") av_dict_set(&options, "movflags", "+faststart", 0);
  const int result = avformat_write_header(format_.get(), &options);
  av_dict_free(&options);
  must(result, "writing the head of the video");
}

void VideoWriter::Encoder::open_container(const char* container) {
  AVFormatContext* format = nullptr;
  // The name is for the index, which is moved to the front by reading the file again; "file:" lets it hold a
  // colon.
  const std::string name = "file:" + file_.temporary().string();
  must(avformat_alloc_output_context2(&format, nullptr, container, name.c_str()), "starting the video");
  format_.reset(format);
  constexpr int size = 1 << 16; // [bytes]
  auto* buffer = static_cast<unsigned char*>(av_malloc(size));
  io_.reset(avio_alloc_context(buffer, size, 1, this, nullptr, &Encoder::write, &Encoder::seek));
  CHECK(io_ != nullptr);
  format_->pb = io_.get();
  format_->flags |= AVFMT_FLAG_CUSTOM_IO | AVFMT_FLAG_BITEXACT;
}

void VideoWriter::Encoder::open_codec(double fps) {
  const AVCodec* h264 = avcodec_find_encoder_by_name("libx264");
  if (h264 == nullptr)
    throw UserError(Exit::CannotCreate, {}, "this machine's FFmpeg libraries have no H.264 encoder (libx264).",
                    "Install libavcodec with libx264, or leave the video out.");
  codec_.reset(avcodec_alloc_context3(h264));
  CHECK(codec_ != nullptr);
  const AVRational rate = av_d2q(fps, 100000);
  codec_->width = even(width_);
  codec_->height = even(height_);
  codec_->pix_fmt = AV_PIX_FMT_YUV420P;
  codec_->framerate = rate;
  codec_->time_base = av_inv_q(rate);
  codec_->sample_aspect_ratio = {1, 1};
  codec_->color_range = AVCOL_RANGE_MPEG;
  codec_->color_primaries = AVCOL_PRI_BT709;
  codec_->color_trc = AVCOL_TRC_BT709;
  codec_->colorspace = AVCOL_SPC_BT709;
  codec_->chroma_sample_location = AVCHROMA_LOC_LEFT;
  codec_->thread_count = 2; // fixed: x264's decisions depend on it
  codec_->flags |= AV_CODEC_FLAG_BITEXACT;
  if ((format_->oformat->flags & AVFMT_GLOBALHEADER) != 0) codec_->flags |= AV_CODEC_FLAG_GLOBAL_HEADER;
  av_opt_set(codec_->priv_data, "preset", "veryfast", 0); // 8 ms a picture of 1280 x 720; medium: 17 ms
  av_opt_set(codec_->priv_data, "crf", "18", 0);
  must(avcodec_open2(codec_.get(), h264, nullptr), "starting the H.264 encoder");

  stream_ = avformat_new_stream(format_.get(), nullptr);
  CHECK(stream_ != nullptr);
  must(avcodec_parameters_from_context(stream_->codecpar, codec_.get()), "describing the video");
  stream_->time_base = codec_->time_base;
  stream_->avg_frame_rate = rate;
  packet_.reset(av_packet_alloc());
  CHECK(packet_ != nullptr);
}

void VideoWriter::Encoder::open_scaler() {
  const int width = even(width_), height = even(height_);
  scaler_.reset(sws_getContext(width, height, AV_PIX_FMT_RGB24, width, height, AV_PIX_FMT_YUV420P,
                               SWS_BICUBIC | SWS_ACCURATE_RND | SWS_BITEXACT, nullptr, nullptr, nullptr));
  CHECK(scaler_ != nullptr);
  const int* bt709 = sws_getCoefficients(SWS_CS_ITU709);
  constexpr int full = 1, limited = 0, one = 1 << 16;
  sws_setColorspaceDetails(scaler_.get(), bt709, full, bt709, limited, 0, one, one);
  frame_.reset(av_frame_alloc());
  CHECK(frame_ != nullptr);
  frame_->format = AV_PIX_FMT_YUV420P;
  frame_->width = width;
  frame_->height = height;
  must(av_frame_get_buffer(frame_.get(), 0), "making room for a picture");
}

// RGB with even sides.
Image VideoWriter::Encoder::padded(const Image& image) const {
  Image out(even(width_), even(height_), 3);
  for (int y = 0; y < out.height; ++y) {
    const std::uint8_t* from = image.row(std::min(y, height_ - 1));
    std::uint8_t* to = out.row(y);
    for (int x = 0; x < out.width; ++x)
      for (int c = 0; c < 3; ++c) *to++ = from[std::min(x, width_ - 1) * image.channels + c];
  }
  return out;
}

void VideoWriter::Encoder::add(const Image& image) {
  CHECK(image.width == width_ && image.height == height_);
  const bool fits = image.channels == 3 && even(width_) == width_ && even(height_) == height_;
  const Image copy = fits ? Image() : padded(image);
  const Image& source = fits ? image : copy;
  must(av_frame_make_writable(frame_.get()),
       "making room for a picture"); // the encoder may still hold the last
  const std::array<const std::uint8_t*, 4> rows{source.pixels.data(), nullptr, nullptr, nullptr};
  const std::array<int, 4> strides{static_cast<int>(source.stride()), 0, 0, 0};
  sws_scale(scaler_.get(), rows.data(), strides.data(), 0, source.height, frame_->data, frame_->linesize);
  frame_->pts = count_++;
  send(frame_.get());
}

void VideoWriter::Encoder::send(const AVFrame* frame) {
  must(avcodec_send_frame(codec_.get(), frame), "encoding");
  while (true) {
    const int result = avcodec_receive_packet(codec_.get(), packet_.get());
    if (result == AVERROR(EAGAIN) || result == AVERROR_EOF) return;
    must(result, "encoding");
    packet_->duration = 1;
    av_packet_rescale_ts(packet_.get(), codec_->time_base, stream_->time_base);
    packet_->stream_index = stream_->index;
    must(av_interleaved_write_frame(format_.get(), packet_.get()), "writing");
  }
}

void VideoWriter::Encoder::close() {
  send(nullptr);
  must(av_write_trailer(format_.get()), "writing the end of the video");
  avio_flush(io_.get());
  must(io_->error, "writing the end of the video");
  file_.commit();
}

// Turns an error of libav into one for the user; the file's own error, if there was one, says more.
void VideoWriter::Encoder::must(int result, const char* doing) {
  if (failure_) std::rethrow_exception(failure_);
  if (result >= 0) return;
  throw UserError(Exit::ReadWrite, {file_.path().string()},
                  std::string(doing) + " failed: " + reason(result) + ".");
}

int VideoWriter::Encoder::write(void* self, std::uint8_t* data, int count) {
  auto& encoder = *static_cast<Encoder*>(self);
  try {
    encoder.file_.write({data, static_cast<std::size_t>(count)});
  } catch (...) {
    encoder.failure_ = std::current_exception();
    return AVERROR(EIO);
  }
  return count;
}

std::int64_t VideoWriter::Encoder::seek(void* self, std::int64_t offset, int whence) {
  if ((whence & AVSEEK_SIZE) != 0) return AVERROR(ENOSYS);
  return static_cast<Encoder*>(self)->file_.seek(offset, whence & ~AVSEEK_FORCE);
}

bool video_available() {
  return true;
}
void require_video() {}

VideoWriter::VideoWriter() = default;
VideoWriter::~VideoWriter() = default;
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

void VideoWriter::open(const std::filesystem::path& path, int width, int height, double fps) {
  CHECK(encoder_ == nullptr && width > 0 && height > 0 && std::isfinite(fps) && fps > 0);
  if (path.extension() != ".mp4" && path.extension() != ".mkv")
    throw UserError(Exit::Usage, {path.string()}, "this kind of video is not known.",
                    "Known are .mp4 and .mkv.");
  encoder_ = std::make_unique<Encoder>(path, width, height, fps);
}

void VideoWriter::add(const Image& image) {
  CHECK(is_open());
  encoder_->add(image);
}

void VideoWriter::close() {
  CHECK(is_open());
  const std::unique_ptr<Encoder> last = std::move(encoder_); // whatever happens, it is over
  last->close();
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
void require_video() {
  throw UserError(Exit::Usage, {}, "this rend was built without video",
                  "leave --video out, or build with -DREND_VIDEO=ON");
}

VideoWriter::VideoWriter() = default;
VideoWriter::~VideoWriter() = default;
VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;
VideoWriter& VideoWriter::operator=(VideoWriter&&) noexcept = default;

void VideoWriter::open(const std::filesystem::path&, int, int, double) {
  require_video();
}

void VideoWriter::add(const Image&) {
  CHECK(is_open());
}
void VideoWriter::close() {
  CHECK(is_open());
}
bool VideoWriter::is_open() const {
  return encoder_ != nullptr;
}

} // namespace rend

#endif
