#include "render/clip/frame_plan.h"

#include "render/pipeline/pipeline.h"
#include "sim/base/threads.h"

#include <algorithm>

namespace rend {

FramePlan::FramePlan(const FrameChoice& choice, const FrameClock& clock, const Shard& shard) {
  std::vector<long> chosen;
  const long last = last_chosen(choice, clock);
  for (long frame = 0; frame <= last; ++frame)
    if (choice.has(frame)) chosen.push_back(frame);
  const long count = static_cast<long>(chosen.size());
  all_.assign(chosen.begin() + shard.first(count), chosen.begin() + shard.last(count));
  to_make_ = all_;
}

void FramePlan::skip_existing(const std::filesystem::path& folder, const std::string& mark,
                              const PngShape& shape, int threads) {
  if (to_make_.empty()) return;
  constexpr std::size_t most_bytes = std::size_t{1} << 30;
  const std::size_t count = to_make_.size();
  const std::size_t most = std::clamp<std::size_t>(most_bytes / PngChecker::bytes(shape), 1, count);
  std::vector<char> is_there(count);
  parallel_ranges(std::min(threads, static_cast<int>(most)), count, [&](std::size_t begin, std::size_t end) {
    PngChecker checker(shape);
    for (std::size_t n = begin; n < end; ++n)
      is_there[n] = checker.is_whole(folder / png_name(to_make_[n]), png_mark(mark, to_make_[n])) ? 1 : 0;
  });
  std::vector<long> left;
  for (std::size_t n = 0; n < count; ++n)
    if (is_there[n] == 0) left.push_back(to_make_[n]);
  to_make_ = std::move(left);
}

bool FramePlan::has(long frame) const {
  return std::binary_search(to_make_.begin(), to_make_.end(), frame);
}

bool FramePlan::has_existing(long frame) const {
  return std::binary_search(all_.begin(), all_.end(), frame) && !has(frame);
}

} // namespace rend
