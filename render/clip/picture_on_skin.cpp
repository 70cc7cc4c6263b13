#include "render/clip/picture_on_skin.h"

#include "render/picture/laid_texture.h"
#include "render/picture/texture_file.h"
#include "render/picture/texture_map.h"
#include "sim/boundary/face_sense.h"
#include "sim/topology/orientation.h"

#include <algorithm>

namespace rend {
namespace {

std::array<double, 3> shares_of(const Colour& colour) {
  return {colour[0] / 255.0, colour[1] / 255.0, colour[2] / 255.0};
}

// As a file in `folder` names it: with / on every system, as texts of exports have it.
std::string relative_to(const std::filesystem::path& folder, const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path whole = std::filesystem::absolute(file); // a folder need not be there yet
  const std::filesystem::path from = std::filesystem::relative(whole, std::filesystem::absolute(folder), error);
  return (error || from.empty() ? whole : from).generic_string();
}

// Whether the walk of a face of a sheet from d to α0 d shows its front.
bool shows_front(const EmbeddedMap& map, Dart d) {
  const Slot face = map.slot(FaceOfVolume, d);
  return turns_alike(map.map(), map.cells(FaceOfVolume).first_dart(face), d) !=
         is_turned(find_face_sense(map), face);
}

// The places of the corners of a face; one chart for all, as in pictures.
void lay_face(const TextureMap& texture, const EmbeddedMap& map, std::span<const Dart> corners,
              std::vector<TexturePlace>& out) {
  if (const auto* places = texture.places()) {
    for (const Dart d : corners) out.push_back(texture.place((*places)[map.slot(VertexOfFace, d)]));
    return;
  }
  Vec3 middle = Vec3::Zero(), across = Vec3::Zero();
  for (const Dart d : corners) middle += map.rest_of(d) / static_cast<double>(corners.size());
  for (std::size_t k = 1; k + 1 < corners.size(); ++k)
    across += (map.rest_of(corners[k]) - map.rest_of(corners[0]))
                  .cross(map.rest_of(corners[k + 1]) - map.rest_of(corners[0]));
  if (map.dimension() == 2 && !shows_front(map, corners[0])) across = -across;
  const TextureMap::Chart chart = texture.chart(middle, across);
  for (const Dart d : corners) out.push_back(texture.place(map.rest_of(d), chart));
}

SkinPicture skin_picture_of(const Body& body, const LookSettings& look, const std::filesystem::path& folder) {
  SkinPicture picture;
  picture.outside.colour = shares_of(look.colour);
  picture.exposed.colour = shares_of(look.inside);
  if (!shows_pictures(look)) return picture;
  std::optional<TextureMap> outside, exposed;
  if (!look.texture.empty()) {
    outside.emplace(body, look, texture_aspect(look, "texture", look.texture));
    picture.outside.picture = relative_to(folder, look.folder / look.texture);
  }
  if (!look.texture_inside.empty()) {
    exposed.emplace(body, look, texture_aspect(look, "texture-inside", look.texture_inside));
    picture.exposed.picture = relative_to(folder, look.folder / look.texture_inside);
  }
  picture.lay = [map = body.map.get(), outside, exposed](std::span<const Dart> corners, bool is_exposed,
                                                         std::vector<TexturePlace>& out) {
    lay_face(is_exposed ? *exposed : *outside, *map, corners, out);
  };
  return picture;
}

template <class Look> void add_materials(SkinPictures& to, std::size_t count, std::vector<Look> looks) {
  looks.resize(count);
  for (const Look& look : looks) {
    SkinPicture plain;
    plain.outside.colour = shares_of(look.colour);
    to.push_back(std::move(plain));
  }
}

} // namespace

SkinPictures pictures_on_skin(const PictureSettings& settings, const Scene& scene,
                              const std::filesystem::path& folder) {
  SkinPictures all;
  std::vector<LookSettings> looks = settings.looks;
  looks.resize(scene.bodies().size());
  for (std::size_t n = 0; n < looks.size(); ++n)
    all.push_back(skin_picture_of(*scene.bodies()[n], looks[n], folder));
  if (std::ranges::all_of(all, [](const SkinPicture& each) {
        return each.outside.picture.empty() && each.exposed.picture.empty();
      }))
    return {};
  add_materials(all, scene.world().spheres.size(), settings.spheres);
  add_materials(all, scene.world().boxes.size(), settings.boxes);
  add_materials(all, scene.world().meshes.size(), settings.meshes);
  return all;
}

} // namespace rend
