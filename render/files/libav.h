// Shared by all files that use libav: owners of its objects, and its errors as messages. Only for builds with
// video.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <utility>
#include <vector>

extern "C" {
#include <libavcodec/avcodec.h>
#include <libavfilter/avfilter.h>
#include <libavformat/avformat.h>
}

namespace rend {

struct FreeOfLibav {
  void operator()(AVCodecContext* codec) const { avcodec_free_context(&codec); }
  void operator()(AVFormatContext* format) const { avformat_free_context(format); }
  void operator()(AVFrame* frame) const { av_frame_free(&frame); }
  void operator()(AVPacket* packet) const { av_packet_free(&packet); }
  void operator()(AVFilterGraph* graph) const { avfilter_graph_free(&graph); }
  void operator()(AVBufferPool* pool) const { av_buffer_pool_uninit(&pool); }
  void operator()(AVIOContext* io) const {
    av_freep(&io->buffer);
    avio_context_free(&io);
  }
};
template <class T> using Owned = std::unique_ptr<T, FreeOfLibav>;

// Throws UserError about the file if a result of libav is negative: ReadWrite, or OutOfBudget for lack of
// memory or threads.
void check_av(int result, const std::filesystem::path& file, const char* doing);

// Allocation functions of libav return null when out of memory: throws std::bad_alloc then.
template <class T> T* check_allocated(T* made) {
  if (made == nullptr) throw std::bad_alloc();
  return made;
}

// An AVDictionary of options, freed with this object; libav removes the entries that it has used.
class AvOptions {
public:
  explicit AvOptions(const std::vector<std::pair<std::string, std::string>>& options);
  ~AvOptions() { av_dict_free(&dictionary_); }
  AvOptions(const AvOptions&) = delete;
  AvOptions& operator=(const AvOptions&) = delete;
  AVDictionary** get() { return &dictionary_; }

private:
  AVDictionary* dictionary_ = nullptr;
};

} // namespace rend
