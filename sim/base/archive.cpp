#include "sim/base/archive.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

namespace rend {

void Archive::raw(void* data, std::size_t bytes) {
  if (bytes == 0) return;
  if (!reading()) return write(static_cast<const std::uint8_t*>(data), bytes);
  if (from_->size() < bytes) throw ArchiveError("it ends too early");
  std::memcpy(data, from_->data(), bytes);
  from_ = from_->subspan(bytes);
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
  if (reading() && number > from_->size() / bytes_each)
    throw ArchiveError("a list is longer than the rest of it");
  return static_cast<std::size_t>(number);
}

void Archive::one(bool& value) {
  std::uint8_t byte = value ? 1 : 0;
  raw(&byte, 1);
  value = byte != 0;
}

void Archive::one(std::string& value) {
  value.resize(count(value.size(), 1));
  raw(value.data(), value.size());
}

void Archive::mark(std::string_view name) {
  std::string there(name);
  one(there);
  if (there != name) throw ArchiveError(fmt::format("'{}' stands where '{}' should", there, name));
}

void Archive::same(std::uint64_t value, const char* what) {
  std::uint64_t there = value;
  raw(&there, sizeof there);
  if (there != value) throw ArchiveError(fmt::format("{}: {} there, and {} here", what, there, value));
}

void Archive::end() {
  if (sink_ && !bytes_.empty()) sink_(std::exchange(bytes_, {}));
  if (reading() && !from_->empty())
    throw ArchiveError(fmt::format("{} bytes of it are left over", from_->size()));
}

} // namespace rend
