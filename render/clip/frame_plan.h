// The frames that a run has to make: those that were chosen, restricted to its shard, without those whose
// pictures exist already.
//
// The frames of a shard are consecutive, so that all but the last shard can end their simulation early. A
// picture counts as existing if its file is complete, of this run's size, and marked with this scene's key
// (PngChecker, png.h), whatever its name or date.
#pragma once

#include "render/clip/frame_clock.h"
#include "render/clip/shard.h"
#include "render/files/png.h"

#include <filesystem>
#include <string>
#include <vector>

namespace rend {

class FramePlan {
public:
  FramePlan() = default; // none
  // UserError (Usage) if none of the chosen frames is in the clip.
  FramePlan(const FrameChoice& choice, const FrameClock& clock, const Shard& shard);

  // Removes the frames whose pictures exist in `folder`, of that shape and marked with `mark`. Checks as many
  // files at once as there are threads, within 1 GiB of memory.
  void skip_existing(const std::filesystem::path& folder, const std::string& mark, const PngShape& shape,
                     int threads);

  bool has(long frame) const;                                   // has to be made
  bool has_existing(long frame) const;                          // belongs to this run, and exists already
  const std::vector<long>& to_make() const { return to_make_; } // increasing
  const std::vector<long>& all() const { return all_; }         // including those that exist; increasing
  long last() const { return to_make_.empty() ? -1 : to_make_.back(); }
  long first() const { return to_make_.empty() ? -1 : to_make_.front(); }

private:
  std::vector<long> all_, to_make_;
};

} // namespace rend
