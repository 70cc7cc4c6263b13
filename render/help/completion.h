// What a shell offers when Tab is pressed: scripts made from the command line's own declarations and the
// parameter table.
//
// Adding a shell: a file with a function `Shell my_shell()`, and its name in all_shells().
#pragma once

#include "render/help/usage.h"

#include <string>
#include <vector>

namespace rend {

// What the words after an option or at a place may be.
struct Offer {
  enum class Kind { Nothing, Words, List, Files, Folders, Attributes, Elements };
  Kind kind = Kind::Nothing;
  std::vector<std::string> words = {}; // Words; List: any of them, with commas
  std::string extension = {};          // Files: "xml"; empty: any. Folders are offered beside them.
};
Offer offer_of(const OptionUsage& option, const CommandUsage& program);

struct CompletionSource {
  CommandUsage program;
  std::vector<SetUsage> sets;        // behind --set
  std::vector<std::string> elements; // second words of `rend help`
};

struct Shell {
  std::string name; // "bash"
  std::string (*script)(const CompletionSource& source);
};
const std::vector<Shell>& all_shells();
const Shell* find_shell(const std::string& name); // null: there is none
std::vector<std::string> shell_names();

std::string in_a_row(const std::vector<std::string>& words); // with blanks between them
std::string cut_short(const std::string& what);              // its first part, for a list

Shell bash_shell();
Shell zsh_shell();
Shell fish_shell();

} // namespace rend
