#include "render/clip/inputs.h"

#include "sim/base/hash.h"
#include "sim/preset/paths.h"

#include <fmt/format.h>

#include <fstream>

namespace rend {
namespace {

// XXH3 of a file's content, read in pieces.
std::uint64_t hash_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<char> piece(std::size_t{1} << 20U);
  std::uint64_t hash = 0;
  while (file.read(piece.data(), static_cast<std::streamsize>(piece.size())) || file.gcount() > 0)
    hash = hash_bytes(piece.data(), static_cast<std::size_t>(file.gcount()), hash);
  return hash;
}

} // namespace

std::string hashes_of_files(const PresetNode& scene) {
  std::string words;
  for (const FileOfPreset& file : files_of(scene))
    words += fmt::format("{} {:016x}\n", file.node->name(), hash_of(file.path()));
  return words;
}

} // namespace rend
