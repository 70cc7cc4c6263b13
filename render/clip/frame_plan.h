// Which frames of a clip a run is to make: those that were asked for, of these its shard's part, and of these
// what is not there yet.
//
// A shard's frames follow each other, so that all but the last shard end their simulation early. A picture is
// there where its file is whole, of this run's size, and made of this scene (PngChecker, png.h), whatever its
// name or date say.
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
  // UserError (Usage) where the clip has none of the frames that were chosen.
  FramePlan(const FrameChoice& choice, const FrameClock& clock, const Shard& shard);

  // Takes out the frames whose pictures are in `folder`, of that shape and marked with `mark`. Looks at as many
  // at once as there are threads, and memory of 1 GiB for them.
  void leave_out_whole(const std::filesystem::path& folder, const std::string& mark, const PngShape& shape,
                       int threads);

  bool has(long frame) const;                                   // is to be made
  bool keeps(long frame) const;                                 // is this run's, and there already
  const std::vector<long>& to_make() const { return to_make_; } // increasing
  const std::vector<long>& all() const { return all_; }         // with those that are there; increasing
  long last() const { return to_make_.empty() ? -1 : to_make_.back(); }
  long first() const { return to_make_.empty() ? -1 : to_make_.front(); }

private:
  std::vector<long> all_, to_make_;
};

} // namespace rend
