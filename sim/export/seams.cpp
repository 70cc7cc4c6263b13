#include "sim/export/seams.h"

#include "sim/base/check.h"

#include <algorithm>

namespace rend {
namespace {

struct SplitPoints {
  std::vector<TexturePlace> places; // of each point that there is now
  std::vector<std::size_t> from;    // and which one it was
  std::vector<std::size_t> first; // of each that there was, the first it became; at the end how many there are
};

// Numbers the corners anew. texture: the place of each.
template <class Point>
SplitPoints split_points(std::size_t points, std::vector<Point>& corners,
                         const std::vector<TexturePlace>& texture) {
  CHECK(texture.size() == corners.size());
  std::vector<std::vector<TexturePlace>> places(points); // of each point
  std::vector<std::size_t> which;                        // of these, for each corner
  for (std::size_t c = 0; c < corners.size(); ++c) {
    std::vector<TexturePlace>& known = places[static_cast<std::size_t>(corners[c])];
    const auto at = std::find(known.begin(), known.end(), texture[c]);
    which.push_back(static_cast<std::size_t>(at - known.begin()));
    if (at == known.end()) known.push_back(texture[c]);
  }
  SplitPoints all;
  for (std::size_t point = 0; point < points; ++point) {
    all.first.push_back(all.places.size());
    all.places.insert(all.places.end(), places[point].begin(), places[point].end());
    all.from.resize(all.places.size(), point);
  }
  all.first.push_back(all.places.size());
  for (std::size_t c = 0; c < corners.size(); ++c)
    corners[c] = static_cast<Point>(all.first[static_cast<std::size_t>(corners[c])] + which[c]);
  return all;
}

// Replaces an array of `width` values a point by that of the new points; what is empty stays so.
template <class T>
void gather(std::vector<T>& values, std::size_t width, const std::vector<std::size_t>& from) {
  if (values.empty()) return;
  std::vector<T> to;
  for (const std::size_t point : from)
    for (std::size_t n = 0; n < width; ++n) to.push_back(values[point * width + n]);
  values = std::move(to);
}

// Corners of polyhedra are in one place, the middle of the picture: their points stay one.
void number_polyhedra_anew(std::vector<std::int64_t>& faces, const std::vector<std::size_t>& first) {
  for (std::size_t at = 0; at < faces.size();)
    for (std::int64_t left = faces[at++]; left > 0; --left)
      for (std::int64_t corner = faces[at++]; corner > 0; --corner, ++at)
        faces[at] = static_cast<std::int64_t>(first[static_cast<std::size_t>(faces[at])]);
}

} // namespace

std::vector<TexturePlace> split_at_seams(Skin& skin) {
  SplitPoints split = split_points(skin.vertex.size(), skin.corners, skin.texture);
  for (SkinOfBody& body : skin.bodies) body.points_end = split.first[body.points_end];
  gather(skin.points, 3, split.from);
  gather(skin.velocity, 3, split.from);
  gather(skin.largest_stress, 1, split.from);
  gather(skin.vertex, 1, split.from);
  gather(skin.body_of_point, 1, split.from);
  return std::move(split.places);
}

std::vector<TexturePlace> split_at_seams(Grid& grid) {
  SplitPoints split = split_points(grid.points.size() / 3, grid.corners, grid.texture);
  number_polyhedra_anew(grid.faces, split.first);
  gather(grid.points, 3, split.from);
  for (GridArray& array : grid.on_points)
    std::visit([&](auto& values) { gather(values, static_cast<std::size_t>(array.components), split.from); },
               array.values);
  return std::move(split.places);
}

} // namespace rend
