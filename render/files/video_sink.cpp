#ifdef REND_VIDEO
#include "render/files/video_sink.h"

#include "sim/base/check.h"

namespace rend {

VideoSink::VideoSink(const std::filesystem::path& path, const std::filesystem::path& part,
                     const std::string& muxer)
    : file_(path, part) {
  AVFormatContext* format = nullptr;
  // The muxer opens the file by name again to move the index to the front; the prefix "file:" allows colons in
  // it.
  const std::string name = "file:" + file_.temporary().string();
  check(avformat_alloc_output_context2(&format, nullptr, muxer.c_str(), name.c_str()), "starting the video");
  format_.reset(format);
  constexpr int size = 1 << 16; // [bytes]
  auto* buffer = check_allocated(static_cast<unsigned char*>(av_malloc(size)));
  io_.reset(check_allocated(
      avio_alloc_context(buffer, size, 1, this, nullptr, &VideoSink::write_bytes, &VideoSink::seek)));
  format_->pb = io_.get();
  // Flushes every packet to the file, so that a killed run loses nothing.
  format_->flags |= AVFMT_FLAG_CUSTOM_IO | AVFMT_FLAG_BITEXACT | AVFMT_FLAG_FLUSH_PACKETS;
}

void VideoSink::begin(const std::vector<std::pair<std::string, std::string>>& options) {
  AvOptions given(options);
  check(avformat_write_header(format_.get(), given.get()), "writing the head of the video");
  CHECK(av_dict_count(*given.get()) == 0); // none is unknown
}

void VideoSink::write(AVPacket* packet) {
  check(av_interleaved_write_frame(format_.get(), packet), "writing");
}

void VideoSink::end() {
  check(av_write_trailer(format_.get()), "writing the end of the video");
  avio_flush(io_.get());
  check(io_->error, "writing the end of the video");
}

void VideoSink::check(int result, const char* doing) const {
  if (failure_) std::rethrow_exception(failure_);
  check_av(result, file_.path(), doing);
}

int VideoSink::write_bytes(void* self, std::uint8_t* data, int count) {
  auto& sink = *static_cast<VideoSink*>(self);
  try {
    sink.file_.write({data, static_cast<std::size_t>(count)});
  } catch (...) {
    sink.failure_ = std::current_exception();
    return AVERROR(EIO);
  }
  return count;
}

std::int64_t VideoSink::seek(void* self, std::int64_t offset, int whence) {
  if ((whence & AVSEEK_SIZE) != 0) return AVERROR(ENOSYS);
  return static_cast<VideoSink*>(self)->file_.seek(offset, whence & ~AVSEEK_FORCE);
}

void remux(const std::filesystem::path& from, const std::filesystem::path& to, const std::string& muxer) {
  const char* doing = "bringing the index of the video to its front";
  AVFormatContext* opened = nullptr;
  check_av(avformat_open_input(&opened, ("file:" + from.string()).c_str(), nullptr, nullptr), from, doing);
  const std::unique_ptr<AVFormatContext, void (*)(AVFormatContext*)> source(
      opened, [](AVFormatContext* input) { avformat_close_input(&input); });
  check_av(avformat_find_stream_info(source.get(), nullptr), from, doing);

  VideoSink sink(to, to.string() + ".part", muxer);
  const AVStream* in = source->streams[0];
  AVStream* out = check_allocated(avformat_new_stream(sink.container(), nullptr));
  sink.check(avcodec_parameters_copy(out->codecpar, in->codecpar), doing);
  out->codecpar->codec_tag = 0;
  out->time_base = in->time_base;
  out->avg_frame_rate = in->avg_frame_rate;
  sink.begin({{"movflags", "+faststart"}});
  const Owned<AVPacket> packet(check_allocated(av_packet_alloc()));
  // of the first frame shown: decoding starts earlier if there are B-frames
  std::int64_t start = AV_NOPTS_VALUE;
  while (true) {
    const int result = av_read_frame(source.get(), packet.get());
    if (result == AVERROR_EOF) break;
    check_av(result, from, doing);
    if (start == AV_NOPTS_VALUE) start = packet->pts;
    packet->pts -= start;
    packet->dts -= start;
    av_packet_rescale_ts(packet.get(), in->time_base, out->time_base);
    packet->pos = -1;
    sink.write(packet.get());
  }
  sink.end();
  sink.commit();
}

} // namespace rend

#endif
