// Shell completion: scripts generated from the command line's declarations and the parameter table.
//
// To add a shell: a file with a function `Shell my_shell()`, and its name in all_shells().
#pragma once

#include "render/help/usage.h"

#include <string>
#include <vector>

namespace rend {

// What can be completed after an option or at a position.
struct Candidates {
  enum class Kind { Nothing, Words, List, Files, Folders, Attributes, Elements };
  Kind kind = Kind::Nothing;
  std::vector<std::string> words = {}; // Words: one of them; List: several, separated by commas
  std::string extension = {};          // Files: "xml"; empty: any. Folders are always offered.
};
Candidates candidates_for(const OptionUsage& option, const CommandUsage& program);

struct CompletionSource {
  CommandUsage program;
  std::vector<SettableAttribute> sets; // after --set
  std::vector<std::string> elements;   // arguments of `rend help preset`
};

struct Shell {
  std::string name; // "bash"
  std::string (*script)(const CompletionSource& source);
};
const std::vector<Shell>& all_shells();
const Shell* find_shell(const std::string& name); // null: there is none
std::vector<std::string> shell_names();

std::string joined_by_blanks(const std::vector<std::string>& words); // separated by blanks
std::string first_phrase(const std::string& what);                   // only its first part, for a list

Shell bash_shell();
Shell zsh_shell();
Shell fish_shell();

} // namespace rend
