#include "render/picture/texture_map.h"

#include "sim/base/math.h"

namespace rend {

namespace {
using Eigen::Vector2d;
}

TextureMap::TextureMap(const Body& body, const LookSettings& look, double aspect)
    : places_(find_texture_coordinates(*body.map)), frame_(*body.map, look.frame, aspect),
      size_(places_ ? Vector2d(aspect, 1) : frame_.size()), scale_(look.scale[0], look.scale[1]),
      cosine_(cosine_of_degrees(look.rotate)), sine_(sine_of_degrees(look.rotate)) {}

TexturePlace TextureMap::place(const Vec3& rest, const Chart& chart) const {
  return in_picture(frame_.from_middle(rest, chart));
}

TexturePlace TextureMap::place(const TexturePlace& given) const {
  if (is_plain()) return given;
  return in_picture(Vector2d(given.u - 0.5, given.v - 0.5).cwiseProduct(size_));
}

TexturePlace TextureMap::in_picture(const Vector2d& from_middle) const {
  const Vector2d turned(cosine_ * from_middle.x() + sine_ * from_middle.y(),
                        cosine_ * from_middle.y() - sine_ * from_middle.x());
  const Vector2d place = turned.cwiseQuotient(scale_.cwiseProduct(size_));
  return {place.x() + 0.5, place.y() + 0.5};
}

} // namespace rend
