#include "render/app/diff_update.h"

#include "render/output.h"
#include "sim/base/error.h"
#include "sim/base/wording.h"

#include <fmt/format.h>

#include <memory>

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
void check_source(const Compared& one) {
  if (one.paths.b.empty())
    throw UserError(Exit::Trouble, {one.paths.a.string()},
                    fmt::format("--update: there is no {} now", one.paths.name),
                    "if it is not expected any more, remove that file yourself; nothing was updated");
  read_deep_png(file_bytes(one.paths.b), one.paths.b.string());
}

} // namespace

void update_expected(const std::vector<Compared>& results, const std::set<std::size_t>& which,
                     const fs::path& expected) {
  for (const std::size_t n : which) check_source(results[n]);
  std::vector<std::unique_ptr<OutputFile>> files;
  for (const std::size_t n : which) {
    const CasePaths& paths = results[n].paths;
    const fs::path to = paths.a.empty() ? expected / paths.name : paths.a;
    std::error_code error;
    fs::create_directories(to.parent_path(), error);
    files.push_back(std::make_unique<OutputFile>(to));
    files.back()->write(file_bytes(paths.b));
  }
  for (const auto& file : files) file->commit();
}

} // namespace rend
