// Where the time and the bytes of a run went (rend run --profile): by stage of the step, by interaction, and as
// a share of this machine's measured bandwidth and arithmetic speed.
//
// Bytes are a lower bound of what is read and written, each array once per pass (passes.h,
// sim/rows/row_cost.h): a share of the memory bandwidth above 1 means that data came from the caches. They are
// computed for the final state.
#pragma once

#include "render/clip/session.h"
#include "render/facts/machine_speed.h"
#include "render/facts/rows_are.h"
#include "sim/base/profile.h"
#include "sim/rows/row_cost.h"

#include <nlohmann/json_fwd.hpp>

#include <optional>
#include <string>
#include <vector>

namespace rend {

struct StageFigures {
  Phase stage = Phase::Rest;
  Profile::Spent spent;
  std::optional<double> share;            // of the seconds of all stages; none: no time was taken
  std::optional<double> seconds_per_step; // none: no step was made
  double bytes_per_step = 0;              // 0: not known of this stage
  std::optional<double> bandwidth_share; // of the memory's; none: no time was taken, or the bytes are not known
};

struct InteractionFigures {
  std::string body, name;
  RowsAre rows_are = RowsAre::Single;
  std::size_t rows = 0;
  long evaluations = 0;
  double seconds = 0; // of all threads together
  std::optional<double> ns_per_row;
  RowCost cost; // of a row
  std::optional<double> bandwidth_share, peak_share;
};

struct ProfileFigures {
  double build = 0, bind = 0; // [s], before the time loop
  double seconds = 0;         // of the time loop
  std::vector<StageFigures> stages;
  std::vector<InteractionFigures> interactions;
  MachineSpeed machine;
  std::string width;       // of vectors: "avx2"
  long readings = 0;       // of the clock
  double seconds_each = 0; // of these
};

// Of a session that was asked for a profile; measures the machine.
ProfileFigures profile_of(const Session& session);

nlohmann::ordered_json json_of(const ProfileFigures& profile);
std::string profile_in_words(const ProfileFigures& profile); // at most 112 columns

} // namespace rend
