// One page to read: HTML that holds all it needs, as text.
//
// Reports (study, check, diff, batch) are put together from these blocks. Each is a function from text to Html,
// and what is Html is whole and escaped already: text gets in by escaped() and the like alone, so that no name
// of a preset can break a page. A page asks for nothing from elsewhere (style and pictures are inside), reads
// well on light and on dark screens and on paper, and is the same bytes for the same content.
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

// A piece of a page, whole and escaped.
struct Html {
  std::string text;
  Html& operator+=(const Html& other) {
    text += other.text;
    return *this;
  }
  friend Html operator+(Html a, const Html& b) { return std::move(a += b); }
};

// Within a line.
Html escaped(std::string_view text);       // as printable() shows it (sim/base/printable.h)
Html escaped_lines(std::string_view text); // as printable_lines() does
Html strong(std::string_view text);
Html code(std::string_view text);                        // names, commands
Html link(std::string_view href, std::string_view text); // href: relative, or #id
std::string address_of(std::string_view path);           // of a file beside the page, as a href
Html muted(std::string_view text);

// A word on a colour; the word says it all by itself, for who prints or does not tell colours.
enum class Tone { Good, Note, Limit, Bad, Plain }; // green, blue, amber, red, grey
Html badge(Tone tone, std::string_view word);

// Blocks.
Html heading(int level, std::string_view text,
             std::string_view id = {}); // 2 to 4; the title is 1. id: for links
Html paragraph(const Html& line);
Html list(const std::vector<Html>& items);
Html preformatted(std::string_view text); // a preset, a command
enum class Details { Closed, Open };      // at first
Html details(const Html& summary, const Html& body, Details at_first = Details::Closed);

struct Column {
  std::string name;
  bool number = false; // right-aligned
};
inline Column number_column(std::string name) {
  return {.name = std::move(name), .number = true};
}
struct Cell {
  Html what;
  std::string order = {}; // what it is sorted by, a number or a word; empty: by what it shows
};
struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<Cell>> rows; // as many cells as columns (CHECK)
  bool sortable = false;               // by a click on a column's name
  std::string caption = {};
};
Html table(const Table& table);

// Names and values side by side: the machine, the preset, the figures that matter.
Html facts(const std::vector<std::pair<std::string, Html>>& all);

// Figures that matter most, large.
struct Tile {
  std::string figure, what;
  Tone tone = Tone::Plain;
};
Html tiles(const std::vector<Tile>& all);

// A picture within the page. `bytes`: a whole file. The alternative text says what is to be seen.
enum class PictureFormat { Svg, Png };
Html figure(PictureFormat format, std::string_view bytes, std::string_view alternative,
            const Html& caption = {});
// The same bytes as the address of a picture: "data:image/png;base64,...".
std::string data_address(PictureFormat format, std::string_view bytes);

// A value with as many digits as one reads: 0.0123, 1.23e-05, 42.
std::string in_digits(double value, int digits = 3);

// The whole page. `style` and `script` stand after its own: of blocks that bring some.
std::string page(std::string_view title, const Html& body, std::string_view style = {},
                 std::string_view script = {});

} // namespace rend::html
