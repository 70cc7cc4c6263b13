#include "render/app/checkpoint.h"

#include "render/app/film.h"
#include "render/app/session.h"
#include "render/app/shard.h"
#include "render/hud.h"
#include "render/output.h"
#include "sim/base/archive.h"
#include "sim/base/hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>
#include <iterator>

namespace rend {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view first_line = "rend checkpoint 1\n"; // with the format's version

using Fields = std::array<std::uint64_t, 2>; // key, next frame
constexpr std::size_t head_size = first_line.size() + sizeof(Fields);

// Of what came before, and one more piece.
std::uint64_t sum_with(std::uint64_t sum, std::span<const std::uint8_t> piece) {
  return hash_bytes(piece.data(), piece.size(), sum);
}

std::uint64_t sum_of(std::span<const std::uint8_t> state) {
  std::uint64_t sum = 0;
  for (; !state.empty(); state = state.subspan(std::min(Archive::piece, state.size())))
    sum = sum_with(sum, state.first(std::min(Archive::piece, state.size())));
  return sum;
}

template <class T> std::span<const std::uint8_t> bytes_of(const T& plain) {
  return {reinterpret_cast<const std::uint8_t*>(plain.data()), plain.size() * sizeof(plain[0])};
}

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw UserError(Exit::BadInput, {path.string()}, what,
                  "render without --resume to begin anew, which replaces it, or into another folder with -o");
}

std::uint64_t number_of(const std::string& key) {
  return std::stoull(key, nullptr, 16);
}

// As many of the first bytes as there are.
std::vector<std::uint8_t> first_bytes(const fs::path& path, std::size_t most) {
  std::vector<std::uint8_t> bytes(most);
  std::ifstream file(path, std::ios::binary);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(most));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

Fields fields_of(const fs::path& path, const std::vector<std::uint8_t>& bytes) {
  if (bytes.size() < head_size || !std::equal(first_line.begin(), first_line.end(), bytes.begin()))
    refuse(path, "this is no checkpoint that this rend can read");
  Fields fields;
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(first_line.size()), sizeof fields,
              reinterpret_cast<std::uint8_t*>(fields.data()));
  return fields;
}

void store(Archive& archive, Session& session, Film& film) {
  session.scene().store(archive);
  film.store(archive);
}

} // namespace

std::string picture_key(const Session& session, int width, int height, int samples) {
  const std::string words =
      fmt::format("{:016x} {}x{} {} {}", session.key(), width, height, samples, hud_available());
  return fmt::format("{:016x}", hash_bytes(words.data(), words.size()));
}

void write_checkpoint(const fs::path& path, const std::string& key, long next, Session& session, Film& film) {
  OutputFile file(path);
  file.write(bytes_of(first_line));
  file.write(bytes_of(Fields{number_of(key), static_cast<std::uint64_t>(next)}));
  std::array<std::uint64_t, 1> sum{};
  Archive archive([&](std::span<const std::uint8_t> piece) {
    sum[0] = sum_with(sum[0], piece);
    file.write(piece);
  });
  store(archive, session, film);
  archive.end();
  file.write(bytes_of(sum));
  file.commit();
}

std::optional<CheckpointHead> read_checkpoint_head(const fs::path& path) {
  std::error_code error;
  if (!fs::exists(path, error)) return {};
  const Fields fields = fields_of(path, first_bytes(path, head_size));
  return CheckpointHead{fields[0], static_cast<long>(fields[1])};
}

void read_checkpoint(const fs::path& path, Session& session, Film& film) {
  const std::vector<std::uint8_t> bytes = first_bytes(path, fs::file_size(path));
  fields_of(path, bytes);
  constexpr std::size_t sum_size = sizeof(std::uint64_t);
  if (bytes.size() < head_size + sum_size) refuse(path, "the checkpoint is cut off");
  const std::span<const std::uint8_t> state =
      std::span(bytes).subspan(head_size, bytes.size() - head_size - sum_size);
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + head_size + state.size(), sum_size);
  if (sum != sum_of(state)) refuse(path, "the checkpoint is damaged: its sum is another");
  try {
    Archive archive(state);
    store(archive, session, film);
    archive.end();
  } catch (const ArchiveError& fault) {
    refuse(path, fmt::format("the checkpoint is of another scene: {}", fault.what()));
  }
}

fs::path checkpoint_path(const fs::path& folder, const std::string& name, const Shard& shard) {
  const std::string part = shard.whole() ? "" : fmt::format(".{}-of-{}", shard.number, shard.count);
  return folder / (name + part + ".checkpoint");
}

std::optional<FoundCheckpoint> find_checkpoint(const fs::path& own, const std::string& key, long first) {
  const auto there = read_checkpoint_head(own);
  if (there && there->key != number_of(key))
    refuse(own, "the checkpoint is of another preset, of other settings, or of another rend");
  std::optional<FoundCheckpoint> best;
  const auto consider = [&](const fs::path& path, const CheckpointHead& head) {
    if (head.key == number_of(key) && head.next <= first && (!best || head.next > best->head.next))
      best = {path, head};
  };
  if (there) consider(own, *there);
  std::vector<fs::path> others;
  std::error_code error;
  for (fs::directory_iterator at(own.parent_path(), error), end; !error && at != end; at.increment(error))
    if (at->path().extension() == ".checkpoint" && at->path() != own) others.push_back(at->path());
  std::sort(others.begin(), others.end());
  for (const fs::path& path : others) {
    const std::vector<std::uint8_t> bytes = first_bytes(path, head_size);
    if (bytes.size() < head_size || !std::equal(first_line.begin(), first_line.end(), bytes.begin())) continue;
    const Fields fields = fields_of(path, bytes);
    consider(path, {fields[0], static_cast<long>(fields[1])});
  }
  return best;
}

} // namespace rend
