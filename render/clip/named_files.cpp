#include "render/clip/named_files.h"

#include "sim/base/error.h"
#include "sim/base/wording.h"
#include "sim/preset/paths.h"

#include <fmt/format.h>

#include <charconv>
#include <sys/stat.h>
#include <unistd.h>

namespace rend {
namespace {

namespace fs = std::filesystem;

// Resolves all links; of a path that does not exist, the part that does.
fs::path without_links(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  const fs::path out = fs::weakly_canonical(whole, error);
  return error ? whole.lexically_normal() : out;
}

// Resolves the links of its folder alone: a rename replaces a link, not its target.
fs::path name_of(const fs::path& path) {
  std::error_code error;
  const fs::path whole = fs::absolute(path, error);
  return without_links(whole.parent_path()) / whole.filename();
}

// Whether writing to `written` replaces `name`: the file itself, or one of its temporary names.
bool is_written_over(const fs::path& name, const fs::path& written) {
  if (name == written) return true;
  const std::string file = name.filename().string();
  return name.parent_path() == written.parent_path() && file.ends_with(".part") &&
         file.starts_with(written.filename().string() + ".");
}

[[noreturn]] void refuse(const std::string& what) {
  throw UserError(Exit::Usage, {}, what, "choose another name for what is written");
}

} // namespace

NamedFiles::NamedFiles() {
  for (const auto& [stream, what] :
       {std::pair{STDOUT_FILENO, "standard output"}, {STDERR_FILENO, "standard error"}}) {
    struct stat there {};
    std::error_code error;
    if (::fstat(stream, &there) != 0 || !S_ISREG(there.st_mode)) continue;
    const fs::path name = fs::read_symlink(fmt::format("/proc/self/fd/{}", stream), error);
    if (!error) outputs_.push_back({what, name, name, [name](const fs::path& other) { return other == name; }});
  }
}

void NamedFiles::reads(const std::string& what, const fs::path& path) {
  const Input input{what, path, name_of(path), without_links(path)};
  for (const Output& output : outputs_)
    if (output.over(input.name) || output.over(input.place))
      refuse(fmt::format("{} {} would be overwritten by {}", what, in_quotes(path.string()), output.what));
  inputs_.push_back(input);
}

void NamedFiles::reads_files(const PresetNode& scene) {
  for (const FileOfPreset& file : files_of(scene))
    reads(file.node->name() == "rules" ? "the file of rules" : "the " + file.noun(), file.path());
}

void NamedFiles::add(Output output) {
  for (const Input& input : inputs_)
    if (output.over(input.name) || output.over(input.place))
      refuse(fmt::format("{} {} would be overwritten by {}", input.what, in_quotes(input.given.string()),
                         output.what));
  for (const Output& other : outputs_) {
    const bool by_this = !other.name.empty() && output.over(other.name);
    const bool by_other = !output.name.empty() && other.over(output.name);
    if (by_this || by_other)
      refuse(fmt::format("{} and {} would both be written to {}", other.what, output.what,
                         in_quotes((by_other ? output.given : other.given).string())));
  }
  outputs_.push_back(std::move(output));
}

void NamedFiles::writes(const std::string& what, const fs::path& path) {
  const fs::path name = name_of(path);
  add({what, path, name, [name](const fs::path& other) { return is_written_over(other, name); }});
}

void NamedFiles::writes_frames(const std::string& what, const fs::path& folder, const std::string& extension,
                               const std::function<bool(long)>& has) {
  const fs::path place = without_links(folder);
  add({what, {}, {}, [place, extension, has](const fs::path& other) {
         const std::string file = other.filename().string();
         long number = -1;
         std::from_chars(file.data(), file.data() + file.size(), number);
         return other.parent_path() == place && number >= 0 &&
                file == fmt::format("{:05d}{}", number, extension) && has(number);
       }});
}

} // namespace rend
