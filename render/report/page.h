// A self-contained HTML page, as text.
//
// Reports (study, check, diff, batch) are composed of these blocks. Each is a function from text to Html. An
// Html value is well-formed and escaped: text enters only through escaped() and the like, so that no name in a
// preset can break a page. A page loads nothing from elsewhere (style and pictures are embedded), supports
// light and dark screens and printing, and has the same bytes for the same content.
//
//   using namespace html;   // in a function
//   Html body = paragraph(escaped("What was found.")) + heading(2, "Cases") + table(t);
//   const std::string file = page("rend check", body);
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rend::html {

// A fragment of a page, well-formed and escaped.
struct Html {
  std::string text;
  Html& operator+=(const Html& other) {
    text += other.text;
    return *this;
  }
  friend Html operator+(Html a, const Html& b) { return std::move(a += b); }
};

// Inline elements.
Html escaped(std::string_view text);       // as printable() shows it (sim/base/printable.h)
Html escaped_lines(std::string_view text); // as printable_lines() does
Html strong(std::string_view text);
Html code(std::string_view text);                        // names, commands
Html link(std::string_view href, std::string_view text); // href: relative, or #id
std::string address_of(std::string_view path);           // href of a file, relative to the page
Html muted(std::string_view text);

// A coloured badge; its word is sufficient by itself, for print and colour-blind readers.
enum class Tone { Good, Note, Limit, Bad, Plain }; // green, blue, amber, red, grey
Html badge(Tone tone, std::string_view word);

// Block elements.
Html heading(int level, std::string_view text,
             std::string_view id = {}); // 2 to 4; the title is 1. id: an anchor
Html paragraph(const Html& line);
Html list(const std::vector<Html>& items);
Html preformatted(std::string_view text); // a preset, a command
enum class Details { Closed, Open };      // at first
Html details(const Html& summary, const Html& body, Details at_first = Details::Closed);

struct TableColumn {
  std::string name;
  bool number = false; // right-aligned
};
inline TableColumn number_column(std::string name) {
  return {.name = std::move(name), .number = true};
}
struct TableCell {
  Html what;
  std::string order = {}; // sort key, a number or a word; empty: the shown text
};
struct Table {
  std::vector<TableColumn> columns;
  std::vector<std::vector<TableCell>> rows; // as many cells as columns (CHECK)
  bool sortable = false;                    // by clicking on a column's name
  std::string caption = {};
};
Html table(const Table& table);

// A two-column list of names and values: the machine, the preset, main figures.
Html facts(const std::vector<std::pair<std::string, Html>>& all);

// A main figure, in large type.
struct Tile {
  std::string figure, what;
  Tone tone = Tone::Plain;
};
Html tiles(const std::vector<Tile>& all);

// An embedded picture. `bytes`: a whole file. The alternative text describes it.
enum class PictureFormat { Svg, Png };
Html figure(PictureFormat format, std::string_view bytes, std::string_view alternative,
            const Html& caption = {});
// A data URL of the same bytes: "data:image/png;base64,...".
std::string data_address(PictureFormat format, std::string_view bytes);

// A number with few significant digits: 0.0123, 1.23e-05, 42.
std::string in_digits(double value, int digits = 3);

// The whole page. `style` and `script` are appended to its own, for blocks that need some.
std::string page(std::string_view title, const Html& body, std::string_view style = {},
                 std::string_view script = {});

} // namespace rend::html
