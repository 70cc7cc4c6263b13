// The page of a whole batch that several shards share.
//
// Each shard leaves its results beside its page, as index.I-of-N.json. Whoever ends last finds those of all
// others there, and writes the page of all: no shard needs to know about the others while it runs. Two that end
// at once write the same page, atomically.
#pragma once

#include "render/clip/shard.h"
#include "render/pages/batch_page.h"

#include <filesystem>
#include <optional>

namespace rend {

// What the shards of one batch have in common: parts of other jobs or settings do not belong together.
std::string batch_key(const std::vector<BatchJob>& all, const std::vector<std::string>& settings);

// Of an earlier run into the same folder: before the shard begins.
void remove_part(const std::filesystem::path& folder, const Shard& shard);

// Writes the part of `shard` into the report's folder. Throws UserError: CannotCreate, ReadWrite.
void write_part(const BatchReport& report, const Shard& shard, const std::string& key);

// The results of all shards, in the order of `all`; nothing while one is missing, or of another batch. A job
// whose frames are shared has the sum of its parts' frames and seconds, and the state of the worst of them.
std::optional<BatchReport> whole_batch(const std::filesystem::path& folder, const std::vector<BatchJob>& all,
                                       long shards, const std::string& key);

} // namespace rend
