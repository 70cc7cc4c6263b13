#include "render/report/page.h"

#include "render/report/page_style.h"
#include "sim/base/base64.h"
#include "sim/base/check.h"
#include "sim/base/enum_words.h"
#include "sim/base/markup.h"
#include "sim/base/printable.h"

#include <fmt/format.h>

#include <cmath>

namespace rend::html {
namespace {

std::string without_markup(std::string_view text) {
  return in_markup(text, MarkupQuotes::Both);
}

std::string escaped_text(std::string_view text) {
  return without_markup(printable(text));
}

const char* name_of(Tone tone) {
  static constexpr EnumWords<Tone::Plain> words{"good", "note", "limit", "bad", "plain"};
  return words[tone];
}

} // namespace

Html escaped(std::string_view text) {
  return {escaped_text(text)};
}
Html escaped_lines(std::string_view text) {
  return {without_markup(printable_lines(text))};
}
Html strong(std::string_view text) {
  return {"<strong>" + escaped_text(text) + "</strong>"};
}
Html code(std::string_view text) {
  return {"<code>" + escaped_text(text) + "</code>"};
}
Html link(std::string_view href, std::string_view text) {
  return {"<a href=\"" + escaped_text(href) + "\">" + escaped_text(text) + "</a>"};
}
// Percent-encoding (RFC 3986): '?', '#', '%', and a ':' in the first segment have a meaning in relative
// addresses.
std::string address_of(std::string_view path) {
  std::string out;
  for (const char c : path) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') ||
                       std::string_view("-._~/").find(c) != std::string_view::npos;
    out += plain ? std::string(1, c) : fmt::format("%{:02X}", static_cast<unsigned char>(c));
  }
  return out;
}
Html muted(std::string_view text) {
  return {"<span class=\"muted\">" + escaped_text(text) + "</span>"};
}
Html badge(Tone tone, std::string_view word) {
  return {fmt::format("<span class=\"badge {}\">{}</span>", name_of(tone), escaped_text(word))};
}

Html heading(int level, std::string_view text, std::string_view id) {
  CHECK(level >= 2 && level <= 4);
  const std::string mark = id.empty() ? "" : " id=\"" + escaped_text(id) + "\"";
  return {fmt::format("<h{0}{1}>{2}</h{0}>\n", level, mark, escaped_text(text))};
}
Html paragraph(const Html& line) {
  return {"<p>" + line.text + "</p>\n"};
}
Html list(const std::vector<Html>& items) {
  std::string out = "<ul>\n";
  for (const Html& item : items) out += "<li>" + item.text + "</li>\n";
  return {out + "</ul>\n"};
}
Html preformatted(std::string_view text) {
  return {"<pre>" + escaped_lines(text).text + "</pre>\n"};
}
Html details(const Html& summary, const Html& body, Details at_first) {
  return {fmt::format("<details{}><summary>{}</summary>\n<div class=\"inner\">\n{}</div></details>\n",
                      at_first == Details::Open ? " open=\"open\"" : "", summary.text, body.text)};
}

Html table(const Table& table) {
  std::string out = "<div class=\"wide\"><table";
  if (table.sortable) out += " class=\"sortable\"";
  out += ">\n";
  if (!table.caption.empty()) out += "<caption>" + escaped_text(table.caption) + "</caption>\n";
  const auto kind = [&](std::size_t n) { return table.columns[n].number ? " class=\"number\"" : ""; };
  out += "<thead><tr>";
  for (std::size_t n = 0; n < table.columns.size(); ++n)
    out += fmt::format("<th{}>{}</th>", kind(n), escaped_text(table.columns[n].name));
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    CHECK(row.size() == table.columns.size());
    out += "<tr>";
    for (std::size_t n = 0; n < row.size(); ++n) {
      out += fmt::format("<td{}", kind(n));
      if (!row[n].order.empty()) out += " data-order=\"" + escaped_text(row[n].order) + "\"";
      out += ">" + row[n].what.text + "</td>";
    }
    out += "</tr>\n";
  }
  return {out + "</tbody></table></div>\n"};
}

Html facts(const std::vector<std::pair<std::string, Html>>& all) {
  std::string out = "<dl>\n";
  for (const auto& [name, value] : all)
    out += "<dt>" + escaped_text(name) + "</dt><dd>" + value.text + "</dd>\n";
  return {out + "</dl>\n"};
}

Html tiles(const std::vector<Tile>& all) {
  std::string out = "<div class=\"tiles\">\n";
  for (const Tile& tile : all)
    out += fmt::format("<div class=\"tile {}\"><b>{}</b><span>{}</span></div>\n", name_of(tile.tone),
                       escaped_text(tile.figure), escaped_text(tile.what));
  return {out + "</div>\n"};
}

Html figure(PictureFormat format, std::string_view bytes, std::string_view alternative, const Html& caption) {
  // Embedded as an <img>, not inline, so that ids within one plot cannot clash with those of another.
  std::string out = fmt::format("<figure><img alt=\"{}\" src=\"{}\"/>", escaped_text(alternative),
                                data_address(format, bytes));
  if (!caption.text.empty()) out += "<figcaption>" + caption.text + "</figcaption>";
  return {out + "</figure>\n"};
}

std::string data_address(PictureFormat format, std::string_view bytes) {
  static constexpr EnumWords<PictureFormat::Png> types{"svg+xml", "png"};
  return fmt::format("data:image/{};base64,{}", types[format], base64(bytes));
}

std::string in_digits(double value, int digits) {
  if (std::isnan(value)) return "not a number";
  if (std::isinf(value)) return value > 0 ? "infinite" : "-infinite";
  return fmt::format("{:.{}g}", value, digits);
}

std::string page(std::string_view title, const Html& body, std::string_view style, std::string_view script) {
  const std::string name = escaped_text(title);
  return fmt::format(R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<meta name="color-scheme" content="light dark"/>
<title>{}</title>
<style>{}{}</style>
</head>
<body>
<main>
<h1>{}</h1>
{}</main>
<script>{}{}</script>
</body>
</html>
)",
                     name, page_style, style, name, body.text, page_script, script);
}

} // namespace rend::html
