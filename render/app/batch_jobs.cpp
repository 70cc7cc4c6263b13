#include "render/app/batch_jobs.h"

#include "render/app/override.h"
#include "sim/base/error.h"
#include "sim/base/wording.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <set>

namespace rend {
namespace {

namespace fs = std::filesystem;

struct Input {
  std::string file, name;
};

std::vector<Input> presets_in(const fs::path& folder) {
  std::vector<Input> all;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.path().extension() != ".xml") continue;
    all.push_back({entry.path().string(), fs::relative(entry.path(), folder).replace_extension().string()});
  }
  std::sort(all.begin(), all.end(), [](const Input& a, const Input& b) { return a.name < b.name; });
  if (all.empty())
    throw UserError(Exit::NoInput, {folder.string()}, "there are no presets in this folder",
                    "presets are .xml files");
  return all;
}

std::vector<Input> presets_of(const std::vector<std::string>& inputs) {
  std::vector<Input> all;
  for (const std::string& input : inputs) {
    std::error_code error;
    if (!fs::exists(input, error))
      throw UserError(Exit::NoInput, {input}, "there is no such file or folder",
                      "nothing of the batch was begun");
    if (fs::is_directory(input, error)) {
      const std::vector<Input> found = presets_in(input);
      all.insert(all.end(), found.begin(), found.end());
    } else {
      all.push_back({input, fs::path(input).stem().string()});
    }
  }
  return all;
}

// Of "body[left].tear[2].threshold=3", what tells jobs apart in a name: "threshold=3".
std::string short_words(const std::string& set) {
  const std::size_t equals = set.find('='), dot = set.rfind('.', equals);
  std::string words = set.substr(dot == std::string::npos ? 0 : dot + 1);
  for (char& c : words)
    if (!(std::isalnum(static_cast<unsigned char>(c)) || c == '=' || c == '.' || c == '-' || c == '+')) c = '_';
  return words;
}

// Every choice of one value of each sweep.
std::vector<std::vector<std::string>> crossed(const std::vector<Sweep>& sweeps) {
  std::vector<std::vector<std::string>> all{{}};
  for (const Sweep& sweep : sweeps) {
    std::vector<std::vector<std::string>> longer;
    for (const auto& one : all)
      for (const std::string& value : sweep.values) {
        longer.push_back(one);
        longer.back().push_back(sweep.path + "=" + value);
      }
    all = std::move(longer);
  }
  return all;
}

} // namespace

Sweep parse_sweep(const std::string& text) {
  const Override one = parse_override(text);
  Sweep sweep{one.path, {}};
  for (std::size_t at = 0; at <= one.value.size();) {
    const std::size_t comma = std::min(one.value.find(',', at), one.value.size());
    sweep.values.push_back(one.value.substr(at, comma - at));
    at = comma + 1;
  }
  for (const std::string& value : sweep.values)
    if (value.empty())
      throw UserError(Exit::Usage, {}, fmt::format("--sweep {}: a value is empty", in_quotes(text)),
                      "values are such as --sweep time.step=1e-3,2e-3");
  return sweep;
}

std::vector<BatchJob> batch_jobs(const std::vector<std::string>& inputs, const std::vector<Sweep>& sweeps) {
  std::vector<BatchJob> jobs;
  std::set<std::string> names;
  for (const Input& input : presets_of(inputs)) {
    for (const auto& sets : crossed(sweeps)) {
      std::string name = input.name;
      for (const std::string& set : sets) name += fmt::format("_{}", short_words(set));
      std::string own = name;
      for (int n = 2; !names.insert(own).second; ++n) own = fmt::format("{}-{}", name, n);
      jobs.push_back({own, input.file, sets});
    }
  }
  return jobs;
}

} // namespace rend
