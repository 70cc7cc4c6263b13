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
#include <cstdint>
#include <cstring>
#include <fstream>
#include <span>

namespace rend {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view first_line = "rend checkpoint 2\n"; // with the format's version

using Fields = std::array<std::uint64_t, 2>; // key, next frame
constexpr std::size_t head_size = first_line.size() + sizeof(Fields);

// Of what came before, and one more piece.
std::uint64_t sum_with(std::uint64_t sum, std::span<const std::uint8_t> piece) {
  return hash_bytes(piece.data(), piece.size(), sum);
}

std::uint64_t sum_of(std::span<const std::uint8_t> head, std::span<const std::uint8_t> state) {
  std::uint64_t sum = sum_with(0, head);
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

// As many of the first bytes as there are, all of one file: another may take its name meanwhile. None: it is
// gone.
std::optional<std::vector<std::uint8_t>> first_bytes(const fs::path& path,
                                                     std::optional<std::size_t> most = {}) {
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  const auto all = static_cast<std::streamoff>(file.tellg());
  if (!file || all < 0) return {};
  std::vector<std::uint8_t> bytes(std::min(most.value_or(SIZE_MAX), static_cast<std::size_t>(all)));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

// None: this is no checkpoint that this rend can read.
std::optional<CheckpointHead> head_in(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < head_size || !std::equal(first_line.begin(), first_line.end(), bytes.begin())) return {};
  Fields fields;
  std::memcpy(fields.data(), bytes.data() + first_line.size(), sizeof fields);
  return CheckpointHead{fields[0], static_cast<long>(fields[1])};
}

CheckpointHead head_of(const fs::path& path, std::span<const std::uint8_t> bytes) {
  const auto head = head_in(bytes);
  if (!head) refuse(path, "this is no checkpoint that this rend can read");
  return *head;
}

// What stands between the head and the sum, where the sum is right.
std::optional<std::span<const std::uint8_t>> state_in(std::span<const std::uint8_t> bytes) {
  std::uint64_t sum = 0;
  if (bytes.size() < head_size + sizeof sum) return {};
  const std::size_t end = bytes.size() - sizeof sum;
  std::memcpy(&sum, bytes.data() + end, sizeof sum);
  const std::span<const std::uint8_t> state = bytes.subspan(head_size, end - head_size);
  if (sum != sum_of(bytes.first(head_size), state)) return {};
  return state;
}

void store(Archive& archive, Session& session, Film& film) {
  session.scene().store(archive);
  film.store(archive);
}

} // namespace

std::string picture_key(const Session& session, int width, int height, int samples) {
  const bool hud = session.preset().child("hud") != nullptr && hud_available();
  const std::string words = fmt::format("{:016x} {}x{} {} {}", session.key(), width, height, samples, hud);
  return fmt::format("{:016x}", hash_bytes(words.data(), words.size()));
}

std::string checkpoint_key(const std::string& picture_key) {
  const std::vector<std::uint8_t> program = first_bytes("/proc/self/exe").value_or(std::vector<std::uint8_t>{});
  return fmt::format("{:016x}", hash_bytes(program.data(), program.size(), number_of(picture_key)));
}

void write_checkpoint(const fs::path& path, const std::string& key, long next, Session& session, Film& film) {
  const Fields fields{number_of(key), static_cast<std::uint64_t>(next)};
  std::vector<std::uint8_t> head(first_line.begin(), first_line.end());
  head.insert(head.end(), bytes_of(fields).begin(), bytes_of(fields).end());
  sync_folder(path.parent_path()); // it says that the frames before it are there
  OutputFile file(path);
  file.write(head);
  std::array<std::uint64_t, 1> sum{sum_with(0, head)};
  Archive archive([&](std::span<const std::uint8_t> piece) {
    sum[0] = sum_with(sum[0], piece);
    file.write(piece);
  });
  store(archive, session, film);
  archive.end();
  file.write(bytes_of(sum));
  file.commit();
}

std::optional<CheckpointHead> read_checkpoint_head(const fs::path& path, const std::string& key) {
  const auto bytes = first_bytes(path, head_size);
  if (!bytes) return {};
  const CheckpointHead head = head_of(path, *bytes);
  if (head.key != number_of(key))
    refuse(path, "the checkpoint is of another preset, of other settings, or of another rend");
  return head;
}

std::optional<CheckpointHead> read_checkpoint(const fs::path& path, const std::string& key, long first,
                                              Session& session, Film& film) {
  const auto bytes = first_bytes(path);
  if (!bytes) return {};
  const CheckpointHead head = head_of(path, *bytes);
  const auto state = state_in(*bytes);
  if (!state) refuse(path, "the checkpoint is damaged: its sum is another");
  if (head.key != number_of(key) || head.next > first) return {};
  try {
    Archive archive(*state);
    store(archive, session, film);
    archive.end();
  } catch (const ArchiveError& fault) {
    refuse(path, fmt::format("the checkpoint is of another scene: {}", fault.what()));
  }
  if (head.next < 0 || session.clock().step_of(head.next - 1) > session.scene().steps_done())
    refuse(path,
           fmt::format("the checkpoint says that frame {} is next, and its scene is not there yet", head.next));
  return head;
}

fs::path checkpoint_path(const fs::path& folder, const std::string& name, const Shard& shard) {
  const std::string part = shard.whole() ? "" : fmt::format(".{}-of-{}", shard.number, shard.count);
  return folder / (name + part + ".checkpoint");
}

std::vector<FoundCheckpoint> find_checkpoints(const fs::path& own, const std::string& key, long first) {
  std::vector<FoundCheckpoint> all;
  std::error_code error;
  for (fs::directory_iterator at(own.parent_path(), error), end; !error && at != end; at.increment(error)) {
    if (at->path().extension() != ".checkpoint" || at->path() == own) continue;
    const auto bytes = first_bytes(at->path(), head_size);
    const auto head = bytes ? head_in(*bytes) : std::nullopt;
    if (head && head->key == number_of(key) && head->next <= first) all.push_back({at->path(), *head});
  }
  std::sort(all.begin(), all.end(), [](const FoundCheckpoint& a, const FoundCheckpoint& b) {
    return a.head.next != b.head.next ? a.head.next > b.head.next : a.path < b.path;
  });
  const auto head = read_checkpoint_head(own, key);
  if (head && head->next <= first) all.insert(all.begin(), {own, *head});
  return all;
}

} // namespace rend
