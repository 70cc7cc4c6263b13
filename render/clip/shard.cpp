#include "render/clip/shard.h"

#include "sim/base/error.h"
#include "sim/base/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

namespace rend {
namespace {

constexpr long most_shards = 1'000'000;

std::optional<long> number_in(std::string_view text) {
  long value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty() || value < 0) return {};
  return value;
}

// From an environment variable; none: it is not set.
std::optional<long> slurm_number(const char* name) {
  const char* text = std::getenv(name);
  if (text == nullptr) return {};
  const auto value = number_in(text);
  if (!value)
    throw UserError(Exit::Usage, {}, fmt::format("{} is {}, and should be a number", name, in_quotes(text)),
                    "name the part by --shard I/N, or --shard 1/1 for all");
  return value;
}

} // namespace

std::string Shard::text() const {
  return fmt::format("{}/{}", number, count);
}

Shard parse_shard(const std::string& text) {
  const auto fail = [&](const std::string& what) {
    throw UserError(Exit::Usage, {}, fmt::format("--shard {}: {}", in_quotes(text), what),
                    "write it as 2/7: the second of seven parts");
  };
  const std::size_t slash = std::min(text.find('/'), text.size());
  const auto number = number_in(std::string_view(text).substr(0, slash));
  const auto count = number_in(std::string_view(text).substr(std::min(slash + 1, text.size())));
  if (!number || !count) fail("it is not of the form I/N");
  if (*count < 1 || *count > most_shards) fail(fmt::format("there can be 1 to {} parts", most_shards));
  if (*number < 1 || *number > *count) fail(fmt::format("of {} parts there is no number {}", *count, *number));
  return {*number, *count};
}

std::optional<Shard> slurm_shard() {
  const auto id = slurm_number("SLURM_ARRAY_TASK_ID"), count = slurm_number("SLURM_ARRAY_TASK_COUNT");
  if (!id || !count || *count <= 1) return {};
  const long least = slurm_number("SLURM_ARRAY_TASK_MIN").value_or(0);
  const long step = std::max(slurm_number("SLURM_ARRAY_TASK_STEP").value_or(1), 1L);
  if (*id < least || (*id - least) / step >= *count)
    throw UserError(
        Exit::Usage, {},
        fmt::format("Slurm's array task {} is not one of {} tasks numbered from {}", *id, *count, least),
        "number the array tasks evenly (--array=1-7), or name the part by --shard I/N");
  return Shard{(*id - least) / step + 1, *count};
}

Shard shard_for(const std::string& given) {
  if (!given.empty()) return parse_shard(given);
  return slurm_shard().value_or(Shard{});
}

} // namespace rend
