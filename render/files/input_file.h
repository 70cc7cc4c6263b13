// Files that are read: opened, measured, read whole or in part. What is no regular file is refused before it is
// opened, so that a FIFO does not block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <vector>

namespace rend {

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};
using InputFile = std::unique_ptr<std::FILE, CloseFile>;

// All throw UserError, at the path. NoInput: it cannot be opened or is not a regular file; ReadWrite.
InputFile open_input(const std::filesystem::path& path);
std::size_t size_of_file(const std::filesystem::path& path); // [bytes]
std::vector<std::uint8_t> file_bytes(const std::filesystem::path& path);
std::vector<std::uint8_t> first_bytes(const std::filesystem::path& path, std::size_t most);

} // namespace rend
