// The command line as data: what --help prints, for those who write it down otherwise (manual.h, completion.h).
// Taken from the commands' own declarations, so that a new command or option is in all of them by itself.
//
// What an option takes is told by its type name: PRESET, DIR, FILE.png, PATH=VALUE, or choices with bars
// between them: mp4|webm; with ",..." behind them, several with commas.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rend {

struct ElementType;

struct OptionUsage {
  std::vector<std::string> names; // "-o", "--output"; of a positional its name
  std::string value;              // its type name; empty: a flag
  std::string what, fallback;     // fallback: empty where there is none
  bool required = false, repeated = false;
};

struct CommandUsage {
  std::string name; // "rend", "render"; of its parts "info"
  std::string what;
  std::string footer; // empty where it is that of the command above
  std::vector<OptionUsage> positionals, options;
  std::vector<CommandUsage> commands;
};

CommandUsage usage_of(const CLI::App& app);

// A type name: "mp4|webm|mkv".
std::string choices(const std::vector<std::string>& names);

// What can stand behind --set.
struct SetUsage {
  std::string path;                // "body.sheet.cells"
  std::vector<std::string> values; // of a word or a flag; empty: numbers or text
};

std::vector<SetUsage> set_usages(const ElementType& root); // of all elements wherever they may stand; sorted
std::vector<std::string> element_names(const ElementType& root); // as `rend help preset` takes them; sorted

} // namespace rend
