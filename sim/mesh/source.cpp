#include "sim/mesh/source.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <sys/stat.h>

namespace rend {

namespace {

constexpr std::size_t block = 4096, piece = 256 * block; // [bytes]

// A block of zero bytes occurs in no mesh: text has no zero bytes, and in a binary file the coordinates
// alternate with tags. A sparse file, of which parts were never written, has such blocks and can claim any size
// without using disk space; it is refused before it uses memory.
void check_written(const std::string& name, std::size_t offset, std::string_view bytes) {
  static const std::string zeros(block, '\0');
  for (std::size_t at = 0; at + block <= bytes.size(); at += block)
    if (bytes.compare(at, block, zeros) == 0)
      throw UserError(
          Exit::BadInput, {name},
          fmt::format("byte {}: from here on {} bytes are zero, which no mesh holds", offset + at, block),
          "it was not written to its end, or has a hole: write it again");
}

// The part of a file's size that is stored. It may be far less than its size.
std::size_t bytes_on_disk(const std::filesystem::path& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 ? static_cast<std::size_t>(status.st_blocks) * 512 : 0;
}

} // namespace

MeshSource MeshSource::open(const std::filesystem::path& path, const std::string& noun) {
  const std::string name = path.string();
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw UserError(Exit::NoInput, {name}, "there is no such " + noun);
  if (!std::filesystem::is_regular_file(path, error)) throw UserError(Exit::BadInput, {name}, "is not a file");
  const auto size = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (!file || error) throw UserError(Exit::ReadWrite, {name}, "cannot be read", "check who may read it");
  std::string bytes, next(piece, '\0');
  bytes.reserve(std::min<std::size_t>(size, bytes_on_disk(path)));
  while (bytes.size() < size) {
    const std::size_t count = std::min<std::size_t>(piece, size - bytes.size());
    if (!file.read(next.data(), static_cast<std::streamsize>(count)))
      throw UserError(Exit::ReadWrite, {name}, "reading it failed");
    check_written(name, bytes.size(), std::string_view(next).substr(0, count));
    bytes.append(next, 0, count);
  }
  return {name, std::move(bytes)};
}

void MeshSource::fail(std::size_t offset, const std::string& what, const std::string& hint) const {
  if (binary) throw UserError(Exit::BadInput, {name_}, fmt::format("byte {}: {}", offset, what), hint);
  offset = std::min(offset, bytes_.size());
  const auto here = bytes_.begin() + static_cast<std::ptrdiff_t>(offset);
  const auto line = std::count(bytes_.begin(), here, '\n');
  const std::size_t newline = offset == 0 ? std::string::npos : bytes_.rfind('\n', offset - 1);
  const std::size_t column = newline == std::string::npos ? offset : offset - newline - 1;
  throw UserError(Exit::BadInput, {name_, static_cast<int>(line) + 1, static_cast<int>(column) + 1}, what,
                  hint);
}

void MeshSource::fail(const std::string& what, const std::string& hint) const {
  throw UserError(Exit::BadInput, {name_}, what, hint);
}

} // namespace rend
