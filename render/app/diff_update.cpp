#include "render/app/diff_update.h"

#include "render/output.h"
#include "sim/base/error.h"
#include "sim/base/wording.h"

#include <fmt/format.h>

#include <map>

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

// What would be copied where, all of it looked at before anything is written.
void check_source(const Compared& one, MemoryBudget& memory) {
  if (one.paths.b.empty())
    throw UserError(Exit::Trouble, {one.paths.a.string()},
                    fmt::format("--update: there is no {} now", one.paths.name),
                    "if it is not expected any more, remove that file yourself; nothing was updated");
  check_picture(one.paths.b, memory);
}

// Files that lie complete beside those that they are to replace; what has not taken its place goes. None is
// held open, so that there can be any number.
class Parts {
public:
  Parts() = default;
  ~Parts() {
    std::error_code error;
    for (const auto& [path, from] : from_) fs::remove(part(path), error);
  }
  Parts(const Parts&) = delete;
  Parts& operator=(const Parts&) = delete;

  void add(const fs::path& to, const fs::path& from) {
    const std::vector<std::uint8_t> bytes = file_bytes(from);
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    { const OutputFile any(to); } // whether it can be made at all
    const fs::path path = fs::weakly_canonical(to);
    const auto other = from_.find(path); // two names of one file, by a link
    if (other != from_.end() && file_bytes(other->second) != bytes)
      throw UserError(Exit::Trouble, {to.string()},
                      fmt::format("--update: this file has two names, and would become both {} and {}",
                                  in_quotes(other->second.string()), in_quotes(from.string())),
                      "name one of them; nothing was updated");
    if (!from_.emplace(path, from).second) return;
    OutputFile file(part(path));
    file.write(bytes);
    file.commit();
  }
  void commit() {
    for (; !from_.empty(); from_.erase(from_.begin())) {
      const fs::path& path = from_.begin()->first;
      std::error_code error;
      fs::rename(part(path), path, error);
      if (error) throw UserError(Exit::ReadWrite, {path.string()}, "it cannot be replaced: " + error.message());
    }
  }

private:
  static fs::path part(const fs::path& path) { return path.string() + ".update.part"; }
  std::map<fs::path, fs::path> from_; // what is replaced, without links, and what by
};

} // namespace

void update_expected(const std::vector<Compared>& results, const std::set<std::size_t>& which,
                     const fs::path& expected, MemoryBudget& memory) {
  for (const std::size_t n : which) check_source(results[n], memory);
  Parts parts;
  for (const std::size_t n : which) {
    const CasePaths& paths = results[n].paths;
    parts.add(paths.a.empty() ? expected / paths.name : paths.a, paths.b);
  }
  parts.commit();
}

} // namespace rend
