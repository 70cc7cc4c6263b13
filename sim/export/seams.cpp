#include "sim/export/seams.h"

#include "sim/base/check.h"

#include <algorithm>

namespace rend {
namespace {

// Replaces an array of `width` values a point by that of the new points; what is empty stays so.
template <class T>
void gather(std::vector<T>& values, std::size_t width, const std::vector<std::size_t>& from) {
  if (values.empty()) return;
  std::vector<T> to;
  for (const std::size_t point : from)
    for (std::size_t n = 0; n < width; ++n) to.push_back(values[point * width + n]);
  values = std::move(to);
}

} // namespace

std::vector<TexturePlace> split_at_seams(Skin& skin) {
  CHECK(skin.texture.size() == skin.corners.size());
  std::vector<std::vector<TexturePlace>> places(skin.vertex.size()); // of each point
  std::vector<std::size_t> which;                                    // of these, for each corner
  for (std::size_t c = 0; c < skin.corners.size(); ++c) {
    std::vector<TexturePlace>& known = places[static_cast<std::size_t>(skin.corners[c])];
    const auto at = std::find(known.begin(), known.end(), skin.texture[c]);
    which.push_back(static_cast<std::size_t>(at - known.begin()));
    if (at == known.end()) known.push_back(skin.texture[c]);
  }
  std::vector<TexturePlace> all;
  std::vector<std::size_t> from,
      first{0}; // the point of each new one; the first new one of each point, and the end
  for (std::size_t point = 0; point < places.size(); ++point) {
    all.insert(all.end(), places[point].begin(), places[point].end());
    from.resize(all.size(), point);
    first.push_back(all.size());
  }
  for (std::size_t c = 0; c < skin.corners.size(); ++c)
    skin.corners[c] = static_cast<std::int32_t>(first[static_cast<std::size_t>(skin.corners[c])] + which[c]);
  for (SkinOfBody& body : skin.bodies) body.points_end = first[body.points_end];
  gather(skin.points, 3, from);
  gather(skin.velocity, 3, from);
  gather(skin.largest_stress, 1, from);
  gather(skin.vertex, 1, from);
  gather(skin.body_of_point, 1, from);
  return all;
}

} // namespace rend
