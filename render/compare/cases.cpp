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

// Collects the pictures of one side, by their paths within its folder.
class Walk {
public:
  Walk(const fs::path& folder, fs::path CasePaths::*side, Cases& cases, Found& found)
      : side_(side), cases_(cases), found_(found) {
    into(folder, "");
  }

private:
  void into(const fs::path& folder, const std::string& prefix) { // "tear/"
    std::error_code error;
    const fs::path real = fs::canonical(folder, error);
    if (std::find(above_.begin(), above_.end(), real) != above_.end())
      throw UserError(Exit::DiffError, {folder.string()},
                      "this link leads back to a folder that contains it, " + in_quotes(real.string()),
                      "links to other folders are followed; remove this one");
    above_.push_back(real);
    cases_.folders.push_back(real);
    fs::directory_iterator entry(folder, error), end;
    for (; !error && entry != end; entry.increment(error)) put(*entry, prefix);
    if (error)
      throw UserError(Exit::DiffError, {folder.string()}, "the folder cannot be read: " + error.message());
    above_.pop_back();
  }

  void put(const fs::directory_entry& entry, const std::string& prefix) {
    const std::string name = prefix + entry.path().filename().string();
    std::error_code gone; // a dangling link counts as a picture that cannot be read
    if (entry.is_directory(gone)) return into(entry.path(), name + "/");
    if (!is_png(entry.path())) {
      ++cases_.left_out;
      return;
    }
    CasePaths& one = found_[name];
    one.name = name;
    one.*side_ = entry.path();
  }

  fs::path CasePaths::*side_;
  Cases& cases_;
  Found& found_;
  std::vector<fs::path> above_; // canonical paths of the current folder and those that contain it
};

bool is_folder(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) throw UserError(Exit::NoInput, {path.string()}, "there is no such file or folder");
  return fs::is_directory(status);
}

} // namespace

Cases cases_of(const fs::path& a, const fs::path& b) {
  const bool folder = is_folder(a);
  if (folder != is_folder(b)) {
    const fs::path &of = folder ? a : b, &file = folder ? b : a;
    throw UserError(Exit::DiffError, {}, "a folder cannot be compared with a file",
                    "name the picture in the folder: " + in_quotes((of / file.filename()).string()));
  }
  Cases cases;
  if (!folder) {
    cases.all.push_back({a.filename().string(), a, b});
    return cases;
  }
  Found found;
  Walk(a, &CasePaths::a, cases, found);
  Walk(b, &CasePaths::b, cases, found);
  for (auto& [name, one] : found) cases.all.push_back(std::move(one));
  if (cases.all.empty())
    throw UserError(Exit::DiffError, {}, "neither folder has a picture",
                    "pictures are files whose names end in .png, in the folders or below");
  return cases;
}

} // namespace rend
