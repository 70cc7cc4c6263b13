#include "render/compare/clips.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>
#include <optional>

namespace rend {
namespace {

// 31 of "bowl/00031.png".
std::optional<long> frame_of(const std::string& name) {
  const std::string stem = std::filesystem::path(name).stem().string();
  long number = 0;
  const auto [end, error] = std::from_chars(stem.data(), stem.data() + stem.size(), number);
  if (error != std::errc() || end != stem.data() + stem.size() || number < 0) return {};
  return number;
}

double flip_of(const CaseResult& one) {
  return one.metrics ? one.metrics->flip.mean : 1;
}

} // namespace

std::vector<ClipDifference> clips_of(const std::vector<CaseResult>& results) {
  std::map<std::string, std::map<long, std::size_t>> folders; // frame -> case
  for (std::size_t n = 0; n < results.size(); ++n)
    if (const std::optional<long> frame = frame_of(results[n].paths.name))
      folders[std::filesystem::path(results[n].paths.name).parent_path().string()][*frame] = n;
  constexpr std::size_t least = 3; // frames of a clip
  std::vector<ClipDifference> out;
  for (const auto& [name, frames] : folders) {
    ClipDifference clip;
    clip.name = name;
    for (const auto& [frame, n] : frames) {
      clip.cases.push_back(n);
      clip.flip.push_back(flip_of(results[n]));
    }
    const auto differs = [&](std::size_t n) { return results[n].state != CaseState::Match; };
    clip.first = static_cast<std::size_t>(std::find_if(clip.cases.begin(), clip.cases.end(), differs) -
                                          clip.cases.begin());
    clip.worst =
        static_cast<std::size_t>(std::max_element(clip.flip.begin(), clip.flip.end()) - clip.flip.begin());
    if (clip.cases.size() >= least && clip.first < clip.cases.size()) out.push_back(std::move(clip));
  }
  return out;
}

} // namespace rend
