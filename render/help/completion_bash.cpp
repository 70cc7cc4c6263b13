// Completion for bash, without the package bash-completion.
//
// Bash splits words at = and :, which occur in rend's arguments (--set time.step=1e-3): the script joins them
// again, and offers only what follows the last =, since bash replaces only that.
#include "render/help/completion.h"

#include "sim/base/enum_words.h"

#include <fmt/format.h>

namespace rend {
namespace {

std::string coded(const Candidates& offer) {
  using enum Candidates::Kind;
  static constexpr EnumWords<Elements> kinds{"nothing", "words",      "list",    "files",
                                             "folders", "attributes", "elements"};
  const std::string kind = kinds[offer.kind];
  if (offer.kind == Words || offer.kind == List) return kind + " " + joined_by_blanks(offer.words);
  return offer.extension.empty() ? kind : kind + " " + offer.extension;
}

struct Tables {
  std::string commands, options, takes; // branches of a case statement
};

void add_command(const CommandUsage& command, const std::string& path, const CommandUsage& program,
                 Tables& tables) {
  std::vector<std::string> options, parts;
  for (const OptionUsage& option : command.options) {
    std::string patterns;
    for (const std::string& name : option.names) {
      options.push_back(name);
      patterns += fmt::format("{}'{} {}'", patterns.empty() ? "" : " | ", path, name);
    }
    if (!option.value.empty())
      tables.takes += fmt::format("  {}) takes='{}' ;;\n", patterns, coded(candidates_for(option, program)));
  }
  for (std::size_t n = 0; n < command.positionals.size(); ++n) {
    const std::string number = command.positionals[n].repeated ? "'*" : fmt::format("{}'", n + 1);
    tables.takes += fmt::format("  '{} {}) takes='{}' ;;\n", path, number,
                                coded(candidates_for(command.positionals[n], program)));
  }
  for (const CommandUsage& part : command.commands) parts.push_back(part.name);
  tables.options += fmt::format("  '{}') options='{}' commands='{}' ;;\n", path, joined_by_blanks(options),
                                joined_by_blanks(parts));
  for (const CommandUsage& part : command.commands)
    add_command(part, path.empty() ? part.name : path + " " + part.name, program, tables);
}

std::string values_of(const std::vector<SettableAttribute>& sets) {
  std::string out;
  for (const SettableAttribute& set : sets)
    if (!set.values.empty())
      out += fmt::format("  {}) values='{}' ;;\n", set.path, joined_by_blanks(set.values));
  return out;
}

constexpr const char* bash_functions = R"bash(
# _rend_plain PATH: without the brackets of body[left].tear[2]; into plain.
_rend_plain() {
  plain=${1#scene.}
  while [[ $plain =~ ^([^[]*)\[[^]]*\](.*)$ ]]; do plain=${BASH_REMATCH[1]}${BASH_REMATCH[2]}; done
}

_rend_attributes() { # WORD
  local head plain value values=''
  if [[ $1 == *=* ]]; then
    _rend_plain "${1%%=*}"
    _rend_values "$plain"
    value=${1#*=}
    COMPREPLY=($(compgen -P "${value%"${value##*,}"}" -W "$values" -- "${value##*,}"))
    [[ $COMP_WORDBREAKS == *=* ]] || COMPREPLY=("${COMPREPLY[@]/#/${1%%=*}=}")
    return
  fi
  head=${1%"${1##*.}"}
  _rend_plain "$head"
  COMPREPLY=($(compgen -S = -W "$_rend_paths" -- "$plain${1##*.}"))
  COMPREPLY=("${COMPREPLY[@]/#"$plain"/$head}")
  compopt -o nospace 2>/dev/null
}

_rend_offer() { # KIND WORDS... (one argument), WORD
  local kind=${1%% *} rest=
  [[ $1 != *' '* ]] || rest=${1#* }
  case $kind in
  words) COMPREPLY=($(compgen -W "$rest" -- "$2")) ;;
  list) COMPREPLY=($(compgen -P "${2%"${2##*,}"}" -W "$rest" -- "${2##*,}")) ;;
  elements) COMPREPLY=($(compgen -W "$_rend_elements" -- "$2")) ;;
  attributes) _rend_attributes "$2" ;;
  files)
    compopt -o filenames 2>/dev/null
    if [[ $rest ]]; then
      mapfile -t COMPREPLY < <(compgen -f -X "!*.$rest" -- "$2"; compgen -d -- "$2")
    else
      mapfile -t COMPREPLY < <(compgen -f -- "$2")
    fi
    ;;
  folders)
    compopt -o filenames 2>/dev/null
    mapfile -t COMPREPLY < <(compgen -d -- "$2")
    ;;
  esac
}

_rend() {
  local word glued= command= waiting= takes= options= commands= count=0
  local -a words=()
  COMPREPLY=()
  for word in "${COMP_WORDS[@]:1:COMP_CWORD}"; do
    if [[ $word == [=:] && ${#words[@]} -gt 0 ]]; then
      words[-1]+=$word glued=1
    elif [[ $glued ]]; then
      words[-1]+=$word glued=
    else
      words+=("$word")
    fi
  done
  local current=${words[-1]}
  for word in "${words[@]:0:${#words[@]}-1}"; do
    if [[ $waiting ]]; then
      waiting=
      continue
    fi
    case $word in
    -*=*) ;;
    -*)
      takes=
      _rend_takes "$command" "$word"
      [[ -z $takes ]] || waiting=$word
      ;;
    *)
      commands=
      _rend_options "$command"
      if [[ " $commands " == *" $word "* ]]; then
        command+=${command:+ }$word
      else
        ((++count))
      fi
      ;;
    esac
  done
  takes= commands= options=
  _rend_options "$command"
  if [[ $waiting ]]; then
    _rend_takes "$command" "$waiting"
  elif [[ $current == -*=* ]]; then
    _rend_takes "$command" "${current%%=*}"
    current=${current#*=}
  elif [[ $current == -* ]]; then
    takes="words $options"
  elif [[ $commands ]]; then
    takes="words $commands"
  else
    _rend_takes "$command" $((count + 1))
  fi
  _rend_offer "$takes" "$current"
}
complete -F _rend rend
)bash";

std::string bash_script(const CompletionSource& source) {
  Tables tables;
  add_command(source.program, "", source.program, tables);
  std::vector<std::string> paths;
  for (const SettableAttribute& set : source.sets) paths.push_back(set.path);
  return fmt::format("# Completion of rend for bash, as `rend help completion bash` prints it.\n"
                     "# shellcheck shell=bash disable=SC2207,SC2034,SC2154,SC2178\n"
                     "_rend_paths='{}'\n_rend_elements='{}'\n\n"
                     "_rend_values() {{ # PATH: what it may be, into values\n  case $1 in\n{}  esac\n}}\n\n"
                     "_rend_options() {{ # COMMAND: into options and commands\n  case $1 in\n{}  esac\n}}\n\n"
                     "_rend_takes() {{ # COMMAND, OPTION or number of the word: into takes\n"
                     "  case \"$1 $2\" in\n{}  esac\n}}\n{}",
                     joined_by_blanks(paths), joined_by_blanks(source.elements), values_of(source.sets),
                     tables.options, tables.takes, bash_functions);
}

} // namespace

Shell bash_shell() {
  return {"bash", bash_script};
}

} // namespace rend
