#include "sim/mesh/source.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace rend {

MeshSource MeshSource::open(const std::filesystem::path& path) {
  const std::string name = path.string();
  std::error_code error;
  if (!std::filesystem::exists(path, error))
    throw UserError(Exit::NoInput, {name}, "there is no such mesh file", "names are relative to the preset");
  if (!std::filesystem::is_regular_file(path, error)) throw UserError(Exit::BadInput, {name}, "is not a file");
  const auto size = std::filesystem::file_size(path, error);
  std::ifstream file(path, std::ios::binary);
  if (!file || error) throw UserError(Exit::ReadWrite, {name}, "cannot be read", "check who may read it");
  std::string bytes(size, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(size));
  if (file.bad() || file.gcount() != static_cast<std::streamsize>(size))
    throw UserError(Exit::ReadWrite, {name}, "reading it failed");
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
