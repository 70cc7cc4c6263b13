// A part of the work, for one of several programs that share it: "2/7" is the second of seven.
#pragma once

#include <optional>
#include <string>

namespace rend {

struct Shard {
  long number = 1, count = 1; // 1 ≤ number ≤ count
  bool whole() const { return count == 1; }
  std::string text() const; // "2/7"

  // Its part of `all` things in a row, [first, last): parts differ by one at most, and together are all.
  long first(long all) const { return (number - 1) * all / count; }
  long last(long all) const { return number * all / count; }
};

Shard parse_shard(const std::string& text); // UserError (Usage)

// What Slurm says of the array task that this is (SLURM_ARRAY_TASK_ID, _COUNT, _MIN, _STEP); none: it is none,
// or the only one. UserError (Usage) where these are no such numbers.
std::optional<Shard> slurm_shard();

// `given`, or else Slurm's, or else the whole.
Shard shard_for(const std::string& given);

} // namespace rend
