#include "sim/base/archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace rend {

void refuse_unless_finite(std::span<const double> numbers) {
  double seen = 0; // 0 · x is 0 exactly for finite x
  for (double each : numbers) seen += 0 * each;
  refuse_unless(seen == 0, "a number is not finite");
}

void refuse_unless_finite(std::span<const float> numbers) {
  float seen = 0;
  for (float each : numbers) seen += 0 * each;
  refuse_unless(seen == 0, "a number is not finite");
}

void refuse_unless_finite(std::span<const Record> records) {
  std::array<double, 3> seen{};
  bool fourth = false;
  for (const Record& each : records) {
    seen[0] += 0 * each.x;
    seen[1] += 0 * each.y;
    seen[2] += 0 * each.z;
    fourth |= each.w != 0; // or NaN
  }
  refuse_unless_finite(seen);
  refuse_unless(!fourth, "a vector has a fourth number");
}

void Archive::raw(void* data, std::size_t bytes) {
  if (bytes == 0) return;
  if (!reading()) return write(static_cast<const std::uint8_t*>(data), bytes);
  if (left() < bytes) throw ArchiveError("it ends too early");
  for (auto* to = static_cast<std::uint8_t*>(data); bytes > 0;) {
    if (from_->empty()) {
      from_ = source_();
      if (from_->empty() || from_->size() > beyond_) throw ArchiveError("it ends too early, or too late");
      beyond_ -= from_->size();
    }
    const std::size_t count = std::min(bytes, from_->size());
    std::memcpy(to, from_->data(), count);
    from_ = from_->subspan(count);
    to += count;
    bytes -= count;
  }
}

void Archive::write(const std::uint8_t* from, std::size_t bytes) {
  while (bytes > 0) {
    const std::size_t count = sink_ ? std::min(bytes, piece - bytes_.size()) : bytes;
    bytes_.insert(bytes_.end(), from, from + count);
    from += count;
    bytes -= count;
    if (!sink_ || bytes_.size() < piece) continue;
    sink_(bytes_);
    bytes_.clear();
  }
}

std::size_t Archive::count(std::size_t present, std::size_t bytes_each) {
  std::uint64_t number = present;
  raw(&number, sizeof number);
  if (reading() && number > left() / bytes_each) throw ArchiveError("a list is longer than the rest of it");
  return static_cast<std::size_t>(number);
}

void Archive::one(bool& value) {
  std::uint8_t byte = value ? 1 : 0;
  raw(&byte, 1);
  refuse_unless(byte <= 1, "a flag is neither yes nor no");
  value = byte != 0;
}

void Archive::one(std::string& value) {
  value.resize(count(value.size(), 1));
  raw(value.data(), value.size());
}

void Archive::one_unbounded(double& value) {
  raw(&value, sizeof value);
  if (reading()) refuse_unless(!std::isnan(value), "a number is none");
}

void Archive::one_unbounded(std::optional<double>& value) {
  bool there = value.has_value();
  one(there);
  if (reading()) value = there ? std::optional(0.0) : std::nullopt;
  if (value) one_unbounded(*value);
}

// The mark found instead is not quoted: it may be any bytes.
void Archive::mark(std::string_view name) {
  std::string there(name);
  if (count(name.size(), 1) == name.size())
    raw(there.data(), there.size());
  else
    there.clear();
  if (there != name) throw ArchiveError(fmt::format("'{}' does not stand where it should", name));
}

void Archive::same(std::uint64_t value, const char* what) {
  std::uint64_t there = value;
  raw(&there, sizeof there);
  if (there != value) throw ArchiveError(fmt::format("{}: {} there, and {} here", what, there, value));
}

void Archive::end() {
  if (sink_ && !bytes_.empty()) sink_(std::exchange(bytes_, {}));
  if (reading() && left() > 0) throw ArchiveError(fmt::format("{} bytes of it are left over", left()));
}

} // namespace rend
