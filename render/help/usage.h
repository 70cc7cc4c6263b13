// The command line as data: what --help prints, for the manual and completions (manual.h, completion.h). Taken
// from the commands' own declarations, so that new commands and options appear by themselves.
//
// The type name of an option says what it takes: PRESET, DIR, FILE.png, PATH=VALUE, or choices separated by
// bars: mp4|webm; with a trailing ",..." several of them, separated by commas.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace rend {

struct ElementType;

struct OptionUsage {
  std::vector<std::string> names; // "-o", "--output"; for a positional argument its name
  std::string value;              // its type name; empty: a flag
  std::string what, fallback;     // fallback: the default; empty: none
  bool required = false, repeated = false;
};

struct CommandUsage {
  std::string name; // "rend", "render"; for a subcommand "info"
  std::string what;
  std::string footer; // empty if it is its parent's
  std::vector<OptionUsage> positionals, options;
  std::vector<CommandUsage> commands;
};

CommandUsage usage_of(const CLI::App& app);

// The group of arguments that are required, where the command sees to it rather than the parser.
inline constexpr const char* required_by_command = "required by the command";

// A type name: "mp4|webm|mkv".
std::string choices(const std::vector<std::string>& names);

// An attribute that can be given to --set.
struct SettableAttribute {
  std::string path;                // "body.sheet.cells"
  std::vector<std::string> values; // of a keyword or a flag; empty: numbers or text
};

// of all elements at each of their positions; sorted
std::vector<SettableAttribute> settable_attributes(const ElementType& root);
std::vector<std::string> element_names(const ElementType& root); // as `rend help preset` takes them; sorted

} // namespace rend
