#include "render/report/picture_viewer.h"

#include "render/report/picture_viewer_style.h"

#include <fmt/format.h>

namespace rend::html {

const std::string_view compare_style = comparison_style, compare_script = comparison_script;

namespace {

// Pictures narrower than this are enlarged without interpolation.
constexpr int small = 480;

std::string image(const char* role, std::string_view bytes, const std::string& what) {
  if (bytes.empty()) return {};
  return fmt::format("<img class=\"{}\" alt=\"{}\" src=\"{}\"/>\n", role, escaped(what).text,
                     data_address(PictureFormat::Png, bytes));
}

std::string pictures(const ComparisonView& all) {
  return image("a", all.a, "expected: " + all.name) + image("b", all.b, "now: " + all.name) +
         image("heat", all.heat, "where they differ: " + all.name);
}

std::string ways(bool heat) {
  std::string out = "<div class=\"bar\"><span class=\"ways\" role=\"group\" aria-label=\"how to look\">";
  for (const auto& [way, word] : {std::pair{"slider", "slider"},
                                  {"blink", "blink"},
                                  {"expected", "expected"},
                                  {"now", "now"},
                                  {"difference", "difference"},
                                  {"heat", "heat map"},
                                  {"side", "side by side"}})
    if (heat || std::string_view(way) != "heat")
      out += fmt::format("<button type=\"button\" data-way=\"{}\">{}</button>", way, word);
  return out + "</span><span class=\"said\" role=\"status\"></span></div>\n";
}

std::string zooms(bool heat) {
  std::string out = "<div class=\"near\"><div class=\"zooms\">";
  for (const auto& [of, word] : {std::pair{"a", "expected"}, {"b", "now"}, {"heat", "heat map"}})
    if (heat || std::string_view(of) != "heat")
      out += fmt::format("<figure><canvas width=\"448\" height=\"448\" data-of=\"{}\"></canvas>"
                         "<figcaption>{}</figcaption></figure>",
                         of, word);
  return out +
         "</div>\n<p class=\"muted\">32 × 32 pixels from (<span class=\"place\"></span>); a click into the "
         "picture shows another place. <button type=\"button\" class=\"worst\">the worst "
         "place</button></p></div>\n";
}

} // namespace

Html compare(const ComparisonView& all) {
  const bool alone = all.a.empty() || all.b.empty();
  const char* size = all.width < small ? " small" : "";
  if (alone || !all.same_size)
    return {fmt::format("<div class=\"compare\" data-way=\"side\"><div class=\"stack{}\">\n{}</div></div>\n",
                        size, pictures(all))};
  return {
      fmt::format("<div class=\"compare\" data-way=\"side\" data-width=\"{}\" data-height=\"{}\" data-x=\"{}\" "
                  "data-y=\"{}\">\n{}<div class=\"look\"><div><div class=\"stack{}\">\n{}<span "
                  "class=\"edge\"></span><span class=\"mark\"></span></div>\n<input type=\"range\" min=\"0\" "
                  "max=\"100\" step=\"0.25\" value=\"50\" aria-label=\"where the two pictures "
                  "meet\"/></div>\n{}</div></div>\n",
                  all.width, all.height, all.x, all.y, ways(!all.heat.empty()), size, pictures(all),
                  zooms(!all.heat.empty()))};
}

} // namespace rend::html
