#include "sim/preset/preset_reader.h"

#include "sim/mesh/mesh_name.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fmt/format.h>
#include <system_error>
#include <utility>
#include <vector>

namespace rend {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view preset_version = "1";

std::vector<std::string> files_in(const fs::path& folder) {
  std::vector<std::string> out;
  std::error_code error;
  constexpr std::size_t most = 10000; // a folder may hold millions of frames
  for (fs::directory_iterator it(folder, error), end; !error && it != end && out.size() < most;
       it.increment(error))
    out.push_back(it->path().filename().string());
  std::sort(out.begin(), out.end()); // the order of a directory is unspecified
  return out;
}

std::vector<std::string> presets_in(const fs::path& folder) {
  std::vector<std::string> out;
  for (const std::string& name : files_in(folder)) {
    if (name.ends_with(".xml")) out.push_back(name);
  }
  constexpr std::size_t most = 12;
  if (out.size() > most) {
    out.resize(most);
    out.emplace_back("...");
  }
  return out;
}

[[noreturn]] void fail_as_missing(const fs::path& path) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::error_code error;
  std::string hint;
  if (!fs::is_directory(folder, error)) {
    hint = fmt::format("there is no folder {}", in_quotes(folder.string()));
  } else {
    const std::string name = path.filename().string();
    std::string near = nearest(name, files_in(folder));
    if (fs::exists(path.string() + ".xml", error)) near = name + ".xml";
    const std::vector<std::string> presets = presets_in(folder);
    if (!near.empty())
      hint = fmt::format("did you mean {}?", in_quotes((path.parent_path() / near).string()));
    else if (!presets.empty())
      hint = fmt::format("presets in {}: {}", in_quotes(folder.string()), listed(presets));
  }
  throw UserError(Exit::NoInput, {path.string(), 0, 0}, "there is no such file", hint);
}

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

void check_version(const RawElement& root) {
  const RawAttribute* version = root.find("version");
  if (!version || version->text == preset_version) return;
  throw UserError(Exit::BadInput, version->place,
                  fmt::format("the preset is of version {}, and this program reads version {}",
                              in_quotes(version->text), preset_version));
}

std::unique_ptr<PresetNode> checked(const RawElement& raw) {
  auto node = std::make_unique<PresetNode>(*raw.type, raw.place);
  for (const RawAttribute& attribute : raw.attributes)
    node->set(*attribute.type, attribute.text, attribute.place);
  for (const auto& child : raw.children) node->add(checked(*child));
  return node;
}

} // namespace

// Without asking for the size: a pipe has none.
std::string read_preset_file(const fs::path& path) {
  const Place place{path.string(), 0, 0};
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) fail_as_missing(path);
  if (status.type() == fs::file_type::directory) {
    const std::vector<std::string> presets = presets_in(path);
    throw UserError(Exit::NoInput, place, "this is a folder, and a preset is a file",
                    presets.empty() ? "" : "presets in it: " + listed(presets));
  }
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) throw UserError(Exit::NoInput, place, fmt::format("cannot be opened: {}", std::strerror(errno)));
  std::string text;
  std::vector<char> block(std::size_t{64} << 10U);
  while (const std::size_t count = std::fread(block.data(), 1, block.size(), file.get())) {
    text.append(block.data(), count);
    if (text.size() > max_preset_bytes)
      throw UserError(Exit::BadInput, place, fmt::format("has more than {} MiB", max_preset_bytes >> 20U),
                      "a preset is a short text; meshes have files of their own");
  }
  if (std::ferror(file.get()))
    throw UserError(Exit::ReadWrite, place, fmt::format("cannot be read: {}", std::strerror(errno)));
  if (is_mesh_name(path) && !text.starts_with('<'))
    throw UserError(
        Exit::BadInput, place, "this is a mesh, and a preset is a scene in XML",
        fmt::format("rend mesh info {0} tells about it; <mesh file={0}/> makes it a body of a preset",
                    in_quotes(path.string())));
  return text;
}

std::unique_ptr<PresetNode> read_preset(const fs::path& path, const ElementType& root,
                                        std::span<const Override> overrides) {
  return read_preset_text(read_preset_file(path), path.string(), root, overrides);
}

std::unique_ptr<PresetNode> read_preset_text(std::string_view text, const std::string& file,
                                             const ElementType& root, std::span<const Override> overrides) {
  const std::unique_ptr<RawElement> raw = read_raw_preset(text, file, root);
  apply_overrides(*raw, overrides);
  check_version(*raw);
  std::unique_ptr<PresetNode> node = checked(*raw);
  node->fill_defaults();
  node->check_complete();
  return node;
}

} // namespace rend
