#include "sim/base/wording.h"

#include "sim/base/printable.h"

#include <algorithm>
#include <cstddef>
#include <fmt/format.h>
#include <vector>

namespace rend {
namespace {

std::string small_letters(std::string_view name) {
  std::string out(name);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  }
  return out;
}

// "stress" of "vertex-stress", "mp4" of "clip.mp4": at least three letters after a separator.
bool is_last_part(const std::string& part, const std::string& whole) {
  if (part.size() < 3 || whole.size() < part.size() + 2 || !whole.ends_with(part)) return false;
  const char mark = whole[whole.size() - part.size() - 1];
  return mark == '-' || mark == '.';
}

// Row by row; three rows suffice, as a transposition refers to the row before the last.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before(b.size() + 1), above(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) above[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = above[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({above[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    std::swap(before, above);
    std::swap(above, row);
  }
  return above[b.size()];
}

} // namespace

std::string nearest(std::string_view name, std::span<const std::string> names) {
  const std::string wanted = small_letters(name);
  std::string best;
  std::size_t best_distance = 0;
  for (const std::string& candidate : names) {
    const std::string other = small_letters(candidate);
    const std::size_t shorter = std::min(wanted.size(), other.size());
    const std::size_t longer = std::max(wanted.size(), other.size());
    const bool begins = shorter >= 3 && wanted.compare(0, shorter, other, 0, shorter) == 0;
    const bool part = is_last_part(wanted, other) || is_last_part(other, wanted);
    const std::size_t allowed = wanted == other || shorter < 2 ? 0 : std::max<std::size_t>(1, shorter / 3);
    // Names of very different length are skipped: the cost is the product of the lengths.
    if (!begins && !part && longer - shorter > allowed) continue;
    const std::size_t distance = begins ? std::min<std::size_t>(longer - shorter, 1)
                                 : part ? 2
                                        : edit_distance(wanted, other);
    if (!begins && !part && distance > allowed) continue;
    if (best.empty() || distance < best_distance) {
      best = candidate;
      best_distance = distance;
    }
  }
  return best;
}

std::string listed(std::span<const std::string> names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

std::string suggestion(std::string_view name, std::span<const std::string> names, std::string_view what) {
  if (names.empty()) return {};
  const std::string near = nearest(name, names);
  std::string out = near.empty() ? "" : fmt::format("did you mean '{}'?", near);
  if (what.empty()) return out;
  if (!out.empty()) out += ' ';
  return out + fmt::format("{}: {}", what, listed(names));
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t most = 60;
  std::string out = "'";
  while (!text.empty()) {
    const std::string next = take_printable(text);
    if (out.size() - 1 + next.size() > most) return out + "...'";
    out += next;
  }
  return out + "'";
}

} // namespace rend
