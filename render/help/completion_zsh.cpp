// Completion for zsh: an _arguments function for each command.
#include "render/help/completion.h"

#include <fmt/format.h>

namespace rend {
namespace {

std::string escaped(const std::string& text, const char* special) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "'\\'";
    else if (std::string(special).find(c) != std::string::npos)
      out += '\\';
    out += c;
  }
  return out;
}

std::string action(const Candidates& offer) {
  switch (offer.kind) {
  case Candidates::Kind::Nothing:
    return " ";
  case Candidates::Kind::Words:
    return fmt::format("({})", joined_by_blanks(offer.words));
  case Candidates::Kind::List:
    return fmt::format("_values -s , word {}", joined_by_blanks(offer.words));
  case Candidates::Kind::Files:
    return offer.extension.empty() ? "_files" : fmt::format("_files -g \"*.{}\"", offer.extension);
  case Candidates::Kind::Folders:
    return "_files -/";
  case Candidates::Kind::Attributes:
    return "_rend_attributes";
  case Candidates::Kind::Elements:
    return "_rend_elements";
  }
  return " ";
}

// '*'{-o,--output}'[folder]:DIR:_files -/': a star for an option that can be repeated, else the list of names
// that exclude each other.
std::string option_words(const OptionUsage& option, const CommandUsage& program) {
  std::string names;
  for (const std::string& name : option.names) {
    const char* tail = option.value.empty() ? "" : name.starts_with("--") ? "=" : "+"; // --size=1x1, -o1
    names += fmt::format("{}{}{}", names.empty() ? "" : ",", name, tail);
  }
  if (option.names.size() > 1) names = fmt::format("{{{}}}", names);
  const std::string before = option.repeated ? "*" : fmt::format("({})", joined_by_blanks(option.names));
  std::string takes;
  if (!option.value.empty())
    takes = fmt::format(":{}:{}", escaped(option.value, ":\\"),
                        escaped(action(candidates_for(option, program)), ""));
  return fmt::format("'{}'{}'[{}]{}'", before, names, escaped(first_phrase(option.what), "[]:\\"), takes);
}

std::string positional_words(const OptionUsage& option, std::size_t number, const CommandUsage& program) {
  return fmt::format("'{}:{}:{}'", option.repeated ? "*" : std::to_string(number), escaped(option.value, ":\\"),
                     escaped(action(candidates_for(option, program)), ""));
}

void add_function(const CommandUsage& command, const std::string& function, const CommandUsage& program,
                  std::string& out) {
  for (const CommandUsage& part : command.commands)
    add_function(part, fmt::format("{}_{}", function, part.name), program, out);
  out += function + "() {\n";
  if (!command.commands.empty()) out += "  local line state\n";
  out += command.commands.empty() ? "  _arguments -s" : "  _arguments -C";
  for (const OptionUsage& option : command.options)
    out += fmt::format(" \\\n    {}", option_words(option, program));
  for (std::size_t n = 0; n < command.positionals.size(); ++n)
    out += fmt::format(" \\\n    {}", positional_words(command.positionals[n], n + 1, program));
  if (!command.commands.empty()) {
    out += " \\\n    '1:command:->command' '*::argument:->argument'\n  case $state in\n  command)\n"
           "    local -a commands=(\n";
    for (const CommandUsage& part : command.commands)
      out += fmt::format("      '{}:{}'\n", part.name, escaped(part.what, ""));
    out += "    )\n    _describe command commands\n    ;;\n  argument)\n    case $line[1] in\n";
    for (const CommandUsage& part : command.commands)
      out += fmt::format("    {0}) {1}_{0} ;;\n", part.name, function);
    out += "    esac\n    ;;\n  esac";
  }
  out += "\n}\n\n";
}

std::string attributes(const std::vector<SettableAttribute>& sets) {
  std::string out = "_rend_attributes() {\n  local -a paths=(\n";
  for (const SettableAttribute& set : sets) out += fmt::format("    {}\n", set.path);
  out += "  )\n"
         "  local attribute=${${PREFIX%%=*}#scene.}\n"
         "  if ! compset -P '*='; then\n    compadd -q -S = -a paths\n    return\n  fi\n"
         "  case $attribute in\n";
  for (const SettableAttribute& set : sets)
    if (!set.values.empty())
      out += fmt::format("  {}) compadd {} ;;\n", set.path, joined_by_blanks(set.values));
  return out + "  esac\n}\n\n";
}

std::string zsh_script(const CompletionSource& source) {
  std::string out = "#compdef rend\n# Completion of rend for zsh, as `rend help completion zsh` prints it.\n\n";
  out += attributes(source.sets);
  out += fmt::format("_rend_elements() {{ compadd {} }}\n\n", joined_by_blanks(source.elements));
  add_function(source.program, "_rend", source.program, out);
  return out + "_rend \"$@\"\n";
}

} // namespace

Shell zsh_shell() {
  return {"zsh", zsh_script};
}

} // namespace rend
