#include "render/help/tear_table.h"

#include "render/help/folding.h"
#include "sim/fracture/pairs.h"

#include <gtest/gtest.h>
#include <sstream>

namespace rend::tear_table_test {
namespace {

// The words of a page, without the lines that fold them.
std::string words_of(const std::string& page) {
  std::istringstream in(page);
  std::string all, word;
  while (in >> word) all += word + ' ';
  return all;
}

TEST(TearTable, names_every_criterion_and_every_change_within_a_hundred_columns) {
  const std::string page = tear_table(false), words = words_of(page);
  for (const NamedCriterion& criterion : named_criteria()) {
    const std::size_t first = words.find(criterion.name());
    EXPECT_NE(first, std::string::npos) << criterion.name();
    EXPECT_NE(words.find(criterion.name(), first + 1), std::string::npos)
        << criterion.name(); // sheets and solids
  }
  for (const ChangeType& change : all_changes()) EXPECT_NE(words.find(change.name), std::string::npos);
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) EXPECT_LE(width(line), 100u) << line;
}

TEST(TearTable, says_why_a_pair_is_refused) {
  std::string refusal;
  for (const Pair& pair : all_pairs(3))
    if (!pair.refusal.empty()) refusal = pair.refusal;
  ASSERT_FALSE(refusal.empty());
  // The reason stands right of the criteria that it is about: word by word, names lie between.
  const std::string words = words_of(tear_table(false));
  std::size_t at = words.find("refused: it ");
  ASSERT_NE(at, std::string::npos);
  std::istringstream in(refusal);
  for (std::string word; in >> word;) {
    at = words.find(word, at);
    ASSERT_NE(at, std::string::npos) << word;
  }
}

TEST(TearTable, differs_in_colour_by_codes_alone) {
  EXPECT_EQ(tear_table(false).find('\033'), std::string::npos);
  EXPECT_NE(tear_table(true).find('\033'), std::string::npos);
}

} // namespace
} // namespace rend::tear_table_test
