#include "sim/base/markup.h"

#include <gtest/gtest.h>

namespace rend::markup_test {
namespace {

TEST(Markup, is_taken_out_of_text) {
  EXPECT_EQ(in_markup("<a href=\"x\">&", MarkupQuotes::Double), "&lt;a href=&quot;x&quot;&gt;&amp;");
  EXPECT_EQ(in_markup("&amp;", MarkupQuotes::Double), "&amp;amp;");
}

TEST(Markup, of_single_quotes_is_taken_out_where_it_is_asked) {
  EXPECT_EQ(in_markup("Young's \"E\"", MarkupQuotes::Double), "Young's &quot;E&quot;");
  EXPECT_EQ(in_markup("Young's \"E\"", MarkupQuotes::Both), "Young&#39;s &quot;E&quot;");
}

} // namespace
} // namespace rend::markup_test
