#include "render/picture/laid_texture.h"

#include "sim/mechanics/winding.h"

namespace rend {

bool shows_pictures(const LookSettings& look) {
  return look.by == ColourBy::Plain && (look.as == DrawStyle::Surface || look.as == DrawStyle::Wires);
}

LaidTexture::LaidTexture(Body& body, const LookSettings& look, const LookTextures& textures) : body_(&body) {
  outside_ = layer(body, look, textures.leading(), {textures.front, textures.back, {}, 1, textures.roughness});
  inside_ =
      layer(body, look, textures.leading_inside(), {textures.inside, {}, {}, 1, textures.roughness_inside});
}

// leading: by whose proportions its pictures lie; null: it has none.
std::optional<LaidTexture::Layer> LaidTexture::layer(const Body& body, const LookSettings& look,
                                                     const Texture* leading, FrameTexture texture) {
  if (!leading) return {};
  TextureMap map(body, look, leading->aspect());
  texture.wrap = look.wrap.value_or(map.is_spread_once() ? Wrap::Clamp : Wrap::Repeat);
  if (texture.front && texture.back && !map.is_spread())
    texture.back_height = static_cast<float>(texture.back->aspect() / texture.front->aspect());
  return Layer{std::move(texture), std::move(map)};
}

void LaidTexture::lay(FrameBody& out, DrawnFaces which) const {
  const std::optional<Layer>& layer = which == DrawnFaces::Exposed ? inside_ : outside_;
  if (!layer) return;
  out.texture = layer->texture;
  out.texture_points.reserve(out.corners.size());
  layer->map.places() ? lay_by_coordinates(*layer, out, which) : lay_by_charts(*layer, out, which);
}

void LaidTexture::lay_by_coordinates(const Layer& layer, FrameBody& out, DrawnFaces which) const {
  const EmbeddedMap& map = *body_->map;
  const Column<TextureCoordinates>& places = *layer.map.places();
  body_->boundary().for_each_triangle([&](const BoundaryTriangle& triangle) {
    if (!is_drawn(which, triangle.exposed)) return;
    for (const Dart d : corner_darts(map.map(), triangle))
      out.texture_points.push_back(layer.map.at(places[map.slot(VertexOfFace, d)]));
  });
}

void LaidTexture::lay_by_charts(const Layer& layer, FrameBody& out, DrawnFaces which) const {
  const EmbeddedMap& map = *body_->map;
  const bool solid = map.dimension() == 3;
  const auto& rest = map.rest().values();
  TextureMap::Chart chart; // of the last face
  body_->boundary().for_each_triangle([&](const BoundaryTriangle& triangle) {
    if (!is_drawn(which, triangle.exposed)) return;
    const auto [a, b, c] = triangle.vertex;
    const Vec3 p = rest[a].vec(), q = rest[b].vec(), r = rest[c].vec();
    if (!solid || triangle.number == 0) // those of a solid come face by face
      chart = layer.map.chart((p + q + r) / 3, rest_area_vector(map, corner_darts(map.map(), triangle)[0]));
    for (const Vec3& x : {p, q, r}) out.texture_points.push_back(layer.map.at(x, chart));
  });
}

} // namespace rend
