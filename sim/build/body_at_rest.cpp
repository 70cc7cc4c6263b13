#include "sim/build/body_at_rest.h"

#include "sim/build/picture_frame.h"

#include <algorithm>

namespace rend {

BodyAtRest body_at_rest(const Body& body, const BodySettings& settings, const ExpressionSettings& expression) {
  if (!asks_for_picture_place(settings)) return {*body.map, body.groups};
  TextureFrame frame{settings.place, {}};
  if (const auto* sheet = std::get_if<SheetShape>(&settings.shape)) frame.sheet = *sheet;
  const double aspect = expression.mask ? expression.mask->aspect() : 1;
  return {*body.map, body.groups,
          [picture = PictureFrame(*body.map, frame, aspect)](const Vec3& rest) { return picture.place(rest); }};
}

bool asks_for_picture_place(const BodySettings& settings) {
  return asks_for_picture_place(settings.mass.density_by_place) ||
         std::ranges::any_of(settings.tears, [](const LawSettings& law) {
           const auto strength = strength_expression(law.strength, false);
           return strength && asks_for_picture_place(*strength);
         });
}

} // namespace rend
