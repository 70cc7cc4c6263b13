#include "render/help/manual.h"

#include "render/help/help.h"
#include "render/help/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <utility>

namespace rend {
namespace {

// Escapes text for troff: a dot or quote at the start of a line would be a request, a minus must stay ASCII,
// and a line end is to be seen.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if ((out.empty() || out.back() == '\n') && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\n')
      out += "\n.br\n";
    else if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
  }
  return out;
}
std::string strong(std::string_view text) {
  return fmt::format("\\fB{}\\fR", plain(text));
}
std::string slanted(std::string_view text) {
  return fmt::format("\\fI{}\\fR", plain(text));
}
std::string section(std::string_view title) {
  return fmt::format(".SH {}\n", title);
}
std::string item(const std::string& label, const std::string& text) {
  return fmt::format(".TP\n{}\n{}\n", label, text);
}

std::string head(const std::string& name, int number, const std::string& what, const std::string& version,
                 const std::string& date) {
  return fmt::format(".TH {0} {1} \"{2}\" \"{0} {3}\"\n.nh\n.ad l\n", name, number, date, version) +
         section("NAME") + fmt::format("{} \\- {}\n", plain(name), plain(what));
}

std::string as_sentence(std::string text) {
  if (!text.empty() && std::string_view(".!?").find(text.back()) == std::string_view::npos) text += '.';
  return plain(text);
}

std::string option_item(const OptionUsage& option) {
  std::string label;
  for (const std::string& name : option.names)
    label += fmt::format("{}{}", label.empty() ? "" : ", ", strong(name));
  if (!option.value.empty()) label += fmt::format(" {}", slanted(option.value));
  std::string text = as_sentence(option.what);
  if (!option.fallback.empty()) text += fmt::format(" Default: {}.", strong(option.fallback));
  if (option.required) text += " Required.";
  return item(label, text);
}

std::string manual_synopsis(const CommandUsage& command, const std::string& name) {
  std::string out = fmt::format("{} [{}]", strong(name), slanted("options"));
  for (const OptionUsage& option : command.positionals)
    out +=
        fmt::format(" {}{}{}", option.required ? "" : "[", slanted(option.value), option.required ? "" : "]");
  return out;
}

bool is_help(const OptionUsage& option) {
  return option.names.back() == "--help";
}

// A command, or one of its subcommands.
std::string command_section(const CommandUsage& command, const std::string& name) {
  std::string out;
  for (const CommandUsage& part : command.commands) out += command_section(part, name + " " + part.name);
  if (!command.commands.empty()) return out;
  out += fmt::format(".SS {}\n", manual_synopsis(command, name));
  std::string what = command.what;
  what.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(what.front())));
  out += as_sentence(what) + "\n";
  for (const OptionUsage& option : command.positionals)
    out += item(slanted(option.value), as_sentence(option.what));
  for (const OptionUsage& option : command.options)
    if (!is_help(option)) out += option_item(option);
  if (!command.footer.empty()) out += fmt::format(".PP\n{}\n", as_sentence(command.footer));
  return out;
}

std::string exit_codes() {
  const std::pair<Exit, const char*> all[]{
      {Exit::Done, "Done."},
      {Exit::CheckFailed,
       "The answer is no: pictures differ, an answer of the preset does not hold, a job or a check failed."},
      {Exit::DiffError, "Of rend diff: something cannot be compared."},
      {Exit::Usage, "The command line is wrong."},
      {Exit::BadInput, "A preset, mesh or picture is wrong."},
      {Exit::NoInput, "There is no such file."},
      {Exit::Bug, "A fault of rend itself."},
      {Exit::CannotCreate, "The output cannot be created."},
      {Exit::ReadWrite, "Reading or writing failed, such as on a full disk."},
      {Exit::OutOfBudget, "There is not enough memory, or a thread could not be started."},
      {Exit::Unstable, "The simulation became unstable and was stopped."},
      {Exit{128 + SIGHUP}, "Its terminal has gone (SIGHUP)."},
      {Exit::Interrupted, "Interrupted (SIGINT)."},
      {Exit::Terminated, "Terminated (SIGTERM)."},
      {Exit{128 + SIGXCPU}, "Its limit of processor time was reached (SIGXCPU)."}};
  std::string out = section("EXIT STATUS");
  for (const auto& [code, what] : all) out += item(strong(std::to_string(static_cast<int>(code))), what);
  return out;
}

std::string value_of(const AttributeType& attribute) {
  const std::string out = plain(expected(attribute));
  if (attribute.required) return out + "; required";
  if (!attribute.fallback) return out + "; optional";
  return fmt::format("{}; default {}", out,
                     attribute.fallback->empty() ? "empty" : strong(*attribute.fallback));
}

std::string element_section(const TableEntry& entry) {
  std::string out;
  for (const TablePlace& place : entry.places) out += fmt::format(".SS {}\n", plain(place.path));
  std::string children;
  for (const ChildType& child : entry.type->children)
    children += fmt::format("{}{}", children.empty() ? "" : ", ", strong(child.type->name));
  out += as_sentence(entry.type->what) + "\n";
  if (!children.empty()) out += fmt::format("Holds {}.\n", children);
  for (const AttributeType& attribute : entry.type->attributes)
    out += item(strong(attribute.name), fmt::format("{}\n.br\n{}", plain(attribute.what), value_of(attribute)));
  return out;
}

} // namespace

std::string manual(const CommandUsage& program, const std::string& version, const std::string& date) {
  const std::string what = program.what.substr(program.what.find(": ") + 2); // "rend: pictures of ..."
  std::string out = head(program.name, 1, what, version, date) + section("SYNOPSIS");
  std::string commands;
  for (const CommandUsage& command : program.commands) {
    out +=
        fmt::format("{}{} ...\n", commands.empty() ? "" : ".br\n", strong(program.name + " " + command.name));
    commands += command_section(command, program.name + " " + command.name);
  }
  out += section("DESCRIPTION") +
         "A preset, a scene in XML, becomes image sequences, videos and figures of deformable bodies that tear "
         "and break. No display is needed. The same preset gives the same bytes, on any number of threads.\n"
         ".PP\n" +
         as_sentence(program.footer) + "\n" + section("OPTIONS");
  for (const OptionUsage& option : program.options) out += option_item(option);
  out += section("COMMANDS") + commands + exit_codes() + section("ENVIRONMENT") +
         item(strong("NO_COLOR"), "Set to anything: no colours on a terminal.") +
         item(strong("REND_SIMD"), "Which vector unit computes: sse2 or avx2; without it, the wider. "
                                   "The results are the same.") +
         section("SEE ALSO") + ".BR rend\\-preset (5),\n.BR gnuplot (1),\n.BR ffmpeg (1)\n";
  return out;
}

std::string manual_of_presets(const ElementType& root, const std::string& version, const std::string& date) {
  std::string out = head("rend-preset", 5, "scenes for rend", version, date) + section("DESCRIPTION") +
                    plain(introduction(root)) + "\n" + section("ELEMENTS");
  for (const TableEntry& entry : table_entries(root)) out += element_section(entry);
  return out + section("SEE ALSO") + ".BR rend (1),\n.BR xmllint (1)\n";
}

} // namespace rend
