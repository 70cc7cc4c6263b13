#include "render/clip/checkpoint.h"

#include "render/clip/frame_output.h"
#include "render/clip/session.h"
#include "render/clip/shard.h"
#include "render/draw/hud.h"
#include "render/files/output.h"
#include "sim/base/archive.h"
#include "sim/base/hash.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <span>
#include <sys/stat.h>
#include <unistd.h>

namespace rend {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view first_line = "rend checkpoint 3\n"; // with the format's version

using HeadNumbers = std::array<std::uint64_t, 2>; // key, next frame
constexpr std::size_t head_size = first_line.size() + sizeof(HeadNumbers);

// Chains the checksum of all pieces so far with one more piece.
std::uint64_t sum_with(std::uint64_t sum, std::span<const std::uint8_t> piece) {
  return hash_bytes(piece.data(), piece.size(), sum);
}

template <class T> std::span<const std::uint8_t> bytes_of(const T& plain) {
  return {reinterpret_cast<const std::uint8_t*>(plain.data()), plain.size() * sizeof(plain[0])};
}

[[noreturn]] void refuse(const fs::path& path, const std::string& what) {
  throw UserError(Exit::BadInput, {path.string()}, what,
                  "leave out --resume to start again and replace it, or choose another folder with -o");
}

std::uint64_t number_of(const std::string& key) {
  return std::stoull(key, nullptr, 16);
}

// A file that is read through one descriptor, a piece at a time: another file may take its name meanwhile.
class Source {
public:
  // Opens without blocking, whatever kind of file it is. Not open where there is no such file.
  explicit Source(const fs::path& path) : path_(path), file_(::open(path.c_str(), flags)) {
    if (file_ < 0 && errno == ENOENT) return;
    const bool link = file_ < 0 && errno == ELOOP;
    if (file_ < 0 && !link) fail();
    struct stat there {};
    if (!link && ::fstat(file_, &there) != 0) fail();
    if (link || !S_ISREG(there.st_mode))
      refuse(path, fmt::format("a checkpoint is a regular file, and this is {}", kind_of(link, there.st_mode)));
    left_ = size_ = static_cast<std::size_t>(there.st_size);
  }
  ~Source() {
    if (file_ >= 0) ::close(file_);
  }
  Source(const Source&) = delete;
  Source& operator=(const Source&) = delete;

  bool is_open() const { return file_ >= 0; }
  std::size_t left() const { return left_; } // [bytes] not read yet, by the file's size when it was opened

  // The next bytes, at most `most`; fewer only at the end. Valid until the next call.
  std::span<const std::uint8_t> next(std::size_t most) {
    bytes_.resize(std::min(most, left_));
    std::size_t count = 0;
    while (count < bytes_.size()) {
      const ssize_t more = ::read(file_, bytes_.data() + count, bytes_.size() - count);
      if (more < 0 && errno == EINTR) continue;
      if (more < 0) fail();
      if (more == 0) break; // the file was truncated meanwhile
      count += static_cast<std::size_t>(more);
    }
    left_ -= bytes_.size();
    return std::span(bytes_).first(count);
  }

private:
  static constexpr int flags = O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;
  static const char* kind_of(bool link, mode_t mode) {
    return link ? "a symbolic link" : S_ISDIR(mode) ? "a folder" : S_ISFIFO(mode) ? "a pipe" : "none";
  }
  [[noreturn]] void fail() const {
    throw UserError(Exit::ReadWrite, {path_.string()},
                    fmt::format("the checkpoint cannot be read: {}", std::strerror(errno)));
  }
  fs::path path_;
  int file_; // descriptor; -1: there is none
  std::size_t size_ = 0, left_ = 0;
  std::vector<std::uint8_t> bytes_;
};

// None: not a checkpoint of this format.
std::optional<CheckpointHeader> head_in(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < head_size || !std::equal(first_line.begin(), first_line.end(), bytes.begin())) return {};
  HeadNumbers fields;
  std::memcpy(fields.data(), bytes.data() + first_line.size(), sizeof fields);
  return CheckpointHeader{fields[0], static_cast<long>(fields[1])};
}

CheckpointHeader head_of(const fs::path& path, std::span<const std::uint8_t> bytes) {
  const auto head = head_in(bytes);
  if (!head) refuse(path, "this is not a checkpoint that this version of rend can read");
  return *head;
}

// Reads what lies between the header and the checksum, piece by piece, and verifies the checksum.
class StoredState {
public:
  StoredState(Source& source, std::span<const std::uint8_t> head) : source_(source), sum_(sum_with(0, head)) {}

  // [bytes], not read yet
  std::size_t size() const { return source_.left() - std::min(source_.left(), sizeof sum_); }
  std::span<const std::uint8_t> next() {
    const std::span<const std::uint8_t> piece = source_.next(std::min(Archive::piece, size()));
    sum_ = sum_with(sum_, piece);
    return piece;
  }
  // Valid after the last piece.
  bool sum_is_right() {
    const std::span<const std::uint8_t> there = source_.next(sizeof sum_);
    return there.size() == sizeof sum_ && std::memcmp(there.data(), &sum_, sizeof sum_) == 0;
  }

private:
  Source& source_;
  std::uint64_t sum_;
};

void store(Archive& archive, Session& session, FrameOutput& output) {
  session.scene().store(archive);
  output.store(archive);
}

} // namespace

