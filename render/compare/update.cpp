#include "render/compare/update.h"

#include "render/files/input_file.h"
#include "render/files/output.h"
#include "render/files/temporaries.h"
#include "sim/base/error.h"
#include "sim/base/wording.h"
#include "sim/preset/paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <fnmatch.h>
#include <map>
#include <utility>

namespace rend {

namespace fs = std::filesystem;

std::set<std::size_t> named_cases(const std::vector<std::string>& names, const std::vector<CasePaths>& cases) {
  std::set<std::size_t> out;
  for (const std::string& name : names) {
    const std::string folder = name.ends_with('/') ? name : name + "/";
    bool found = false;
    for (std::size_t n = 0; n < cases.size(); ++n) {
      const std::string& one = cases[n].name;
      const bool fits = fnmatch(name.c_str(), one.c_str(), 0) == 0;
      if (!fits && one != name && one != name + ".png" && !one.starts_with(folder)) continue;
      out.insert(n);
      found = true;
    }
    if (found) continue;
    std::vector<std::string> all;
    for (const CasePaths& one : cases) all.push_back(one.name);
    const std::string near = nearest(name, all);
    throw UserError(Exit::Usage, {},
                    "--update: no picture is called " + in_quotes(name) + ", and no folder of them",
                    near.empty() ? "name one as it is reported, or a pattern such as 'tear/*'"
                                 : "did you mean " + in_quotes(near) + "?");
  }
  return out;
}

namespace {

bool is_picture(const fs::path& path, MemoryBudget& memory) {
  try {
    check_picture(path, memory);
    return true;
  } catch (const UserError&) {
    return false;
  }
}

// A render that failed altogether must not empty what is expected.
void check_that_some_are_there(const std::vector<CaseResult>& results) {
  const auto is_there = [](const CaseResult& one) { return !one.paths.b.empty(); };
  if (std::any_of(results.begin(), results.end(), is_there)) return;
  throw UserError(Exit::DiffError, {}, "--update would remove every expected picture, for not one is there now",
                  "check the folder NOW; to remove them all, delete the folder of expected pictures yourself");
}

// The real folder of the expected pictures.
fs::path root_of(const fs::path& expected) {
  std::error_code error;
  const bool folder = fs::is_directory(expected, error);
  return fs::weakly_canonical(folder ? expected : fs::absolute(expected).parent_path());
}

// What an update will do: temporary copies beside the files that they will replace, and files to remove.
// Without commit() nothing changes. All that it writes or removes lies below one real folder; a name that is a
// link is replaced or removed itself, never what it leads to. The descriptors of the copies are closed, so that
// there can be any number.
class PendingChanges {
public:
  explicit PendingChanges(fs::path root) : root_(std::move(root)) {}
  ~PendingChanges() {
    std::error_code error;
    for (const auto& [path, one] : copies_) fs::remove(one.part, error);
    if (!done_)
      for (auto folder = made_.rbegin(); folder != made_.rend(); ++folder) fs::remove(*folder, error);
  }
  PendingChanges(const PendingChanges&) = delete;
  PendingChanges& operator=(const PendingChanges&) = delete;

  // Where the file of an expected picture really is: only links to folders are followed. Throws UserError
  // (DiffError) where one leads out of the folder of expected pictures.
  fs::path place_of(const fs::path& expected) const {
    const fs::path folder = fs::weakly_canonical(fs::absolute(expected).parent_path());
    if (!lies_in(folder, root_))
      throw UserError(
          Exit::DiffError, {expected.string()},
          fmt::format("--update: a link leads from the expected pictures to {}, where nothing is changed; "
                      "nothing was updated",
                      in_quotes(folder.string())),
          "leave these pictures out, or compare and update that folder by itself");
    return folder / expected.filename();
  }

