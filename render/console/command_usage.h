// The command line as data: what --help prints, for the manual and completions (render/help). Taken from the
// commands' own declarations, so that new commands and options appear by themselves.
//
// The type name of an option says what it takes: PRESET, DIR, FILE.png, PATH=VALUE, or choices separated by
// bars: mp4|webm; with a trailing ",..." several of them, separated by commas.
#pragma once

#include <string>
#include <vector>

namespace rend {

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

// The group of arguments that are required, where the command sees to it rather than the parser.
inline constexpr const char* required_by_command = "required by the command";

} // namespace rend
