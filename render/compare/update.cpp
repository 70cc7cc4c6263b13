#include "render/compare/update.h"

#include "render/files/output.h"
#include "render/files/temporaries.h"
#include "sim/base/error.h"
#include "sim/base/wording.h"

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

// Whether the current picture can take the place of the expected one.
bool is_well(const CaseResult& one, MemoryBudget& memory) {
  try {
    check_picture(one.paths.b, memory);
    return true;
  } catch (const UserError&) { // reported as the state of this case
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

// Temporary copies beside the files that they will replace; removed if not committed. Their descriptors are
// closed, so that there can be any number.
class PendingCopies {
public:
  PendingCopies() = default;
  ~PendingCopies() {
    std::error_code error;
    for (const auto& [path, one] : all_) fs::remove(one.part, error);
  }
  PendingCopies(const PendingCopies&) = delete;
  PendingCopies& operator=(const PendingCopies&) = delete;

  void add(const fs::path& to, const fs::path& from) {
    const std::vector<std::uint8_t> bytes = file_bytes(from);
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    const fs::path path = fs::weakly_canonical(resolve_link(to));
    { const OutputFile any(path); }     // tests whether it can be created
    const auto other = all_.find(path); // two names of one file, through a link
    if (other != all_.end() && file_bytes(other->second.from) != bytes)
      throw UserError(Exit::DiffError, {to.string()},
                      fmt::format("--update: this file has two names, and would become both {} and {}",
                                  in_quotes(other->second.from.string()), in_quotes(from.string())),
                      "name one of them; nothing was updated");
    const auto [entry, is_new] = all_.try_emplace(path, from, path.string() + ".update.part");
    if (!is_new) return;
    folders_.insert(path.parent_path());
    OutputFile file(entry->second.part);
    file.write(bytes);
    file.commit();
  }
  void remove(const fs::path& path) {
    removed_.push_back(path);
    folders_.insert(fs::weakly_canonical(path).parent_path());
  }
  // Allocates no memory, so that even when none is left all files are replaced or none.
  void commit() {
    for (; !all_.empty(); all_.erase(all_.begin())) {
      const fs::path& path = all_.begin()->first;
      std::error_code error;
      fs::rename(all_.begin()->second.part, path, error);
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
  std::map<fs::path, Part> all_;  // by the path that is replaced, with links resolved
  std::vector<fs::path> removed_; // expected pictures that are missing now
  std::set<fs::path> folders_;    // the folders of these files
};

} // namespace

std::set<std::size_t> updatable(const std::vector<CaseResult>& results, const std::set<std::size_t>& which,
                                MemoryBudget& memory) {
  std::set<std::size_t> out;
  if (!which.empty()) check_that_some_are_there(results);
  for (const std::size_t n : which)
    if (results[n].state != CaseState::Match && (results[n].paths.b.empty() || is_well(results[n], memory)))
      out.insert(n);
  return out;
}

void update_expected(const std::vector<CaseResult>& results, const std::set<std::size_t>& which,
                     const fs::path& expected) {
  PendingCopies parts;
  for (const std::size_t n : which) {
    const CasePaths& paths = results[n].paths;
    if (paths.b.empty())
      parts.remove(paths.a);
    else
      parts.add(paths.a.empty() ? expected / paths.name : paths.a, paths.b);
  }
  parts.commit();
}

} // namespace rend
