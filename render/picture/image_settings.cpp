#include "render/picture/image_settings.h"

#include <fmt/format.h>

namespace rend {
namespace {

void check_samples(const ImageSettings& image, const SettingsSource& source) {
  if (image.samples != 1 && image.samples != 4 && image.samples != 16)
    source.fail("samples", fmt::format("{} samples a pixel", image.samples), "use 1, 4 or 16");
}

// A word of the table, a number for a program.
Field<ImageSettings> samples() {
  AttributeType type = word("samples", {"1", "4", "16"},
                            "samples per pixel\n1: jagged edges, fastest\n4: smooth edges\n16: fine lines and "
                            "gloss are smooth as well; takes four times as long");
  type.otherwise(std::to_string(ImageSettings{}.samples));
  return {type,
          [](ImageSettings& image, const AttributeValue& value) { image.samples = std::stoi(value.text); },
          check_samples};
}

} // namespace

template <> const Fields<ImageSettings>& fields_of() {
  using S = ImageSettings;
  static const Fields<S> fields{
      field(&S::size, integers("size", 2, "width and height in pixels").at_least(16).at_most(8192)),
      field(&S::fps, number("fps", "1/s", "frames per second of simulated time").above(0).at_most(1e6)),
      samples(),
      colour_field(&S::background,
                   text("background", "background colour, #rrggbb; none: transparent, without the floor"),
                   "none"),
      field(&S::occlusion, flag("occlusion", "ambient occlusion: folds, cracks and gaps are darker; it takes a "
                                             "fifth of the time of a picture"))};
  return fields;
}

} // namespace rend
