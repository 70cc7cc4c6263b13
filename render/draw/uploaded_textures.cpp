#include "render/draw/uploaded_textures.h"

#include "sim/base/check.h"

#include <algorithm>
#include <set>

namespace rend {
namespace {

GLint gl_wrap(Wrap wrap) {
  return wrap == Wrap::Repeat ? GL_REPEAT : wrap == Wrap::Clamp ? GL_CLAMP_TO_EDGE : GL_MIRRORED_REPEAT;
}

// Of a number of 255, in 65535.
std::uint32_t light_of_number(std::size_t number) {
  return static_cast<std::uint32_t>((number * number * 65535 + 255 * 255 / 2) / (255 * 255));
}

void upload(GLint number, const TextureLevel& level) {
  if (level.channels == 1)
    return glTexImage2D(GL_TEXTURE_2D, number, GL_R8, level.width, level.height, 0, GL_RED, GL_UNSIGNED_BYTE,
                        level.texels.data());
  glTexImage2D(GL_TEXTURE_2D, number, GL_RGBA16, level.width, level.height, 0, GL_RGBA, GL_UNSIGNED_SHORT,
               nullptr);
  std::vector<std::uint16_t> row(std::size_t{4} * static_cast<std::size_t>(level.width));
  const std::uint8_t* from = level.texels.data();
  for (int y = 0; y < level.height; ++y) {
    for (std::size_t n = 0; n < row.size(); n += 4, from += level.channels) {
      const std::uint32_t alpha = level.channels == 4 ? from[3] : 255;
      for (std::size_t c = 0; c < 3; ++c)
        row[n + c] = static_cast<std::uint16_t>((light_of_number(from[c]) * alpha + 127) / 255);
      row[n + 3] = static_cast<std::uint16_t>(257 * alpha);
    }
    glTexSubImage2D(GL_TEXTURE_2D, number, 0, y, level.width, 1, GL_RGBA, GL_UNSIGNED_SHORT, row.data());
  }
}

} // namespace

void UploadedTextures::take_those_of(const Frame& frame, std::span<const TexturePoint> places) {
  std::set<std::shared_ptr<const Texture>> used;
  for (const FrameBody& body : frame.bodies)
    for (const auto& texture : {body.texture.front, body.texture.back, body.texture.roughness})
      if (texture) used.insert(texture);
  holes_ = std::ranges::any_of(used, [](const auto& texture) { return texture->cut_out; });
  if (holes_ && !opaque_)
    opaque_ = make_texture([] {
      Image white(1, 1);
      white.pixels = {255, 255, 255};
      return white;
    }());
  if (holes_) used.insert(opaque_);
  std::erase_if(textures_, [&](const auto& each) { return !used.contains(each.first); });
  for (const auto& texture : used) take(texture);
  take_places(places);
}

void UploadedTextures::take_places(std::span<const TexturePoint> places) {
  constexpr GLuint attribute = 4; // in the shaders
  if (places.empty()) return glDisableVertexAttribArray(attribute);
  glBindBuffer(GL_ARRAY_BUFFER, places_.name());
  glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(places.size_bytes()), places.data(), GL_STREAM_DRAW);
  glVertexAttribPointer(attribute, 2, GL_FLOAT, GL_FALSE, sizeof(TexturePoint), nullptr);
  glEnableVertexAttribArray(attribute);
}

void UploadedTextures::take(const std::shared_ptr<const Texture>& texture) {
  if (textures_.contains(texture)) return;
  const GlTexture& name = textures_[texture];
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, name.name());
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  GLint number = 0;
  for (const TextureLevel& level : texture->levels) upload(number++, level);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAX_LEVEL, number - 1);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  check_gl("UploadedTextures");
}

void UploadedTextures::bind(const FrameTexture& texture) const {
  if (texture.front) bind(front_unit, *texture.front, texture.wrap);
  if (texture.back) bind(back_unit, *texture.back, texture.wrap);
  if (texture.roughness) bind(roughness_unit, *texture.roughness, texture.wrap);
}

void UploadedTextures::bind_holes(const FrameTexture& texture) const {
  CHECK(opaque_);
  const bool has_holes = texture.front && texture.front->cut_out;
  bind(front_unit, has_holes ? *texture.front : *opaque_, texture.wrap);
}

void UploadedTextures::bind(int unit, const Texture& texture, Wrap wrap) const {
  const auto at =
      std::ranges::find_if(textures_, [&](const auto& each) { return each.first.get() == &texture; });
  CHECK(at != textures_.end());
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glBindTexture(GL_TEXTURE_2D, at->second.name());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, gl_wrap(wrap));
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, gl_wrap(wrap));
  glActiveTexture(GL_TEXTURE0);
}

} // namespace rend
