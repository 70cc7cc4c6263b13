#include "render/compare/update.h"

#include "render/files/output.h"
#include "render/files/temporaries.h"
#include "sim/base/error.h"
#include "sim/base/wording.h"

#include <fmt/format.h>

#include <map>
#include <utility>

namespace rend {

namespace fs = std::filesystem;

std::set<std::size_t> named_cases(const std::vector<std::string>& names, const std::vector<CasePaths>& cases) {
  std::set<std::size_t> out;
  for (const std::string& name : names) {
    const std::string folder = name.ends_with('/') ? name : name + "/";
    const std::size_t before = out.size();
    bool found = false;
    for (std::size_t n = 0; n < cases.size(); ++n) {
      const std::string& one = cases[n].name;
      if (one != name && one != name + ".png" && !one.starts_with(folder)) continue;
      out.insert(n);
      found = true;
    }
    if (found || out.size() > before) continue;
    std::vector<std::string> all;
    for (const CasePaths& one : cases) all.push_back(one.name);
    const std::string near = nearest(name, all);
    throw UserError(Exit::Usage, {},
                    "--update: no picture is called " + in_quotes(name) + ", and no folder of them",
                    near.empty() ? "name one as it is reported" : "did you mean " + in_quotes(near) + "?");
  }
  return out;
}

namespace {

// Checks the source of one copy; all are checked before anything is written.
void check_source(const CaseResult& one, MemoryBudget& memory) {
  if (one.paths.b.empty())
    throw UserError(Exit::DiffError, {one.paths.a.string()},
                    fmt::format("--update: there is no {} now", one.paths.name),
                    "if it is not expected any more, remove that file yourself; nothing was updated");
  check_picture(one.paths.b, memory);
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
  // Allocates no memory, so that even when none is left all files are replaced or none.
  void commit() {
    for (; !all_.empty(); all_.erase(all_.begin())) {
      const fs::path& path = all_.begin()->first;
      std::error_code error;
      fs::rename(all_.begin()->second.part, path, error);
      if (error) throw UserError(Exit::ReadWrite, {path.string()}, "it cannot be replaced: " + error.message());
    }
    for (const fs::path& folder : folders_) sync_folder(folder);
  }

private:
  struct Part {
    Part(fs::path from_, fs::path part_) : from(std::move(from_)), part(std::move(part_)) {}
    fs::path from, part;
    TemporaryPath temporary{part.c_str()};
  };
  std::map<fs::path, Part> all_; // by the path that is replaced, with links resolved
  std::set<fs::path> folders_;   // the folders of these files
};

} // namespace

void update_expected(const std::vector<CaseResult>& results, const std::set<std::size_t>& which,
                     const fs::path& expected, MemoryBudget& memory) {
  for (const std::size_t n : which) check_source(results[n], memory);
  PendingCopies parts;
  for (const std::size_t n : which) {
    const CasePaths& paths = results[n].paths;
    parts.add(paths.a.empty() ? expected / paths.name : paths.a, paths.b);
  }
  parts.commit();
}

} // namespace rend
