#include "render/picture/look.h"

namespace rend {
namespace {

// A colour, or the word for no line.
Field<LookSettings> torn() {
  return {text("torn",
               "of a sheet: colour of the line along torn edges, #rrggbb, or none for no line; default: "
               "orange, and none where change=\"cut\" alone tears the body"),
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

} // namespace

template <> const Fields<LookSettings>& fields_of() {
  using S = LookSettings;
  static const Fields<S> fields{
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
      field(&S::edges, flag("edges", "whether the edges of cells are drawn")),
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
      finish()};
  return fields;
}

} // namespace rend
