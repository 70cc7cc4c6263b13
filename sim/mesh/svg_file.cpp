#include "sim/mesh/svg_file.h"

#include "sim/base/expat_reader.h"
#include "sim/base/wording.h"
#include "sim/mesh/svg_shapes.h"

#include <fmt/format.h>

#include <algorithm>
#include <climits>

namespace rend {
namespace {

constexpr std::string_view svg_blanks = " \t\r\n";

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(svg_blanks);
  return first == std::string_view::npos ? std::string_view()
                                         : text.substr(first, text.find_last_not_of(svg_blanks) + 1 - first);
}

// "fill: none; stroke: red": the value of a property; empty: it is not there.
std::string property_of(std::string_view style, std::string_view name) {
  while (!style.empty()) {
    const std::string_view one = style.substr(0, style.find(';'));
    style.remove_prefix(std::min(style.size(), one.size() + 1));
    const std::size_t colon = one.find(':');
    if (colon != std::string_view::npos && trimmed(one.substr(0, colon)) == name)
      return std::string(trimmed(one.substr(colon + 1, one.find('!') - colon - 1)));
  }
  return {};
}

// Reads one file.
class SvgReader : ExpatReader<SvgReader> {
  friend ExpatReader<SvgReader>;

public:
  explicit SvgReader(const MeshSource& file) : ExpatReader(nullptr), file_(file) {
    XML_SetUserData(parser_, this);
    XML_SetElementHandler(
        parser_,
        [](void* self, const char* name, const char** attributes) {
          static_cast<SvgReader*>(self)->guard([&](SvgReader& reader) { reader.open(name, attributes); });
        },
        [](void* self, const char*) {
          static_cast<SvgReader*>(self)->guard([](SvgReader& reader) { reader.close(); });
        });
    XML_SetEntityDeclHandler(parser_, [](void* self, const char*, int, const char*, int, const char*,
                                         const char*, const char*, const char*) {
      static_cast<SvgReader*>(self)->guard([](SvgReader& reader) {
        reader.fail("entities of a drawing's own are not read", "save it as plain SVG");
      });
    });
  }

  std::vector<Curve> read() {
    const std::string_view text = file_.bytes();
    if (text.size() > INT_MAX) file_.fail("the drawing is too large");
    if (is_utf16(text)) fail("this is not UTF-8 text", "save the drawing in UTF-8 (this looks like UTF-16)");
    if (!parse(text)) fail(fmt::format("this is not XML: {}", XML_ErrorString(XML_GetErrorCode(parser_))));
    return std::move(curves_);
  }

private:
  struct Level {
    Eigen::Affine2d place = Eigen::Affine2d::Identity(); // of the drawing, y up
    bool fills = true, shows = true;
    bool passed_over = false;
  };

  [[noreturn]] void fail(const std::string& what, const std::string& hint = {}) const {
    file_.fail(here(), what, hint);
  }

  // In the tag that is open: it is well-formed. expat tells where the tag begins alone.
  std::size_t begin_of_value(std::string_view attribute) const {
    const std::string_view text = file_.bytes();
    for (std::size_t at = text.find_first_of(svg_blanks, here()); at != std::string_view::npos;) {
      const std::size_t name = text.find_first_not_of(svg_blanks, at), quote = text.find_first_of("\"'", name);
      if (quote == std::string_view::npos) break;
      const std::string_view found = text.substr(name, text.find_first_of(" \t\r\n=", name) - name);
      if (found == attribute) return quote + 1;
      at = text.find(text[quote], quote + 1);
      if (at != std::string_view::npos) ++at;
    }
    return here();
  }

  void open(std::string_view name, const char** attributes) {
    if (name.starts_with("svg:")) name.remove_prefix(4);
    const SvgAttributes given(attributes);
    Level level = levels_.empty() ? Level{} : levels_.back();
    if (levels_.empty()) {
      if (name != "svg")
        fail(fmt::format("a drawing begins with <svg>, not with {}", in_quotes(name)), "is it an SVG file?");
      take_style(given, level);
      level.place.scale(Vec2(1, -1));
    } else if (!level.passed_over) {
      enter(name, given, level);
    }
    levels_.push_back(level);
  }

  void take_style(const SvgAttributes& given, Level& level) {
    const auto value_of = [&](std::string_view property) {
      const std::string styled = property_of(given.text("style"), property);
      return styled.empty() ? std::string(trimmed(given.text(property))) : styled;
    };
    for (const char* cuts_away : {"clip-path", "mask"})
      if (const std::string by = value_of(cuts_away); !by.empty() && by != "none")
        fail(fmt::format("{} is not read", cuts_away), "cut the shapes themselves before the drawing is saved");
    if (!property_of(given.text("style"), "transform").empty())
      fail("a transform within style is not read", "write it as the attribute transform");
    if (value_of("display") == "none") level.passed_over = true;
    if (const std::string shown = value_of("visibility"); !shown.empty() && shown != "inherit")
      level.shows = shown == "visible";
    if (const std::string fill = value_of("fill"); !fill.empty() && fill != "inherit")
      level.fills = fill != "none";
  }

  // An element within the drawing that is not passed over with what is around it.
  void enter(std::string_view name, const SvgAttributes& given, Level& level) {
    take_style(given, level);
    if (level.passed_over) return;
    if (is_one_of(name, {"text", "image", "use", "svg", "switch", "style"}))
      fail(fmt::format("<{}> within a drawing is not read", name),
           name == "text" ? "turn letters into paths before it is saved; or <outline text=\"...\"/> makes them"
           : name == "style" ? "save the drawing with its colours as attributes of the shapes (plain SVG)"
                             : "turn it into paths before the drawing is saved");
    const bool shape = is_svg_shape(name);
    level.passed_over = !shape && !is_one_of(name, {"g", "a"});
    if (level.passed_over) return;
    std::string_view attribute = "transform";
    try {
      level.place = level.place * transform_of(given.text(attribute));
      if (!shape || !level.fills || !level.shows) return;
      for (const Curve& curve : curves_of_shape(name, given, attribute)) add(curve, level.place);
    } catch (const PathFault& fault) {
      file_.fail(place_in_value(attribute, fault.at), fmt::format("<{}>: {}", name, fault.what()));
    }
  }

  // expat hands over values in which references and line ends are replaced: of those only the begin is known.
  std::size_t place_in_value(std::string_view attribute, std::size_t at) const {
    const std::size_t begin = begin_of_value(attribute);
    const std::string_view before = file_.bytes().substr(begin, at);
    return before.find_first_of("&\r") == std::string_view::npos ? begin + at : begin;
  }

  void add(const Curve& curve, const Eigen::Affine2d& place) {
    Curve& added = curves_.emplace_back(curve);
    for (Cubic& cubic : added)
      for (Vec2& point : cubic) {
        point = place * point;
        if (!(point.cwiseAbs().maxCoeff() <= 1e9)) throw PathFault(0, "the transforms make it larger than 1e9");
      }
  }

  void close() { levels_.pop_back(); }

  const MeshSource& file_;
  std::vector<Level> levels_; // outermost first
  std::vector<Curve> curves_; // in the units of the drawing, y up
};

} // namespace

Outline outline_of_svg(const MeshSource& file) {
  Outline outline = flattened(SvgReader(file).read());
  if (outline.rings.empty())
    file.fail("the drawing fills nothing",
              "shapes that are only lines (fill=\"none\") have no area: turn their strokes into paths");
  return outline;
}

} // namespace rend
