// Drawings: areas in closed form, the same shape written in several ways, and where what is wrong stands.
#include "sim/mesh/svg_file.h"

#include "sim/base/math.h"
#include "tests/test_paths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::svg_file_test {
namespace {

using testing::HasSubstr;

Outline outline_of(const std::string& content) {
  return outline_of_svg(
      MeshSource("d.svg", R"(<svg xmlns="http://www.w3.org/2000/svg">)" + content + "</svg>"));
}

double area_of_svg(const std::string& content) {
  return outline_of(content).area();
}

std::string fault_of(const std::string& text) {
  try {
    static_cast<void>(outline_of_svg(MeshSource("d.svg", text)));
  } catch (const UserError& error) {
    EXPECT_EQ(error.code, Exit::BadInput);
    return error.what();
  }
  return "";
}

TEST(SvgFile, shapes_have_the_areas_of_closed_forms) {
  EXPECT_NEAR(area_of_svg(R"(<path d="M0 0h3v2h-3z"/>)"), 6, 6e-3);
  EXPECT_NEAR(area_of_svg(R"(<rect x="1" y="2" width="3" height="2px"/>)"), 6, 6e-3);
  EXPECT_NEAR(area_of_svg(R"(<rect width="3" height="2" rx="0.5"/>)"), 6 - (4 - pi) * 0.25, 6e-3);
  EXPECT_NEAR(area_of_svg(R"(<rect width="3" height="2" rx="9" ry="0.5"/>)"), 6 - (4 - pi) * 0.75, 6e-3);
  EXPECT_NEAR(area_of_svg(R"(<circle cx="4" r="2"/>)"), 4 * pi, 0.02);
  EXPECT_NEAR(area_of_svg(R"(<ellipse rx="2" ry="1" cy="-1e-3"/>)"), 2 * pi, 0.01);
  EXPECT_NEAR(area_of_svg(R"(<polygon points="0,0 4,0 4,3"/>)"), 6, 6e-3);
  EXPECT_NEAR(area_of_svg(R"(<polyline points="0 0 4 0 4 3"/>)"), 6, 6e-3);
  EXPECT_NEAR(area_of_svg(R"(<circle r="2"/><circle r="1"/>)"), 3 * pi, 0.02); // a shape in a shape is a hole
}

TEST(SvgFile, transforms_multiply_areas_and_the_last_acts_first) {
  const std::string square = R"(<rect width="1" height="1")";
  EXPECT_NEAR(area_of_svg("<g transform=\"scale(2)\">" + square + " transform=\"scale(3 -1)\"/></g>"), 12,
              0.012);
  EXPECT_NEAR(area_of_svg(square + R"( transform='matrix(1 2 3 1 7 7)'/>)"), 5, 0.01); // |1·1 − 2·3|
  EXPECT_NEAR(area_of_svg(square + R"( transform='rotate(30) skewX(40) skewY(-20)'/>)"), 1, 3e-3);
  EXPECT_NEAR(outline_of(square + R"( transform='skewX(45)'/>)").box().sizes().x(), 2, 1e-12);
  EXPECT_NEAR(outline_of(square + R"( transform='skewY(45)'/>)").box().sizes().y(), 2, 1e-12);
  // y is turned over.
  const auto box = outline_of(square + R"( transform='translate(5,1),scale(2)'/>)").box();
  EXPECT_LT((box.min() - Vec2(5, -3)).norm(), 1e-12);
  EXPECT_LT((box.max() - Vec2(7, -1)).norm(), 1e-12);
  const auto other = outline_of(square + R"( transform='scale(2) translate(5 1)'/>)").box();
  EXPECT_LT((other.min() - Vec2(10, -4)).norm(), 1e-12);
  // About (1, 3): what is above comes to the right.
  const auto turned = outline_of(square + R"( transform='rotate(90 1 3)'/>)").box();
  EXPECT_LT((turned.min() - Vec2(3, -3)).norm(), 1e-12);
  EXPECT_LT((turned.max() - Vec2(4, -2)).norm(), 1e-12);
}

TEST(SvgFile, what_fills_nothing_is_passed_over) {
  const std::string square = R"(<rect width="1" height="1"/>)", large = R"(<rect width="9" height="9")";
  for (const std::string& more :
       {large + R"( fill="none"/>)", large + R"( style="stroke:red; fill : none"/>)",
        R"(<g display="none">)" + large + "/></g>", "<defs>" + large + "/></defs>",
        "<clipPath><g>" + large + "/></g></clipPath>", std::string("<title>a<x/></title>"),
        "<inkscape:grid " + large.substr(5) + "/>",
        R"(<g fill="none">)" + large + "/><g>" + large + "/></g></g>",
        std::string(R"(<path d=""/><circle r="0"/>)")})
    EXPECT_NEAR(area_of_svg(square + more), 1, 1e-3) << more;
  EXPECT_NEAR(area_of_svg(R"(<g fill="none">)" + large + R"( style="fill:#123"/></g>)"), 81, 0.081);
  EXPECT_NEAR(outline_of_svg(MeshSource("d.svg", R"(<?xml version="1.0"?>
    <!DOCTYPE svg PUBLIC "-//W3C//DTD SVG 1.1//EN" "http://www.w3.org/Graphics/SVG/1.1/DTD/svg11.dtd">
    <svg:svg xmlns:svg="http://www.w3.org/2000/svg"><svg:rect width="2" height="2"/></svg:svg>)"))
                  .area(),
              4, 4e-3);
}

TEST(SvgFile, subpaths_without_area_and_hidden_shapes_are_passed_over) {
  const std::string square = R"(<rect width="1" height="1"/>)";
  for (const char* more :
       {R"(<path d="M0 0"/>)", R"(<path d="M5 5z"/>)", R"(<path d="M2 2 A 1 1 0 0 1 2 2"/>)",
        R"(<rect width="9" height="9" visibility="hidden"/>)", R"(<rect width="9" height="9" fill=" none "/>)",
        R"(<rect width="9" height="9" style="fill:none!important"/>)",
        R"(<g visibility="hidden"><rect width="9" height="9"/></g>)"})
    EXPECT_NEAR(area_of_svg(square + more), 1, 1e-3) << more;
  const std::string shown = R"(<g visibility="hidden"><rect width="2" height="1" visibility="visible"/></g>)";
  EXPECT_NEAR(area_of_svg(shown), 2, 2e-3);
}

TEST(SvgFile, what_would_change_the_shape_and_is_not_read_is_refused) {
  const std::string rest = R"( width='5' height='1'/></svg>)";
  EXPECT_THAT(fault_of("<svg><rect clip-path='url(#a)'" + rest), HasSubstr("clip-path is not read"));
  EXPECT_THAT(fault_of("<svg><g style='mask: url(#a)'><rect" + rest), HasSubstr("mask is not read"));
  EXPECT_THAT(fault_of("<svg><rect style='transform: scale(2)'" + rest), HasSubstr("transform within style"));
  EXPECT_THAT(fault_of("<svg><style>.a{fill:none}</style><rect" + rest), HasSubstr("<style> within"));
  EXPECT_THAT(fault_of("<svg><switch><rect" + rest), HasSubstr("<switch> within"));
}

// The bow, of radius 35, has a hole of radius 16; the shaft ends 150 from its middle.
TEST(SvgFile, the_key_of_the_presets_has_a_hole) {
  const std::filesystem::path file = std::filesystem::path(test::source_root) / "presets/meshes/key.svg";
  const Outline key = outline_of_svg(MeshSource::open(file, "file"));
  ASSERT_EQ(key.rings.size(), 2u);
  Outline hole;
  hole.rings = {key.rings[1]};
  EXPECT_NEAR(std::abs(hole.area()), pi * 16 * 16, 1);
  EXPECT_NEAR(key.box().max().x() - hole.box().center().x(), 150, 1e-6);
}

TEST(SvgFile, faults_tell_where) {
  EXPECT_THAT(fault_of("<svg>\n  <path id='d' d='M 0 0 L 1 x'/>\n</svg>"),
              HasSubstr("d.svg:2:29: <path>: command L"));
  EXPECT_THAT(fault_of("<svg>\n<rect width='3mm' height='1'/></svg>"),
              HasSubstr("d.svg:2:15: <rect>: width is to be"));
  EXPECT_THAT(fault_of("<svg><g\ntransform='scale(2) turn(3)'/></svg>"),
              HasSubstr("d.svg:2:21: <g>: there is no transform 'turn'"));
  EXPECT_THAT(fault_of("<svg><polygon points='0 0 1 0 1'/></svg>"), HasSubstr("pairs of numbers"));
  EXPECT_THAT(fault_of("<svg>\n <text>A</text></svg>"),
              HasSubstr("d.svg:2:2: <text> within a drawing is not read"));
  EXPECT_THAT(fault_of("<svg><use href='#a'/></svg>"), HasSubstr("<use> within"));
  EXPECT_THAT(fault_of("<scene/>"), HasSubstr("d.svg:1:1: a drawing begins with <svg>"));
  EXPECT_THAT(fault_of("<svg><g></svg>"), HasSubstr("d.svg:1:11: this is not XML"));
  EXPECT_THAT(fault_of(""), HasSubstr("d.svg:1:1: this is not XML"));
  EXPECT_THAT(fault_of("<svg><rect width='1' height='1' fill='none'/></svg>"),
              HasSubstr("d.svg: the drawing fills nothing"));
  EXPECT_THAT(fault_of("<svg><rect width='1e9' height='1' transform='scale(9)'/></svg>"),
              HasSubstr("larger than 1e9"));
  EXPECT_THAT(fault_of("<!DOCTYPE svg [<!ENTITY a 'b'>]><svg/>"), HasSubstr("entities"));
  // Values that are not as they stand in the file: where they begin.
  EXPECT_THAT(fault_of("<svg>\r\n<path d='M 0 0\r\n L 1 x'/></svg>"), HasSubstr("d.svg:2:10: <path>"));
  EXPECT_THAT(fault_of("<svg><path d='M 0 0&#32;L 1 x'/></svg>"), HasSubstr("d.svg:1:15: <path>"));
  EXPECT_THAT(fault_of(std::string("\xFF\xFE<\0s\0", 6)), HasSubstr("this is not UTF-8 text"));
}

} // namespace
} // namespace rend::svg_file_test
