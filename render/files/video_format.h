// The video formats: a muxer, an encoder and a filter chain each. One entry each in video_formats().
//
// The filter chain is in libavfilter's syntax: `scale` converts sRGB to the encoder's pixel format and tags the
// colour space, so that all players show the same colours; previews are scaled down, a GIF has a palette for
// each picture. Transparent pictures take a chain of their own, from straight RGBA.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace rend {

struct VideoFormat {
  std::string name;    // on the command line, and the file's extension
  std::string what;    // description, for help
  std::string muxer;   // name in libavformat
  std::string encoder; // name in libavcodec
  std::string chain;   // libavfilter graph, from RGB to the encoder's pixel format
  std::string alpha;   // the same from RGBA, with transparency; empty: the format has none
  std::vector<std::pair<std::string, std::string>> quality; // encoder options
  std::vector<std::pair<std::string, std::string>> writing; // muxer options during encoding
  bool even = false;     // 4:2:0 needs even sides: an odd picture is padded by repeating its last column or row
  bool remuxed = false;  // written in fragments, and remuxed at the end with its index in front
  bool lossless = false; // stores sRGB unchanged
};

const std::vector<VideoFormat>& video_formats();

// By name or file extension; null: there is none.
const VideoFormat* find_video_format(const std::string& name);

// What a video is called while it is written, and stays if it is cut short: NAME.part.EXT, in the same folder.
std::filesystem::path partial_video(const std::filesystem::path& video);

std::vector<std::string> video_format_names();
std::vector<std::string> transparent_format_names(); // those with transparency

} // namespace rend
