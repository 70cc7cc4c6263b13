#include "render/picture/look.h"

namespace rend {
namespace {

// A name in the table, the numbers that it stands for in a program.
Field<LookSettings> finish() {
  AttributeType type = text("finish", "cloth, matte, rubber, organ or brittle: how it takes the light");
  type.otherwise(LookSettings{}.finish.name);
  return {type,
          [](LookSettings& look, const AttributeValue& value) { look.finish = finish_called(value.text); },
          [](const LookSettings&, const SettingsSource&) {}};
}

} // namespace

template <> const Fields<LookSettings>& fields_of() {
  using S = LookSettings;
  static const Fields<S> fields{
      colour_field(&S::colour, text("colour", "#rrggbb")),
      colour_field(&S::back,
                   text("back", "#rrggbb, of a sheet's far side; default: the colour, a shade darker")),
      colour_field(&S::inside, text("inside", "#rrggbb, of the faces of a solid that fracture lays bare")),
      field(&S::by, word("by", {"plain", "strain", "stress", "force", "fragment"},
                         "what the colour shows, on a scale from 0 to the most of the clip so far: the largest "
                         "principal strain or stress [Pa] of the elements there (of springs: elongation), or "
                         "force [N]")),
      field(&S::most,
            number("most", "",
                   "the quantity at the end of the scale; default: the most of the clip so far, rounded up")
                .above(0)),
      field(&S::edges, flag("edges", "draw the edges of cells")),
      field(&S::as,
            word("as", {"surface", "wires", "exploded", "darts"},
                 "what is drawn: the surface; its edges alone; every cell by itself, moved away from the "
                 "middle; the darts of the map and the links between them")),
      field(&S::apart,
            number("apart", "",
                   "of exploded cells: how far they are moved, in shares of their distance from the middle")
                .above(0)
                .at_most(10)),
      finish()};
  return fields;
}

} // namespace rend
