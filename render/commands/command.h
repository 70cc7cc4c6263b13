// The commands of the program: one file each, and one entry in all_commands().
#pragma once

#include "render/console/command_line.h"
#include "sim/base/error.h"

#include <functional>
#include <string>
#include <vector>

namespace rend {

struct Command {
  std::string name, what;
  // Declares the command's options, and returns the function that runs it after parsing.
  std::function<Exit()> (*declare)(const CommandLine& app);
};

const std::vector<Command>& all_commands();

Command render_command();
Command run_command();
Command list_command();
Command info_command();
Command mesh_command();
Command rule_command();
Command batch_command();
Command sheet_command();
Command check_command();
Command study_command();
Command diff_command();
Command help_command();

// Parses the command line, runs a command, prints errors. Returns the program's exit code.
int run_program(int count, const char* const* arguments);

} // namespace rend
