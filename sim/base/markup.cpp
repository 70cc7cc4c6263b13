#include "sim/base/markup.h"

namespace rend {

std::string in_markup(std::string_view text, MarkupQuotes quotes) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else if (c == '\'' && quotes == MarkupQuotes::Both)
      out += "&#39;";
    else
      out += c;
  }
  return out;
}

} // namespace rend
