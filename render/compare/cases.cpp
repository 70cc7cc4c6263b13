#include "render/compare/cases.h"

#include "sim/base/error.h"
#include "sim/base/wording.h"

#include <algorithm>
#include <cctype>
#include <map>

namespace rend {
namespace {

namespace fs = std::filesystem;

bool is_png(const fs::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending == ".png";
}

using Found = std::map<std::string, CasePaths>;

void walk(const fs::path& folder, fs::path CasePaths::*side, Found& found, std::size_t& left_out) {
  std::error_code error;
  for (fs::recursive_directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    std::error_code gone; // a link that leads nowhere is a picture that cannot be read
    if (entry->is_directory(gone)) continue;
    if (!is_png(entry->path())) {
      ++left_out;
      continue;
    }
    const std::string name = entry->path().lexically_relative(folder).generic_string();
    CasePaths& one = found[name];
    one.name = name;
    one.*side = entry->path();
  }
  if (error) throw UserError(Exit::Trouble, {folder.string()}, "the folder cannot be read: " + error.message());
}

bool is_folder(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw UserError(Exit::Trouble, {path.string()}, "there is no such file or folder");
  return fs::is_directory(status);
}

} // namespace

Cases cases_of(const fs::path& a, const fs::path& b) {
  const bool folder = is_folder(a);
  if (folder != is_folder(b)) {
    const fs::path &of = folder ? a : b, &file = folder ? b : a;
    throw UserError(Exit::Trouble, {}, "a folder cannot be compared with a file",
                    "name the picture in the folder: " + in_quotes((of / file.filename()).string()));
  }
  Cases cases;
  if (!folder) {
    cases.all.push_back({a.filename().string(), a, b});
    return cases;
  }
  Found found;
  walk(a, &CasePaths::a, found, cases.left_out);
  walk(b, &CasePaths::b, found, cases.left_out);
  for (auto& [name, one] : found) cases.all.push_back(std::move(one));
  if (cases.all.empty())
    throw UserError(Exit::Trouble, {}, "there is no picture in either folder",
                    "pictures are files called .png, in the folders or below them");
  return cases;
}

} // namespace rend
