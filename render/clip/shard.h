// One of several parts of the work, for programs that share it: "2/7" is the second of seven.
#pragma once

#include <optional>
#include <string>

namespace rend {

struct Shard {
  long number = 1, count = 1; // 1 ≤ number ≤ count
  bool whole() const { return count == 1; }
  std::string text() const; // "2/7"

  // Its part of `all` consecutive items, [first, last): sizes of parts differ by at most one, and the parts
  // cover all.
  long first(long all) const { return (number - 1) * all / count; }
  long last(long all) const { return number * all / count; }
};

Shard parse_shard(const std::string& text); // UserError (Usage)

// From the variables of a Slurm array task (SLURM_ARRAY_TASK_ID, _COUNT, _MIN, _STEP); none: not an array task,
// or the only one. UserError (Usage) if they are not valid numbers.
std::optional<Shard> slurm_shard();

// `given`, else that of the Slurm task, else the whole.
Shard shard_for(const std::string& given);

} // namespace rend
