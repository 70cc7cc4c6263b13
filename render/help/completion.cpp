#include "render/help/completion.h"

#include <algorithm>
#include <string_view>

namespace rend {
namespace {

std::vector<std::string> split(std::string_view text, char at) {
  std::vector<std::string> out;
  for (; text.find(at) != std::string_view::npos; text.remove_prefix(text.find(at) + 1))
    out.emplace_back(text.substr(0, text.find(at)));
  out.emplace_back(text);
  return out;
}

} // namespace

Candidates candidates_for(const OptionUsage& option, const CommandUsage& program) {
  using enum Candidates::Kind;
  std::string value = option.value;
  const bool list = value.ends_with(",...");
  if (list) value.erase(value.size() - 4);
  if (value.ends_with("...") && value.find(',') == std::string::npos) value.erase(value.size() - 3);
  if (value.find('|') != std::string::npos) {
    std::vector<std::string> words = split(value, '|');
    if (std::erase(words, "COMMAND") > 0)
      for (const CommandUsage& command : program.commands) words.push_back(command.name);
    return {list ? List : Words, words};
  }
  if (value == "PRESET") return {Files, {}, "xml"};
  if (value.starts_with("FILE.")) return {Files, {}, value.substr(5)};
  if (value == "DIR") return {Folders};
  if (value.starts_with("PATH=")) return {Attributes};
  if (value == "ELEMENT") return {Elements};
  return {value == "FILE" || !option.names.front().starts_with('-') ? Files : Nothing};
}

std::string joined_by_blanks(const std::vector<std::string>& words) {
  std::string out;
  for (const std::string& word : words) out += (out.empty() ? "" : " ") + word;
  return out;
}

std::string first_phrase(const std::string& what) {
  return what.substr(
      0, std::min({what.find(": "), what.find("; "), what.find(" ("), what.find('\n'), what.size()}));
}

const std::vector<Shell>& all_shells() {
  static const std::vector<Shell> shells{bash_shell(), zsh_shell(), fish_shell()};
  return shells;
}

const Shell* find_shell(const std::string& name) {
  const auto found = std::find_if(all_shells().begin(), all_shells().end(),
                                  [&](const Shell& one) { return one.name == name; });
  return found == all_shells().end() ? nullptr : &*found;
}

std::vector<std::string> shell_names() {
  std::vector<std::string> out;
  for (const Shell& shell : all_shells()) out.push_back(shell.name);
  return out;
}

} // namespace rend