  void copy(const fs::path& expected, const fs::path& from) {
    const std::vector<std::uint8_t> bytes = file_bytes(from);
    make_folder(place_of(expected).parent_path());
    const fs::path path = place_of(expected);
    { const OutputFile any(path); }        // tests whether it can be created
    const auto other = copies_.find(path); // two names of one file, through a link to its folder
    if (other != copies_.end() && file_bytes(other->second.from) != bytes)
      throw UserError(Exit::DiffError, {expected.string()},
                      fmt::format("--update: this file has two names, and would become both {} and {}",
                                  in_quotes(other->second.from.string()), in_quotes(from.string())),
                      "name one of them; nothing was updated");
    const auto [entry, is_new] = copies_.try_emplace(path, from, path.string() + ".update.part");
    if (!is_new) return;
    folders_.insert(path.parent_path());
    OutputFile file(entry->second.part);
    file.write(bytes);
    file.commit();
  }
  void remove(const fs::path& expected) {
    removed_.insert(place_of(expected));
    folders_.insert(place_of(expected).parent_path());
  }
  // Allocates no memory, so that even when none is left all files are replaced or none.
  void commit() {
    done_ = true;
    for (; !copies_.empty(); copies_.erase(copies_.begin())) {
      const fs::path& path = copies_.begin()->first;
      std::error_code error;
      fs::rename(copies_.begin()->second.part, path, error);
      if (error) throw UserError(Exit::ReadWrite, {path.string()}, "it cannot be replaced: " + error.message());
    }
    for (const fs::path& path : removed_) {
      std::error_code error;
      fs::remove(path, error);
      if (error) throw UserError(Exit::ReadWrite, {path.string()}, "it cannot be removed: " + error.message());
    }
    for (const fs::path& folder : folders_) sync_folder(folder);
  }

private:
  struct Part {
    Part(fs::path from_, fs::path part_) : from(std::move(from_)), part(std::move(part_)) {}
    fs::path from, part;
    TemporaryPath temporary{part.c_str()};
  };
  void make_folder(const fs::path& folder) {
    std::error_code error;
    if (fs::exists(folder, error)) return;
    make_folder(folder.parent_path());
    if (fs::create_directory(folder, error)) made_.push_back(folder);
  }

  fs::path root_;
  std::map<fs::path, Part> copies_; // by the path that is replaced
  std::set<fs::path> removed_;      // expected pictures that are missing now
  std::set<fs::path> folders_;      // the folders of these files
  std::vector<fs::path> made_;      // folders that were created, those that contain others first
  bool done_ = false;
};

} // namespace

void check_folders_of_update(const fs::path& expected, const fs::path& now) {
  std::error_code error;
  if (!fs::is_directory(expected, error)) return;
  const bool inside = lies_in(expected, now);
  if (!inside && !lies_in(now, expected)) return;
  throw UserError(Exit::Usage, {},
                  fmt::format("--update: {} lies in {}, and its pictures would be taken for those of the other",
                              in_quotes((inside ? expected : now).string()),
                              in_quotes((inside ? now : expected).string())),
                  "keep the expected pictures and those of now in two folders beside each other");
}

std::set<std::size_t> updatable(const std::vector<CaseResult>& results, const std::set<std::size_t>& which,
                                MemoryBudget& memory) {
  std::set<std::size_t> out;
  if (!which.empty()) check_that_some_are_there(results);
  for (const std::size_t n : which)
    if (const CasePaths& paths = results[n].paths;
        results[n].state != CaseState::Match && is_picture(paths.b.empty() ? paths.a : paths.b, memory))
      out.insert(n);
  return out;
}

void update_expected(const std::vector<CaseResult>& results, const std::set<std::size_t>& which,
                     const fs::path& expected) {
  PendingChanges changes(root_of(expected));
  const auto place = [&](const CasePaths& paths) { return paths.a.empty() ? expected / paths.name : paths.a; };
  for (const std::size_t n : which)
    changes.place_of(place(results[n].paths)); // refuses before folders are made
  for (const std::size_t n : which) {
    const CasePaths& paths = results[n].paths;
    if (paths.b.empty())
      changes.remove(paths.a);
    else
      changes.copy(place(paths), paths.b);
  }
  changes.commit();
}

} // namespace rend
