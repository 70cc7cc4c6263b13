#include "render/app/frame_plan.h"

#include "render/pipeline.h"
#include "render/png.h"

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

void FramePlan::leave_out_whole(const std::filesystem::path& folder, const std::string& mark) {
  std::erase_if(to_make_, [&](long frame) {
    const PngText wanted = png_mark(mark, frame);
    return text_of_whole_png(folder / png_name(frame), wanted.keyword) == wanted.text;
  });
}

bool FramePlan::has(long frame) const {
  return std::binary_search(to_make_.begin(), to_make_.end(), frame);
}

bool FramePlan::keeps(long frame) const {
  return std::binary_search(all_.begin(), all_.end(), frame) && !has(frame);
}

} // namespace rend
