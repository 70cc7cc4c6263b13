// Checkpoint: the state of a run in a file, from which --resume continues. It holds the scene between two
// steps, what pictures remember of earlier frames (scales, colours, curves), and the number of the next frame.
//
//   rend checkpoint, a line of text             so that `head -1` tells what it is
//   key, next frame                             64 bits each
//   the numbers of the scene and its pictures   sim/base/archive.h
//   XXH3 of all that, piece after piece         64 bits
//
// It lies in the folder of the pictures while a run is in progress, is written atomically (temporary file and
// rename), and is removed when the run is complete. All frames before the next one are in that folder when it
// is written.
//
// The file is untrusted input: the key can be copied, and the checksum recomputed. Only regular files are
// opened, and not through links; every value is validated before it is used (Scene::store), and reading takes
// no more memory than the scene does, whatever sizes the file claims. After a checkpoint has been refused the
// session is in an unspecified state: discard it, and do not try another checkpoint with it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace rend {

class FrameOutput;
class Session;
struct Shard;

// The header of a checkpoint.
struct CheckpointHeader {
  std::uint64_t key = 0; // checkpoint_key()
  long next = 0;         // frame
};

// A hash of everything that a picture's bytes depend on, except its number: Session::key(), its size in pixels
// and samples, and whether the HUD that it asks for can be drawn. 16 hex digits. It is stored in the PNG files,
// so other builds of the same version produce the same bytes.
std::string picture_key(const Session& session, int width, int height, int samples);
// The same for a checkpoint, which only this very program file can read: the commit alone does not distinguish
// two builds of a modified working tree.
std::string checkpoint_key(const std::string& picture_key);

void write_checkpoint(const std::filesystem::path& path, const std::string& key, long next, Session& session,
                      FrameOutput& output); // UserError (CannotCreate, ReadWrite)

// None: no such file. UserError (BadInput): not a regular file, not a checkpoint, or of another key;
// (ReadWrite): it cannot be read.
std::optional<CheckpointHeader> read_checkpoint_header(const std::filesystem::path& path,
                                                       const std::string& key);

// Restores the state into a session and output of the same key, and returns the header from the same read: by
// now another process may have replaced the file of another shard. None, and nothing was restored: the file is
// gone, or now has another key or a next frame after `first`. UserError (BadInput): not a regular file, not a
// checkpoint, damaged, or a state that no run of this session can reach; (ReadWrite): it cannot be read. After
// an error session and output are unusable.
std::optional<CheckpointHeader> read_checkpoint(const std::filesystem::path& path, const std::string& key,
                                                long first, Session& session, FrameOutput& output);

// The path of a run's checkpoint: NAME.checkpoint, or NAME.2-of-7.checkpoint.
std::filesystem::path checkpoint_path(const std::filesystem::path& folder, const std::string& name,
                                      const Shard& shard);

// Checkpoints to resume from, the best first, all with this key and a next frame not after `first`: the run's
// own, which alone records the frames that it wrote early (frame_output.h); then those of other shards of the
// same clip and of the unsharded clip, the latest first. Other files are ignored. Throws as
// read_checkpoint_header() for the run's own; others with errors are skipped.
struct FoundCheckpoint {
  std::filesystem::path path;
  CheckpointHeader head;
};
std::vector<FoundCheckpoint> find_checkpoints(const std::filesystem::path& folder, const std::string& name,
                                              const Shard& shard, const std::string& key, long first);

} // namespace rend
