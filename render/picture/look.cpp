#include "render/picture/look.h"

#include <fmt/format.h>

namespace rend {
namespace {

// A colour, or the word for no line.
Field<LookSettings> torn() {
  return {text("torn",
               "of a sheet: colour of the line along torn edges, #rrggbb, or none for no line; default: orange "
               "where edges are drawn, unless only change=\"cut\" tears the body; else none"),
          [](LookSettings& look, const AttributeValue& value) {
            look.torn_edges = value.text != "none";
            look.torn = *look.torn_edges ? colour_called(value.text) : std::nullopt;
          },
          [](const LookSettings&, const SettingsSource&) {}};
}

// A name in the table, the numbers that it stands for in a program.
Field<LookSettings> finish() {
  AttributeType type = text("finish", "material, for the light on it: cloth, matte, rubber, organ or brittle");
  type.otherwise(LookSettings{}.finish.name);
  return {type,
          [](LookSettings& look, const AttributeValue& value) { look.finish = finish_called(value.text); },
          [](const LookSettings&, const SettingsSource&) {}};
}

Field<LookSettings> finish_inside() {
  return {
      text("finish-inside", "that of the faces of a solid that fracture exposes; default: the body's finish"),
      [](LookSettings& look, const AttributeValue& value) { look.finish_inside = finish_called(value.text); },
      [](const LookSettings&, const SettingsSource&) {}};
}

// `scale` is what it is of <place>: a factor of the size.
Fields<LookSettings> texture_fields() {
  using S = LookSettings;
  const std::string file =
      fmt::format("a PNG or JPEG file of at most {0} x {0} pixels, relative to the preset, and in its "
                  "folder or below",
                  largest_texture);
  return {
      field(&S::texture,
            text("texture",
                 "picture on the body, in place of its colour: " + file +
                     ". It is spread once over a sheet that the preset makes, and lies by the texture "
                     "coordinates of a mesh file that has them; on others it is as wide as they are, and lies "
                     "in the plane of x, y, z that a face is closest to at rest. Where "
                     "it is transparent by more than a half, a sheet has holes. Not shown where by= shows "
                     "something")),
      field(&S::texture_back,
            text("texture-back", "picture on the back of a sheet, likewise, where it reads from "
                                 "left to right as well")),
      field(&S::texture_inside,
            text("texture-inside", "picture on the faces of a solid that fracture exposes, likewise")),
      field(&S::roughness,
            text("roughness",
                 "picture of how rough the surface is, in place of one gloss all over: black as the "
                 "finish has it, white rough; of coloured pictures the green channel. It lies as the "
                 "texture does, on both sides of a sheet")),
      field(&S::roughness_inside,
            text("roughness-inside", "likewise, on the faces of a solid that fracture exposes")),
      field(&S::wrap,
            word("wrap", {"repeat", "clamp", "mirror"},
                 "how a picture goes on beyond its sides; default: clamp where it is spread over a sheet "
                 "once, else repeat\nrepeat: it begins again\nclamp: its outermost pixels go "
                 "on\nmirror: it is mirrored")),
      field(&S::scale,
            numbers("scale", 2, "", "factors of the width and the height of a picture, about its middle")
                .at_least(1e-3)
                .at_most(1e3)),
      field(&S::rotate, number("rotate", "degrees",
                               "turns a picture about its middle, anticlockwise as seen from the front; that "
                               "on the back turns with it"))};
}

} // namespace

template <> const Fields<LookSettings>& fields_of() {
  using S = LookSettings;
  static const Fields<S> plain{
      colour_field(&S::colour, text("colour", "colour of the body, #rrggbb")),
      colour_field(
          &S::back,
          text("back", "colour of the back of a sheet, #rrggbb; default: the colour, slightly darker")),
      colour_field(&S::inside, text("inside", "colour of the faces of a solid that fracture exposes, #rrggbb")),
      field(&S::by, word("by", {"plain", "strain", "stress", "force", "fragment"},
                         "what the colour shows\nplain: nothing, the body has its colour\nstrain: the largest "
                         "principal strain of the elements there; of springs their relative "
                         "elongation\nstress: the largest principal stress of the elements there [Pa]\nforce: "
                         "the force at the vertex [N]\nfragment: each fragment has a colour of its own")),
      field(&S::most, number("most", "",
                             "the value at the upper end of the colour scale; default: the largest value of "
                             "the clip so far, rounded up")
                          .above(0)),
      field(&S::edges, flag("edges", "whether the edges of cells are drawn, and the mesh is shaded as it is; "
                                     "default: yes for wires and exploded, else no, and a sheet is then shaded "
                                     "smoothly")),
      torn(),
      field(&S::torn_width, number("torn-width", "",
                                   "width of that line, where there is one: pixels in a picture of height 720; "
                                   "in others in proportion")
                                .above(0)
                                .at_most(100)),
      field(&S::as, word("as", {"surface", "wires", "exploded", "darts"},
                         "how the body is shown\nsurface: its surface\nwires: only the edges of its "
                         "surface\nexploded: every cell separately, moved away from the middle\ndarts: the "
                         "darts of the generalized map and the links between them")),
      field(&S::apart,
            number("apart", "", "exploded: how far cells are moved, relative to their distance from the middle")
                .above(0)
                .at_most(10)),
      field(
          &S::thickness,
          number(
              "thickness", "m",
              "of a sheet, as it is drawn: it gets a rim, round where it is whole, rough and lighter where "
              "it is torn (torn: in that colour), and no lines along edges; default: that of <mass>, where it "
              "is at least a 300th of the sheet's size, else none")
              .above(0)
              .at_most(1)),
      field(&S::smooth,
            integer("smooth",
                    "draws each triangle as a curved surface, each side divided into so many parts: with "
                    "2 to 4 the outline of a coarse mesh looks round; torn and sharp edges stay straight")
                .at_least(1)
                .at_most(8)),
      finish(),
      finish_inside()};
  static const Fields<S> fields = plain + texture_fields();
  return fields;
}

} // namespace rend
