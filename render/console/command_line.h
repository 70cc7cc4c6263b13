// Options, arguments and subcommands of the program, as each command declares them.
//
// CLI11 parses them, and command_line.cpp alone includes it: what it defines in its headers takes five seconds
// to compile in each file that does. An Option and a CommandLine are handles; what they refer to belongs to the
// ProgramLine.
#pragma once

#include "render/console/command_usage.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace rend {

// Looks at the word that an option takes: returns what is wrong with it; empty: nothing.
struct WordCheck {
  std::function<std::string(std::string&)> check;
  std::string what; // stands behind the type in help; may be empty
};

class Option {
public:
  explicit Option(CLI::Option* option) : option_(option) {}

  Option type_name(const std::string& name) const;
  Option group(const std::string& name) const;
  Option required(bool value = true) const;
  Option check(const WordCheck& check) const;
  Option transform(const WordCheck& check) const; // which may rewrite the word
  Option one_of(const std::vector<std::string>& words) const;
  Option expected(int least, int most) const; // number of words; −1: any
  Option allow_extra_args(bool value) const;  // false: one word each time it is given
  Option excludes(const Option& other) const;
  Option show_default() const; // help shows the value that it has now
  Option default_word(const std::string& word) const;

private:
  CLI::Option* option_;
};

class CommandLine {
public:
  explicit CommandLine(CLI::App* app) : app_(app) {}

  // `names`: "-o,--output", or the name of an argument. `value` takes what is given: a string, strings, a
  // number or an optional number (command_line.cpp lists the types).
  template <class T> Option add_option(const std::string& names, T& value, const std::string& what) const;
  Option add_flag(const std::string& names, bool& value, const std::string& what) const;
  Option option(const std::string& name) const; // one that was added
  CommandLine add_command(const std::string& name, const std::string& what) const;
  void require_command() const;
  void on_parsed(std::function<void()> run) const;
  void footer(const std::string& text) const;

  CommandLine parent() const;
  CommandLine command(const std::string& name) const;
  CommandUsage usage() const;
  std::string page() const; // of help

private:
  CLI::App* app_;
};

// Why a command line is refused.
struct Refusal {
  enum class Kind { UnknownWords, CommandMissing, ArgumentMissing, ValueMissing, Other };
  Kind kind = Kind::Other;
  std::string what;               // CLI11's words
  std::string which;              // the command that was read, with its parents: "rend mesh info"
  CommandUsage command;           // this command
  std::vector<std::string> words; // that nothing takes
};

class ProgramLine {
public:
  // Writes a page of help of a command, called `name` with its parents. The usage has a footer, be it its
  // parent's.
  using Page = std::function<std::string(const CommandUsage& usage, const std::string& name)>;

  // `version`: what --version prints.
  ProgramLine(const std::string& name, const std::string& what, std::function<std::string()> version,
              const Page& page);
  ~ProgramLine();

  CommandLine root() const { return CommandLine(app_.get()); }
  // Returns what --help or --version print; empty: they are not given. Throws Refusal.
  std::string parse(int count, const char* const* arguments) const;

private:
  std::unique_ptr<CLI::App> app_;
};

} // namespace rend
