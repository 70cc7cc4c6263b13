// A run that was stopped, in a file: the scene between two steps, what its pictures follow, and which frame is
// next.
//
//   rend checkpoint, a line of text             so that `head -1` tells what it is
//   key, next frame                             64 bits each
//   the numbers of the scene and its pictures   sim/base/archive.h
//   XXH3 of all that, piece after piece         64 bits
//
// It stands in the folder of the pictures while a run is under way, appears whole or not at all, and goes when
// the run is complete. All frames before the next one are in that folder when it is written.
//
// Nobody knows who wrote it: the key can be copied, and the sum be mended. Only regular files are opened, and
// not through links; what is read is looked at before it is used (Scene::store), and takes the memory that
// the scene does, whatever the file says of itself. What is refused leaves a session that is good for
// nothing: it is to be thrown away, and no other checkpoint tried with it.
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
  std::uint64_t key = 0; // checkpoint_key()
  long next = 0;         // frame
};

// Of all that a picture's bytes hang on but for its number: Session::key(), its size in pixels and samples, and
// whether a HUD that it should have can be drawn. 16 hex digits. It stands in the pictures, so other builds of
// a version leave the same bytes.
std::string picture_key(const Session& session, int width, int height, int samples);
// The same for a stored state, which this very program alone can read: a commit does not tell two builds of a
// changed tree apart.
std::string checkpoint_key(const std::string& picture_key);

void write_checkpoint(const std::filesystem::path& path, const std::string& key, long next, Session& session,
                      Film& film); // UserError (CannotCreate, ReadWrite)

// None: there is no such file. UserError (BadInput): it is no regular file, no checkpoint, or of another key;
// (ReadWrite): it cannot be read.
std::optional<CheckpointHead> read_checkpoint_head(const std::filesystem::path& path, const std::string& key);

// Takes the state of a run whose session and film are of the same key, and tells the head of the very bytes
// that it took: of others' checkpoints another may stand there by now. None, and nothing was taken: it is gone,
// or no longer of this key with a next frame that is not after `first`. UserError (BadInput): it is no regular
// file, no checkpoint, damaged, or holds what no run of this session can come to; (ReadWrite): it cannot be
// read. Session and film are then spoilt.
std::optional<CheckpointHead> read_checkpoint(const std::filesystem::path& path, const std::string& key,
                                              long first, Session& session, Film& film);

// Where a run leaves its checkpoint: NAME.checkpoint, or NAME.2-of-7.checkpoint.
std::filesystem::path checkpoint_path(const std::filesystem::path& folder, const std::string& name,
                                      const Shard& shard);

// Those to go on from, the best first, all with this key and a next frame that is not after `first`: the run's
// own, which alone tells what that run had let go early (film.h), then those of the same name's other shards
// and of its whole, the latest first; other files are not looked at. Throws as read_checkpoint_head() where
// the run's own is there; what is wrong with others leaves them out.
struct FoundCheckpoint {
  std::filesystem::path path;
  CheckpointHead head;
};
std::vector<FoundCheckpoint> find_checkpoints(const std::filesystem::path& folder, const std::string& name,
                                              const Shard& shard, const std::string& key, long first);

} // namespace rend
