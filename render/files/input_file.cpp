#include "render/files/input_file.h"

#include "sim/base/error.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <limits>

namespace rend {

InputFile open_input(const std::filesystem::path& path) {
  const Place place{path.string()};
  std::error_code error;
  if (std::filesystem::is_directory(path, error))
    throw UserError(Exit::NoInput, place, "this is a folder, not a picture");
  if (std::filesystem::exists(path, error) && !std::filesystem::is_regular_file(path, error))
    throw UserError(Exit::NoInput, place, "this is not a regular file");
  InputFile file(std::fopen(path.c_str(), "rb"));
  if (!file)
    throw UserError(Exit::NoInput, place, fmt::format("it cannot be opened: {}", std::strerror(errno)));
  return file;
}

std::size_t size_of_file(const std::filesystem::path& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw UserError(Exit::ReadWrite, {path.string()}, "its size cannot be read: " + error.message());
  return size;
}

std::vector<std::uint8_t> first_bytes(const std::filesystem::path& path, std::size_t most) {
  const InputFile file = open_input(path);
  std::vector<std::uint8_t> bytes(std::min(most, size_of_file(path)));
  const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), file.get());
  if (std::ferror(file.get()))
    throw UserError(Exit::ReadWrite, {path.string()},
                    fmt::format("it cannot be read: {}", std::strerror(errno)));
  bytes.resize(count);
  return bytes;
}

std::vector<std::uint8_t> file_bytes(const std::filesystem::path& path) {
  return first_bytes(path, std::numeric_limits<std::size_t>::max());
}

} // namespace rend
