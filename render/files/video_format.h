// The kinds of video that can be asked for: a container, an encoder and the way of a picture to it. One entry
// each in video_formats().
//
// The way of a picture is a chain of libavfilter: `scale` brings sRGB to what the encoder takes, with its
// colours tagged, so that every player shows them alike; previews are made small, a GIF has a palette for each
// picture.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rend {

struct VideoFormat {
  std::string name;    // as it is asked for, and the file's extension
  std::string what;    // in words, for help
  std::string muxer;   // of libavformat
  std::string encoder; // of libavcodec
  std::string chain;   // of libavfilter, from RGB to what the encoder takes
  std::vector<std::pair<std::string, std::string>> quality; // options of the encoder
  std::vector<std::pair<std::string, std::string>> writing; // options of the muxer while pictures come
  bool even = false;     // 4:2:0 wants even sides: an odd picture is padded by repeating its last column or row
  bool remuxed = false;  // written in fragments, and at the end once more with its index in front
  bool lossless = false; // holds sRGB as it is
};

const std::vector<VideoFormat>& video_formats();

// By name, or by a file's extension; null: there is none.
const VideoFormat* find_video_format(const std::string& name);

std::vector<std::string> video_format_names();

} // namespace rend
