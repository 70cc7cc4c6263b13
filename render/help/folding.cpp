#include "render/help/folding.h"

#include <algorithm>

namespace rend {
namespace {

void fold_line(std::string_view text, std::size_t columns, const std::string& indent,
               std::vector<std::string>& lines) {
  lines.emplace_back();
  bool started = false; // the last line holds a word
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    if (started && width(lines.back()) + 1 + width(word) > columns) {
      lines.push_back(indent);
      started = false;
    }
    if (started) lines.back() += ' ';
    lines.back() += word;
    started = true;
  }
}

} // namespace

std::size_t width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::vector<std::string> folded(std::string_view text, std::size_t columns) {
  std::vector<std::string> lines;
  for (bool first = true; first || !text.empty(); first = false) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    fold_line(text.substr(0, end), columns, first ? "" : "  ", lines);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string on_one_line(std::string_view text) {
  std::string out;
  for (const char c : text)
    if (c == '\n')
      out += "; ";
    else
      out += c;
  return out;
}

std::string fitted(std::string_view page, std::size_t columns) {
  std::string out;
  while (!page.empty()) {
    const std::size_t end = std::min(page.find('\n'), page.size());
    const std::string_view line = page.substr(0, end);
    page.remove_prefix(std::min(end + 1, page.size()));
    if (width(line) <= columns) {
      out += std::string(line) + '\n';
      continue;
    }
    const std::size_t blanks = std::min(line.find_first_not_of(' '), line.size());
    const std::string indent(std::min(blanks, columns / 3), ' ');
    std::string before = indent;
    for (const std::string& part : folded(line.substr(blanks), columns - indent.size() - 2)) {
      out += before + part + '\n';
      before = indent + "  ";
    }
  }
  return out;
}

} // namespace rend
