// A run that was stopped, in a file: the scene between two steps, what its pictures follow, and which frame is next.
//
//   rend checkpoint, a line of text             so that `head -1` tells what it is
//   key, next frame                             64 bits each
//   the numbers of the scene and its pictures   sim/base/archive.h
//   their XXH3, piece after piece               64 bits
//
// It stands in the folder of the pictures while a run is under way, appears whole or not at all, and goes when the run is
// complete. All frames before the next one are in that folder when it is written.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rend {

class Film;
class Session;
struct Shard;

// What a checkpoint says of itself.
struct CheckpointHead {
  std::uint64_t key = 0; // of the scene and its pictures: picture_key()
  long next = 0;         // frame
};

// Of all that a picture's bytes hang on but for its number: Session::key(), its size in pixels and samples, and whether
// this rend can write over it. 16 hex digits.
std::string picture_key(const Session& session, int width, int height, int samples);

void write_checkpoint(const std::filesystem::path& path, const std::string& key, long next, Session& session,
                      Film& film); // UserError (CannotCreate, ReadWrite)

// None: there is no such file. UserError (BadInput): it is no checkpoint, or of another rend; damaged.
std::optional<CheckpointHead> read_checkpoint_head(const std::filesystem::path& path);

// Takes the state of a run whose session and film are of the same key. UserError (BadInput).
void read_checkpoint(const std::filesystem::path& path, Session& session, Film& film);

// Where a run leaves its checkpoint: NAME.checkpoint, or NAME.2-of-7.checkpoint.
std::filesystem::path checkpoint_path(const std::filesystem::path& folder, const std::string& name,
                                      const Shard& shard);

// Of all in the folder with this key, the one whose next frame is the last that is not after `first`. None: there is none.
// UserError (BadInput) where the run's `own` is there and of another key, or damaged.
struct FoundCheckpoint {
  std::filesystem::path path;
  CheckpointHead head;
};
std::optional<FoundCheckpoint> find_checkpoint(const std::filesystem::path& own, const std::string& key,
                                               long first);

} // namespace rend
