#include "render/facts/preset_list.h"

#include "render/picture/scene_preset.h"
#include "sim/base/error.h"
#include "sim/preset/preset_reader.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <fstream>
#include <map>
#include <sstream>

namespace rend {
namespace {

namespace fs = std::filesystem;

struct Measured {
  long steps = 0;
  double seconds = 0;
};

// Of "preset,steps,measured,seconds"; lines that are otherwise are passed over.
std::map<std::string, Measured> times_of(const fs::path& file) {
  std::map<std::string, Measured> out;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    std::istringstream parts(line);
    std::string name, steps, measured, seconds;
    std::getline(parts, name, ',');
    std::getline(parts, steps, ',');
    std::getline(parts, measured, ',');
    std::getline(parts, seconds);
    Measured one;
    if (std::from_chars(steps.data(), steps.data() + steps.size(), one.steps).ec != std::errc() ||
        std::from_chars(seconds.data(), seconds.data() + seconds.size(), one.seconds).ec != std::errc())
      continue;
    out[name] = one;
  }
  return out;
}

std::vector<fs::path> files_below(const fs::path& folder) {
  std::vector<fs::path> out;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, error), end;
  for (; !error && at != end; at.increment(error))
    if (std::error_code none; at->path().extension() == ".xml" && at->is_regular_file(none))
      out.push_back(at->path());
  if (error)
    throw UserError(Exit::ReadWrite, {folder.string()}, "the folder cannot be read: " + error.message());
  std::sort(out.begin(), out.end());
  return out;
}

bool ends_a_sentence(const std::string& text, std::size_t at) {
  if (text[at] != '.' || (at + 1 < text.size() && text[at + 1] != ' ')) return false;
  const std::size_t blank = text.rfind(' ', at);
  std::string word = text.substr(blank == std::string::npos ? 0 : blank + 1,
                                 at - (blank == std::string::npos ? 0 : blank + 1));
  while (!word.empty() && word.front() == '(') word.erase(0, 1);
  return word != "fig" && word != "figs" && word != "al" && word != "e.g";
}

} // namespace

std::string first_sentence(const std::string& xml) {
  const std::size_t begin = xml.find("<!--"), end = xml.find("-->", begin);
  if (begin == std::string::npos || end == std::string::npos) return {};
  std::string text;
  for (std::size_t n = begin + 4; n < end; ++n) {
    const bool blank = std::isspace(static_cast<unsigned char>(xml[n])) != 0;
    if (!blank)
      text += xml[n];
    else if (!text.empty() && text.back() != ' ')
      text += ' ';
  }
  for (std::size_t n = 0; n < text.size(); ++n)
    if (ends_a_sentence(text, n)) return text.substr(0, n);
  return text.substr(0, text.find_last_not_of(' ') + 1);
}

fs::path folder_of_presets() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  for (const fs::path& folder :
       {fs::path("presets"), program.parent_path().parent_path() / "share/rend/presets"})
    if (fs::is_directory(folder, error)) return folder;
  throw UserError(Exit::NoInput, {}, "there is no folder of presets here",
                  "name one: rend list FOLDER; rend comes with the folder presets");
}

std::vector<ListedPreset> list_presets(const fs::path& folder) {
  std::error_code error;
  if (fs::is_regular_file(folder, error))
    throw UserError(Exit::NoInput, {folder.string()}, "this is a file, and rend list takes a folder",
                    "rend info tells what one preset builds");
  if (!fs::is_directory(folder, error))
    throw UserError(Exit::NoInput, {folder.string()}, "there is no such folder");
  const std::map<std::string, Measured> times = times_of(folder / "times.csv");
  std::vector<ListedPreset> out;
  for (const fs::path& path : files_below(folder)) {
    ListedPreset one;
    one.file = fs::relative(path, folder).generic_string();
    try {
      const std::string text = read_preset_file(path);
      const auto preset = load_scene_text(text, path.string(), {});
      one.about = first_sentence(text);
      if (preset->has("thesis")) one.thesis = preset->text("thesis");
    } catch (const UserError&) { // a file of rules, or not well formed: rend run says why
      continue;
    }
    if (const auto found = times.find(one.file); found != times.end()) {
      one.seconds = found->second.seconds;
      one.steps = found->second.steps;
    }
    out.push_back(std::move(one));
  }
  return out;
}

} // namespace rend