std::string picture_key(const Session& session, int width, int height, int samples) {
  const bool hud = session.preset().child("hud") != nullptr && hud_available();
  const std::string words = fmt::format("{:016x} {}x{} {} {}", session.key(), width, height, samples, hud);
  return fmt::format("{:016x}", hash_bytes(words.data(), words.size()));
}

std::string checkpoint_key(const std::string& picture_key) {
  std::ifstream program("/proc/self/exe", std::ios::binary);
  std::vector<std::uint8_t> piece(Archive::piece);
  std::uint64_t sum = number_of(picture_key);
  while (program.read(reinterpret_cast<char*>(piece.data()), static_cast<std::streamsize>(piece.size())) ||
         program.gcount() > 0)
    sum = sum_with(sum, std::span(piece).first(static_cast<std::size_t>(program.gcount())));
  return fmt::format("{:016x}", sum);
}

void write_checkpoint(const fs::path& path, const std::string& key, long next, Session& session,
                      FrameOutput& output) {
  const HeadNumbers fields{number_of(key), static_cast<std::uint64_t>(next)};
  std::vector<std::uint8_t> head(first_line.begin(), first_line.end());
  head.insert(head.end(), bytes_of(fields).begin(), bytes_of(fields).end());
  sync_folder(path.parent_path()); // the checkpoint claims that the frames before it exist
  OutputFile file(path);
  file.write(head);
  std::array<std::uint64_t, 1> sum{sum_with(0, head)};
  Archive archive([&](std::span<const std::uint8_t> piece) {
    sum[0] = sum_with(sum[0], piece);
    file.write(piece);
  });
  store(archive, session, output);
  archive.end();
  file.write(bytes_of(sum));
  file.commit();
}

std::optional<CheckpointHeader> read_checkpoint_header(const fs::path& path, const std::string& key) {
  Source source(path);
  if (!source.is_open()) return {};
  const CheckpointHeader head = head_of(path, source.next(head_size));
  if (head.key != number_of(key))
    refuse(path,
           "the checkpoint was made from another preset, with other settings, or by another build of rend");
  return head;
}

// The checksum is known only when everything has been read. Accidental damage is mostly found earlier, by
// values that are out of range; a forged file can have a checksum that is right, so each value is validated
// anyway.
std::optional<CheckpointHeader> read_checkpoint(const fs::path& path, const std::string& key, long first,
                                                Session& session, FrameOutput& output) {
  Source source(path);
  if (!source.is_open()) return {};
  const std::span<const std::uint8_t> start = source.next(head_size);
  const CheckpointHeader head = head_of(path, start);
  StoredState state(source, start);
  const bool wanted = head.key == number_of(key) && head.next <= first;
  try {
    Archive archive([&] { return state.next(); }, state.size());
    if (wanted) store(archive, session, output);
    if (wanted) archive.end();
  } catch (const ArchiveError& fault) {
    refuse(path, fmt::format("the checkpoint is damaged, or of another scene: {}", fault.what()));
  }
  while (state.size() > 0 && !state.next().empty()) continue;
  if (!state.sum_is_right()) refuse(path, "the checkpoint is damaged: its checksum does not match");
  if (!wanted) return {};
  const FrameClock& clock = session.clock();
  const long done = session.scene().steps_done();
  if (head.next < 0 || clock.step_of(head.next - 1) > done || clock.first_step(head.next) < done)
    refuse(path,
           fmt::format(
               "the checkpoint is damaged: it says that frame {} is next, but its scene is at another time",
               head.next));
  return head;
}

fs::path checkpoint_path(const fs::path& folder, const std::string& name, const Shard& shard) {
  const std::string part = shard.whole() ? "" : fmt::format(".{}-of-{}", shard.number, shard.count);
  return folder / (name + part + ".checkpoint");
}

namespace {

// Whether a file's name is that of a checkpoint of a run called `name`, of any shard.
bool is_checkpoint_of(const std::string& name, const std::string& file) {
  if (file == checkpoint_path({}, name, {})) return true;
  if (!file.starts_with(name + ".")) return false;
  Shard shard{0, 0};
  const char *end = file.data() + file.size(), *of = file.data() + name.size() + 1;
  of = std::from_chars(of, end, shard.number).ptr;
  constexpr std::string_view between = "-of-";
  if (!std::string_view(of, end).starts_with(between)) return false;
  std::from_chars(of + between.size(), end, shard.count);
  return shard.number >= 1 && shard.number <= shard.count && file == checkpoint_path({}, name, shard);
}

// None: not a checkpoint, or not readable.
std::optional<CheckpointHeader> head_of_another(const fs::path& path) try {
  Source source(path);
  return source.is_open() ? head_in(source.next(head_size)) : std::nullopt;
} catch (const UserError&) {
  return {};
}

} // namespace

std::vector<FoundCheckpoint> find_checkpoints(const fs::path& folder, const std::string& name,
                                              const Shard& shard, const std::string& key, long first) {
  const fs::path own = checkpoint_path(folder, name, shard);
  std::vector<FoundCheckpoint> all;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string file = at->path().filename().string();
    if (file == own.filename() || !is_checkpoint_of(name, file)) continue;
    const auto head = head_of_another(at->path());
    if (head && head->key == number_of(key) && head->next <= first) all.push_back({at->path(), *head});
  }
  std::sort(all.begin(), all.end(), [](const FoundCheckpoint& a, const FoundCheckpoint& b) {
    return a.head.next != b.head.next ? a.head.next > b.head.next : a.path < b.path;
  });
  const auto head = read_checkpoint_header(own, key);
  if (head && head->next <= first) all.insert(all.begin(), {own, *head});
  return all;
}

} // namespace rend
