#include "render/app/provenance.h"

#include "sim/base/error.h"
#include "sim/base/hash.h"

#include <commit.h> // written by commit.cmake

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <ctime>
#include <fstream>
#include <iterator>
#include <sys/utsname.h>
#include <thread>
#include <vector>

namespace rend {
namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string kernel() {
  utsname name{};
  if (::uname(&name) != 0) return "unknown";
  return fmt::format("{} {} {}", name.sysname, name.release, name.machine);
}

// The command line as the system keeps it; the program's own name without its folder.
std::vector<std::string> command_words() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::vector<std::string> words;
  for (std::string word; std::getline(file, word, '\0');) words.push_back(word);
  if (!words.empty()) words.front() = std::filesystem::path(words.front()).filename().string();
  return words;
}

std::string hash_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file) throw UserError(Exit::ReadWrite, {path.string()}, "the preset cannot be read any more");
  return fmt::format("{:016x}", hash_bytes(bytes.data(), bytes.size()));
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

Provenance provenance_of(const std::filesystem::path& preset) {
  Provenance p;
  p.version = REND_VERSION;
  p.commit = REND_COMMIT;
  p.compiler = REND_COMPILER;
  p.flags = REND_FLAGS;
  p.machine = processor();
  p.system = kernel();
  p.processors = static_cast<int>(std::thread::hardware_concurrency());
  p.preset = preset.string();
  p.hash = hash_of(preset);
  p.command = quoted_for_shell(command_words());
  p.date = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  return p;
}

nlohmann::ordered_json json_of(const Provenance& p) {
  return {{"rend", p.version},          {"commit", p.commit},   {"compiler", p.compiler},
          {"flags", p.flags},           {"machine", p.machine}, {"system", p.system},
          {"processors", p.processors}, {"preset", p.preset},   {"preset_hash", p.hash},
          {"command", p.command},       {"date", p.date}};
}

} // namespace rend
