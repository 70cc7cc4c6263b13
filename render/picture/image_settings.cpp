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
      field(&S::fps, number("fps", "1/s", "frames per second of the clip").above(0).at_most(1e6)),
      field(
          &S::speed,
          number(
              "speed", "",
              "seconds of simulation in a second of the clip; 0.1: slow motion, ten times slower. Keys change "
              "it during the clip")
              .at_least(least_speed)
              .at_most(most_speed)),
      field(&S::shutter,
            number("shutter", "",
                   "motion blur: the share of the time between two frames for which the shutter is "
                   "open; it closes at the time of the frame; 0: no blur")
                .at_least(0)
                .at_most(1)),
      field(&S::shutter_samples,
            integer("shutter-samples", "with shutter: a picture is the mean of so many moments of that time")
                .at_least(2)
                .at_most(256)),
      samples(),
      colour_field(&S::background,
                   text("background", "background colour, #rrggbb; none: transparent, without the floor"),
                   "none"),
      field(&S::floor_shadow,
            flag("floor-shadow", "with background=\"none\": the shadows on the floor are kept, as black whose "
                                 "alpha says how dark they are")),
      field(&S::occlusion, flag("occlusion", "ambient occlusion: folds, cracks and gaps are darker; it takes a "
                                             "fifth of the time of a picture"))};
  return fields;
}

void check_image(const ImageSettings& image) {
  if (!image.speed_keys.empty() && image.source.given("speed"))
    image.source.fail("speed", "speed cannot be used together with <key>: the keys say how fast the clip plays",
                      "leave out speed, or the keys");
  if (image.source.given("shutter-samples") && image.shutter == 0 && !image.source.given("shutter"))
    image.source.fail("shutter-samples", "the shutter has samples, but it does not open",
                      "add shutter=\"0.5\": it is open for half of the time between two frames");
  if (image.floor_shadow && !image.transparent())
    image.source.fail("floor-shadow", "floor-shadow has no use where there is a background: the floor is seen",
                      "leave it out, or add background=\"none\"");
  image.playback();
}

} // namespace rend
