#include "render/files/video_format.h"

namespace rend {
namespace {

// BT.709, limited range, 4:2:0: what players expect of HD video.
std::string bt709(const char* pixels) {
  return "scale=out_color_matrix=bt709:out_range=tv:flags=bicubic+accurate_rnd+bitexact,format=" +
         std::string(pixels);
}
const char* preview = "scale=w=min(480\\,iw):h=-1:flags=lanczos+accurate_rnd+bitexact";

// Preset veryfast takes 8 ms for a picture of 1280 x 720; medium 17 ms. One fragment a second: a killed run
// leaves a file that is complete up to its last second.
VideoFormat mp4() {
  return {"mp4",
          "H.264, plays everywhere",
          "mp4",
          "libx264",
          bt709("yuv420p"),
          "",
          {{"preset", "veryfast"}, {"subq", "1"}, {"crf", "18"}},
          {{"movflags", "+frag_keyframe+empty_moov+default_base_moof"}},
          true,
          true,
          false};
}

VideoFormat webm() {
  return {"webm",
          "VP9, smaller, for the web",
          "webm",
          "libvpx-vp9",
          bt709("yuv420p"),
          bt709("yuva420p"), // alpha is a second picture beside each, which browsers know
          {{"deadline", "good"}, {"cpu-used", "5"}, {"row-mt", "1"}, {"crf", "24"}, {"b", "0"}},
          {{"cluster_time_limit", "1000"}},
          true,
          false,
          false};
}

VideoFormat mkv() {
  return {"mkv",
          "FFV1, lossless: every pixel as in the PNG files",
          "matroska",
          "ffv1",
          "format=bgr0",
          "format=bgra",
          {{"level", "3"}, {"slices", "4"}, {"slicecrc", "1"}},
          {{"cluster_time_limit", "1000"}},
          false,
          false,
          true};
}

VideoFormat gif() {
  // GIF delays are hundredths of a second, and browsers slow down anything faster than 50 frames a second.
  const std::string small = "fps=fps=min(50\\,source_fps)," + std::string(preview);
  // What has alpha of at least a half is opaque: palettes have one colour that is transparent.
  const std::string paletted = ",split[a][b];[a]palettegen=stats_mode=single[palette];"
                               "[b][palette]paletteuse=new=1:dither=bayer:bayer_scale=4";
  return {"gif",
          "a preview of at most 480 pixels across",
          "gif",
          "gif",
          small + paletted,
          small + paletted,
          {},
          {},
          false,
          false,
          false};
}

VideoFormat apng() {
  return {"apng",
          "a preview of at most 480 pixels across, in all colours",
          "apng",
          "apng",
          std::string(preview) + ",format=rgb24",
          std::string(preview) + ",format=rgba",
          {{"pred", "mixed"}},
          {{"plays", "0"}},
          false,
          false,
          false};
}

} // namespace

const std::vector<VideoFormat>& video_formats() {
  static const std::vector<VideoFormat> formats{mp4(), webm(), mkv(), gif(), apng()};
  return formats;
}

const VideoFormat* find_video_format(const std::string& name) {
  for (const VideoFormat& format : video_formats())
    if (format.name == name || "." + format.name == name) return &format;
  return nullptr;
}

std::filesystem::path partial_video(const std::filesystem::path& video) {
  return video.parent_path() / (video.stem().string() + ".part" + video.extension().string());
}

std::vector<std::string> video_format_names() {
  std::vector<std::string> names;
  for (const VideoFormat& format : video_formats()) names.push_back(format.name);
  return names;
}

std::vector<std::string> transparent_format_names() {
  std::vector<std::string> names;
  for (const VideoFormat& format : video_formats())
    if (!format.alpha.empty()) names.push_back(format.name);
  return names;
}

} // namespace rend
