#include "render/pages/provenance.h"

#include "sim/base/hash.h"

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <ctime>
#include <fstream>
#include <iterator>
#include <vector>

namespace rend {
namespace {

// The command line from /proc; the program's name without its folder.
std::vector<std::string> command_words() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  if (!words.empty()) words.front() = std::filesystem::path(words.front()).filename().string();
  return words;
}

} // namespace

std::string quoted_for_shell(const std::vector<std::string>& words) {
  constexpr const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./,:@%";
  std::string out;
  for (const std::string& word : words) {
    if (!out.empty()) out += ' ';
    if (!word.empty() && word.find_first_not_of(plain) == std::string::npos) {
      out += word;
      continue;
    }
    out += '\'';
    for (char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
    out += '\'';
  }
  return out;
}

Provenance provenance_of(const std::filesystem::path& preset, const std::string& text) {
  Provenance p = provenance_of_build();
  p.preset = preset.string();
  p.hash = fmt::format("{:016x}", hash_bytes(text.data(), text.size()));
  return p;
}

Provenance provenance_of_build() {
  Provenance p;
  p.machine = this_machine();
  p.command = quoted_for_shell(command_words());
  p.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  return p;
}

nlohmann::ordered_json json_of(const Provenance& p) {
  const Machine& m = p.machine;
  return {{"rend", m.version},      {"commit", m.commit},   {"compiler", m.compiler},  {"flags", m.flags},
          {"machine", m.processor}, {"system", m.system},   {"processors", m.threads}, {"preset", p.preset},
          {"preset_hash", p.hash},  {"command", p.command}, {"date", p.date}};
}

html::Html facts_of(const Provenance& p) {
  using namespace html;
  std::vector<std::pair<std::string, Html>> all{{"command", code(p.command)}};
  if (!p.preset.empty()) all.push_back({"preset", escaped(fmt::format("{}, XXH3 {}", p.preset, p.hash))});
  for (const auto& [name, value] : described(p.machine)) all.push_back({name, escaped(value)});
  all.push_back({"date", escaped(p.date)});
  return facts(all);
}

} // namespace rend
