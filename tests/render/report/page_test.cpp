#include "render/report/page.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace rend::html {
namespace {

namespace fs = std::filesystem;

Html all_blocks() {
  Table t{{{"case"}, {"seconds", true}}, {}, true, "times & places"};
  t.rows.push_back({{code("a<b")}, {escaped("0.10"), "0.1"}});
  t.rows.push_back({{badge(Tone::Good, "ok")}, {escaped("2"), "2"}});
  Html body = tiles({{"12", "cases ok", Tone::Good}, {"1", "failed", Tone::Bad}});
  body +=
      heading(2, "Cases <of> all", "cases") + paragraph(strong("So ") + link("#cases", "it") + muted(" is."));
  body += table(t) + facts({{"machine", escaped("x & y")}}) + list({escaped("one"), escaped("two")});
  body += details(escaped("more"), preformatted("<scene name=\"x\"/>\n"), Details::Open);
  body += figure(PictureFormat::Svg, R"(<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>)",
                 "a \"plot\"");
  return body;
}

TEST(Page, IsWellFormedAsXmlAndAsHtml) {
  const fs::path file =
      fs::temp_directory_path() / ("rend-page-" + std::to_string(std::random_device()()) + ".html");
  std::ofstream(file, std::ios::binary) << page("rend & \"all\"", all_blocks());
  EXPECT_EQ(std::system(("xmllint --noout '" + file.string() + "'").c_str()), 0);
  // libxml2 knows only HTML 4, and complains about <main>, <figure>, <details>: any other complaint is an error
  const std::string html =
      "xmllint --html --noout '" + file.string() + "' 2>&1 | grep ' error : ' | grep -v 'Tag .* invalid'";
  EXPECT_NE(std::system(html.c_str()), 0) << "xmllint found more";
  fs::remove(file);
}

TEST(Page, HoldsAllItNeeds) {
  const std::string text = page("t", all_blocks());
  for (const char* away : {"src=\"http", "href=\"http", "@import", "url(", "<link"})
    EXPECT_EQ(text.find(away), std::string::npos) << away;
  EXPECT_EQ(text, page("t", all_blocks()));
}

TEST(Page, EscapesWhatIsMarkup) {
  EXPECT_EQ(escaped("<a href=\"x\">&'").text, "&lt;a href=&quot;x&quot;&gt;&amp;&#39;");
  EXPECT_EQ(link("a\"b", "<").text, "<a href=\"a&quot;b\">&lt;</a>");
}

TEST(Page, ShowsAsEscapesWhatIsNoCharacterOrActs) {
  EXPECT_EQ(escaped("ν = ½ → 𝄞").text, "ν = ½ → 𝄞");
  EXPECT_EQ(escaped("a\n\tb").text, R"(a\n\tb)");
  EXPECT_EQ(escaped_lines("a\n\tb\033<").text, "a\n\tb\\x1b&lt;");
  EXPECT_EQ(preformatted("a\nb\n").text, "<pre>a\nb\n</pre>\n");
  EXPECT_EQ(escaped(std::string("a\0\033b", 4)).text, R"(a\x00\x1bb)");
  EXPECT_EQ(escaped("\xff\xc0\xaf").text, R"(\xff\xc0\xaf)"); // invalid UTF-8, and an overlong '/'
  EXPECT_EQ(escaped("\u009b\u202e\uffff").text, R"(\u{9b}\u{202e}\u{ffff})"); // U+FFFF is not allowed in XML
}

TEST(Page, WritesAddressesOfFilesOfAnyName) {
  EXPECT_EQ(address_of("a/b-1_2.~x.png"), "a/b-1_2.~x.png");
  EXPECT_EQ(address_of("javascript:x"), "javascript%3Ax");
  EXPECT_EQ(address_of("a b?c#d%20\n\u00e9"), "a%20b%3Fc%23d%2520%0A%C3%A9");
}

// RFC 4648, section 10.
TEST(Page, WritesPicturesInBase64) {
  for (const auto& [bytes, digits] : std::vector<std::pair<std::string, std::string>>{{"", "\""},
                                                                                      {"f", "Zg==\""},
                                                                                      {"fo", "Zm8=\""},
                                                                                      {"foo", "Zm9v\""},
                                                                                      {"foobar", "Zm9vYmFy\""},
                                                                                      {"\xfb\xff", "+/8=\""}})
    EXPECT_NE(figure(PictureFormat::Png, bytes, "x").text.find("base64," + digits), std::string::npos) << bytes;
}

TEST(Page, ShortensNumbers) {
  EXPECT_EQ(in_digits(0.0123456), "0.0123");
  EXPECT_EQ(in_digits(1.0 / 0.0), "infinite");
  EXPECT_EQ(in_digits(42), "42");
}

} // namespace
} // namespace rend::html
