#include "render/help/tear_table.h"

#include "render/help/folding.h"
#include "sim/base/wording.h"
#include "sim/fracture/pairs.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

constexpr std::size_t first_width = 22, gap = 2; // columns

struct TableStyle {
  bool colour;
  std::size_t columns;
  std::string strong(const std::string& text) const { return colour ? "\033[1m" + text + "\033[0m" : text; }
};

// A row of the table: criteria with the same four answers.
struct Row {
  Cell cell;
  std::vector<std::string> criteria;
  std::vector<std::string> answers; // one per change; or one for all of them
};

std::vector<Row> rows_of(int dimension) {
  std::vector<Row> rows;
  for (const NamedCriterion& criterion : named_criteria()) {
    Row row{criterion.cell(), {criterion.name()}, {}};
    for (const ChangeType& change : all_changes()) {
      const Pair pair = pair_of(criterion, change, dimension);
      row.answers.push_back(pair.refusal.empty() ? told(*pair.transfer, dimension)
                                                 : "refused: it " + pair.refusal);
    }
    const bool alike = std::equal(row.answers.begin() + 1, row.answers.end(), row.answers.begin());
    if (alike) row.answers.resize(1);
    const auto same = std::find_if(rows.begin(), rows.end(), [&](const Row& one) {
      return one.answers == row.answers && (alike || one.cell == row.cell);
    });
    if (same == rows.end())
      rows.push_back(row);
    else
      same->criteria.push_back(criterion.name());
  }
  return rows;
}

// Texts side by side, each in its columns.
void print_side_by_side(const std::vector<std::vector<std::string>>& texts, std::size_t columns,
                        std::string& out) {
  std::size_t height = 0;
  for (const auto& text : texts) height = std::max(height, text.size());
  for (std::size_t line = 0; line < height; ++line) {
    std::string whole;
    for (std::size_t n = 0; n < texts.size(); ++n) {
      const std::string part = line < texts[n].size() ? texts[n][line] : "";
      const std::size_t room = n == 0 ? first_width : columns;
      whole += part + std::string(room + gap - std::min(room, width(part)), ' ');
    }
    whole.erase(whole.find_last_not_of(' ') + 1);
    out += whole + '\n';
  }
}

void print_head(int dimension, const TableStyle& style, std::string& out) {
  const std::string text =
      fmt::format("{}: the elements are {}s, and their borders {}s", dimension == 2 ? "Sheets" : "Solids",
                  name_of(Cell::Elements, dimension), name_of(Cell::Borders, dimension));
  for (const std::string& line : folded(text, style.columns)) out += style.strong(line) + '\n';
  out += '\n';
}

// For narrow pages: under each group of criteria a paragraph for each change.
void print_list(int dimension, const TableStyle& style, std::string& out) {
  const auto print = [&](const std::string& text, std::size_t indent) {
    for (const std::string& line : folded(text, style.columns - indent))
      out += std::string(indent, ' ') + line + '\n';
  };
  for (const Row& row : rows_of(dimension)) {
    const bool one = row.answers.size() == 1;
    print(listed(row.criteria) + (one ? "" : " (of each " + name_of(row.cell, dimension) + ")"), 0);
    for (std::size_t n = 0; n < row.answers.size(); ++n)
      print((one ? "" : all_changes()[n].name + ": ") + row.answers[n], 2);
    out += '\n';
  }
}

void print_table(int dimension, std::string& out) {
  const std::size_t changes = all_changes().size();
  const std::size_t columns = (page_columns - first_width) / changes - gap;
  std::vector<std::vector<std::string>> heads{{"criterion"}};
  for (const ChangeType& change : all_changes()) heads.push_back({change.name});
  print_side_by_side(heads, columns, out);
  for (const Row& row : rows_of(dimension)) {
    out += std::string(page_columns, '-') + '\n';
    std::vector<std::vector<std::string>> texts{row.criteria};
    const bool one = row.answers.size() == 1;
    const std::size_t room = one ? changes * (columns + gap) - gap : columns;
    if (!one) texts.front().push_back("(of each " + name_of(row.cell, dimension) + ")");
    for (const std::string& answer : row.answers) texts.push_back(folded(answer, room));
    print_side_by_side(texts, room, out);
  }
}

} // namespace

std::string tear_table(bool colour, std::size_t columns) {
  const TableStyle style{colour, columns};
  std::string out;
  const std::string opening =
      "Any criterion of <tear> goes with any change. When the criterion of a cell exceeds the threshold, the "
      "change is made at the cell that the table names. \"Pulls\" and \"is opened\" refer to the forces of "
      "single elements, which are computed for that; \"itself\" needs none of them. A word after a criterion "
      "is the kind of its springs.";
  for (const std::string& line : folded(opening, columns)) out += line + '\n';
  out += '\n';
  for (const ChangeType& change : all_changes()) {
    const std::size_t indent = columns < page_columns ? 2 : 16;
    std::string head = columns < page_columns ? change.name + "\n  " : fmt::format("{:<16}", change.name);
    for (const std::string& line : folded(change.what, columns - indent)) {
      out += head + line + '\n';
      head.assign(indent, ' ');
    }
  }
  for (int dimension : {2, 3}) {
    out += '\n';
    print_head(dimension, style, out);
    columns < page_columns ? print_list(dimension, style, out) : print_table(dimension, out);
  }
  return out;
}

} // namespace rend
