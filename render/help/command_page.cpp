#include "render/help/command_page.h"

#include "render/help/folding.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace rend {
namespace {

constexpr std::size_t label_columns = 24; // of a page that is wide enough for two columns
constexpr std::size_t least_columns = 64; // below, what an option does stands under its name

struct Item {
  std::string label, what;
};

// A long list of choices, cut after its bars: mp4|webm|
std::vector<std::string> label_lines(const std::string& label, std::size_t columns) {
  std::vector<std::string> lines(1);
  std::string part;
  const auto put = [&] {
    if (!lines.back().empty() && width(lines.back()) + width(part) > columns) lines.emplace_back("    ");
    lines.back() += part;
    part.clear();
  };
  for (const char c : label) {
    part += c;
    if (c == '|' || c == ' ') put();
  }
  put();
  return lines;
}

void print(const std::vector<Item>& items, std::size_t columns, std::string& out) {
  std::size_t longest = 0;
  for (const Item& item : items) longest = std::max(longest, width(item.label));
  const bool beside = columns >= least_columns;
  const std::size_t indent = beside ? 2 + std::min(longest, label_columns) + 2 : 6;
  for (const Item& item : items) {
    const std::vector<std::string> labels = label_lines(item.label, columns - 2);
    const bool same_line = beside && labels.size() == 1 && width(item.label) + 4 <= indent;
    for (const std::string& line : labels) out += "  " + line + (same_line ? "" : "\n");
    std::string before =
        same_line ? std::string(indent - 2 - width(item.label), ' ') : std::string(indent, ' ');
    for (const std::string& line : folded(item.what, columns - indent)) {
      out += before + line + '\n';
      before.assign(indent, ' ');
    }
  }
}

std::string label_of(const OptionUsage& option) {
  std::string out;
  for (const std::string& name : option.names) out += (out.empty() ? "" : ", ") + name;
  return out + (option.value.empty() ? "" : " " + option.value);
}

Item item_of(const OptionUsage& option, bool positional) {
  Item item{positional ? option.value : label_of(option), option.what};
  if (!option.fallback.empty()) item.what += "; default: " + option.fallback;
  if (option.required && !positional) item.what += " (required)";
  return item;
}

// In the line of usage a list of choices would be too long: TOPIC stands for it.
std::string placeholder(const OptionUsage& option) {
  if (option.value.find('|') == std::string::npos) return option.value;
  std::string name = option.names.front();
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return name;
}

std::string synopsis(const CommandUsage& command, const std::string& name) {
  std::string out = "Usage: " + name;
  if (!command.commands.empty()) return out + " COMMAND [options]";
  out += " [options]";
  for (const OptionUsage& option : command.positionals)
    out += option.required ? " " + placeholder(option) : " [" + placeholder(option) + "]";
  return out;
}

void print_folded(const std::string& text, std::size_t columns, std::string& out) {
  for (const std::string& line : folded(text, columns)) out += line + '\n';
}

std::vector<Item> commands_of(const CommandUsage& command) {
  std::vector<Item> items;
  for (const CommandUsage& part : command.commands) items.push_back({part.name, part.what});
  return items;
}

} // namespace

std::string command_page(const CommandUsage& command, const std::string& name, std::size_t columns) {
  std::string out;
  const bool whole = command.what.starts_with(name + ": "); // that of the program names it
  print_folded(whole ? command.what : fmt::format("{}: {}", name, command.what), columns, out);
  out += '\n';
  print_folded(synopsis(command, name), columns, out);
  const auto section = [&](const char* title, const std::vector<Item>& items) {
    if (items.empty()) return;
    out += fmt::format("\n{}:\n", title);
    print(items, columns, out);
  };
  std::vector<Item> arguments, options;
  for (const OptionUsage& option : command.positionals) arguments.push_back(item_of(option, true));
  for (const OptionUsage& option : command.options) options.push_back(item_of(option, false));
  section("Commands", commands_of(command));
  section("Arguments", arguments);
  section("Options", options);
  if (!command.footer.empty()) {
    out += '\n';
    print_folded(command.footer, columns, out);
  }
  return out;
}

std::string short_help(const CommandUsage& program, std::size_t columns) {
  std::string out;
  print_folded(program.what, columns, out);
  out += "\n";
  print(commands_of(program), columns, out);
  out += "\n";
  print_folded("rend render PRESET --video mp4 makes a clip; rend list shows the presets; rend COMMAND --help "
               "explains a command, rend help preset what a preset may hold.",
               columns, out);
  return out;
}

} // namespace rend
