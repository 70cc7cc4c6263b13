#include "render/batch/batch_jobs.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"
#include "sim/base/wording.h"
#include "sim/preset/override.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <string_view>

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
    // Kept under its name in the folder: the target of a symbolic link may lie anywhere.
    all.push_back(
        {entry.path().string(), entry.path().lexically_relative(folder).replace_extension().string()});
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
                      "no job was started; correct the name");
    if (fs::is_directory(input, error)) {
      const std::vector<Input> found = presets_in(input);
      all.insert(all.end(), found.begin(), found.end());
    } else {
      all.push_back({input, fs::path(input).stem().string()});
    }
  }
  return all;
}

// Different texts give different hashes.
std::string short_hash(const std::string& text) {
  return fmt::format("{:08x}", hash_bytes(text.data(), text.size()) & 0xffffffffU);
}

// Makes "body[left].tear.threshold=3 4" of "body[left].tear.threshold=3,4". The whole path is kept: its last
// word is also that of other attributes, and a shorter path would make the name depend on what else is swept.
// No value contains a comma, so a comma can stand for a blank; where other characters are replaced, a hash
// keeps names distinct.
std::string words_of(const std::string& set) {
  std::string words = set;
  bool replaced = false;
  for (char& c : words) {
    if (std::isalnum(static_cast<unsigned char>(c)) || std::string_view("=.-+[]_").find(c) != std::string::npos)
      continue;
    replaced = replaced || c != ' ';
    c = c == ' ' ? ',' : '_';
  }
  return replaced ? words + "-" + short_hash(set) : words;
}

constexpr std::size_t longest = 160; // [bytes], of a folder's name: file systems allow 255

// Never cuts within a UTF-8 character.
std::string cut(const std::string& name) {
  if (name.size() <= longest) return name;
  std::size_t end = longest - 9;
  while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xc0U) == 0x80U) --end;
  return name.substr(0, end) + "-" + short_hash(name);
}

// A folder below the batch's, whose name is not that of its page: index.html, index.2-of-7.html.
std::string folder_of(const std::string& name) {
  fs::path folder;
  for (const fs::path& part : fs::path(name)) {
    std::string own = cut(part.string());
    const bool is_page =
        folder.empty() && own.starts_with("index.") && (own.ends_with(".html") || own.ends_with(".html.part"));
    if (is_page || own == "." || own == "..") own += "_";
    folder /= own;
  }
  return folder.string();
}

// The Cartesian product: every choice of one value of each sweep.
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

namespace {

// The values of 1:10:2 (1, 3, 5, 7, 9) or 1:4 (in steps of 1): from, to and step; nullopt: it is no range. Each
// is from + n step, in the fewest digits that give it back.
std::optional<std::vector<std::string>> parse_range(const std::string& value, const std::string& text,
                                                    std::string_view option) {
  std::array<double, 3> part{0, 0, 1};
  std::size_t count = 0;
  for (std::size_t at = 0; at <= value.size(); ++count) {
    const std::size_t colon = std::min(value.find(':', at), value.size());
    const auto [end, error] = count < 3 ? std::from_chars(value.data() + at, value.data() + colon, part[count])
                                        : std::from_chars_result{value.data(), std::errc::invalid_argument};
    if (error != std::errc() || end != value.data() + colon) return {};
    at = colon + 1;
  }
  if (count < 2) return {};
  const auto [from, to, step] = part;
  constexpr double most = 10'000; // values
  const double steps = std::floor((to - from) / step * (1 + 1e-12) + 1e-9);
  if (!(steps >= 0) || steps >= most || step == 0)
    throw UserError(Exit::Usage, {},
                    fmt::format("{} {}: {} is no range of values", option, in_quotes(text), in_quotes(value)),
                    "a range is FROM:TO or FROM:TO:STEP, such as 1:10:2, with 10000 values at most");
  std::vector<std::string> out;
  for (double n = 0; n <= steps; ++n) out.push_back(fmt::format("{:.12g}", from + n * step));
  return out;
}

} // namespace

Sweep parse_sweep(const std::string& text, std::string_view option) {
  if (text.find('=') == std::string::npos)
    throw UserError(Exit::Usage, {fmt::format("{} {}", option, text)}, "there is no '=' in it",
                    fmt::format("write {0} PATH=V,V,..., such as {0} time.step=1e-3,2e-3", option));
  const Override one = parse_override(text);
  Sweep sweep{one.path, {}};
  for (std::size_t at = 0; at <= one.value.size();) {
    const std::size_t comma = std::min(one.value.find(',', at), one.value.size());
    const std::string value = one.value.substr(at, comma - at);
    if (const auto range = parse_range(value, text, option))
      sweep.values.insert(sweep.values.end(), range->begin(), range->end());
    else
      sweep.values.push_back(value);
    at = comma + 1;
  }
  for (const std::string& value : sweep.values)
    if (value.empty())
      throw UserError(Exit::Usage, {}, fmt::format("{} {}: a value is empty", option, in_quotes(text)),
                      "values are such as time.step=1e-3,2e-3");
  return sweep;
}

BatchSettings batch_settings(const ElementType& root, const std::vector<std::string>& sets,
                             const std::vector<std::string>& sweeps) {
  BatchSettings out;
  for (const std::string& text : sets) {
    const Override one = parse_override(text);
    const AttributeKind kind = overridden(root, one).kind;
    const bool is_text = kind == AttributeKind::Text || (kind == AttributeKind::NumberOrExpression &&
                                                         one.value.find('(') != std::string::npos);
    if (!is_text && one.value.find_first_of(",:") != std::string::npos)
      out.sweeps.push_back(parse_sweep(text));
    else
      out.sets.push_back(text);
  }
  for (const std::string& text : sweeps) out.sweeps.push_back(parse_sweep(text, "--sweep"));
  for (const std::string& text : out.sets) check_override(root, parse_override(text));
  for (const Sweep& sweep : out.sweeps)
    for (const std::string& value : sweep.values) check_override(root, {sweep.path, value});
  return out;
}

std::vector<BatchJob> batch_jobs(const std::vector<std::string>& inputs, const std::vector<Sweep>& sweeps) {
  std::vector<BatchJob> jobs;
  std::set<std::string> names;
  for (const Input& input : presets_of(inputs)) {
    for (const auto& sets : crossed(sweeps)) {
      std::string name = input.name;
      for (const std::string& set : sets) name += fmt::format("_{}", words_of(set));
      std::string own = folder_of(name);
      for (int n = 2; !names.insert(own).second; ++n) own = folder_of(fmt::format("{}-{}", name, n));
      jobs.push_back({own, input.file, sets});
    }
  }
  return jobs;
}

} // namespace rend
