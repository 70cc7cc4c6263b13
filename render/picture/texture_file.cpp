#include "render/picture/texture_file.h"

#include "render/files/picture_file.h"

#include "sim/base/math.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

constexpr const char* whole_file = "save the picture again, as a complete PNG or JPEG file";

std::filesystem::path path_of(const LookSettings& look, const std::string& file) {
  return (look.folder / file).lexically_normal();
}

// The errors of the reader name the file; here they get the place of its name.
template <class F> auto at_attribute(const LookSettings& look, const std::string& attribute, F&& read) {
  try {
    return read();
  } catch (const UserError& error) {
    std::string hint = error.hint;
    if (error.code == Exit::NoInput) hint = "its name is relative to the folder of the preset";
    if (error.code == Exit::BadInput && hint.empty()) hint = whole_file;
    throw UserError(error.code, look.source.place(attribute), error.what(), hint);
  }
}

// A header that does not come first has no size.
void check_size(const LookSettings& look, const std::string& attribute, const std::string& file, int width,
                int height) {
  if (width < 1 || height < 1)
    look.source.fail(attribute,
                     fmt::format("{} does not begin with its size: its header is damaged", in_quotes(file)),
                     whole_file);
  if (std::max(width, height) > largest_texture)
    look.source.fail(attribute,
                     fmt::format("{} is a picture of {} x {} pixels; at most {} x {} are allowed",
                                 in_quotes(file), width, height, largest_texture, largest_texture),
                     "make it smaller: a video of 1280 x 720 shows no more of it than 2048 pixels across");
}

PictureInfo info_of(const LookSettings& look, const std::string& attribute, const std::string& file) {
  const PictureInfo info = at_attribute(look, attribute, [&] { return picture_info(path_of(look, file)); });
  check_size(look, attribute, file, info.width, info.height);
  return info;
}

Image image_of(const LookSettings& look, const std::string& attribute, const std::string& file) {
  const std::filesystem::path path = path_of(look, file);
  info_of(look, attribute, file);
  Image image = at_attribute(look, attribute, [&] { return read_picture(path); });
  check_size(look, attribute, file, image.width, image.height); // it may have been written anew meanwhile
  return image;
}

void check_holes(const LookSettings& look, const std::string& attribute, const std::string& file,
                 const std::string& why, const std::string& hint) {
  if (!file.empty() && is_transparent(image_of(look, attribute, file)))
    look.source.fail(attribute, fmt::format("{} is transparent in places, {}", in_quotes(file), why), hint);
}

void check_sides(const LookSettings& look, bool solid) {
  if (solid && !look.texture_back.empty())
    look.source.fail("texture-back", "the body is a solid, which shows no back",
                     "texture is on its outside, texture-inside on the faces that tearing exposes");
  if (!solid && !look.texture_inside.empty())
    look.source.fail("texture-inside", "the body is a sheet, which has no inside",
                     "texture and texture-back are on its sides");
  if (!solid && !look.roughness_inside.empty())
    look.source.fail("roughness-inside", "the body is a sheet, which has no inside",
                     "roughness is that of both of its sides");
}

// The first of the attributes that name a picture; null: there is none.
const char* named_picture(const LookSettings& look) {
  const auto first = [](const std::initializer_list<std::pair<const std::string*, const char*>>& all) {
    for (const auto& [file, attribute] : all)
      if (!file->empty()) return attribute;
    return static_cast<const char*>(nullptr);
  };
  return first({{&look.texture, "texture"},
                {&look.texture_back, "texture-back"},
                {&look.texture_inside, "texture-inside"},
                {&look.roughness, "roughness"},
                {&look.roughness_inside, "roughness-inside"}});
}

void check_use(const LookSettings& look) {
  // The sheet crosses the axis of the band: there its place at rest does not say which part of it is meant.
  const auto& sheet = look.frame.sheet;
  const bool crosses =
      sheet && sheet->closure == SheetClosure::Twist && (*sheet->size)[1] * pi > (*sheet->size)[0];
  const char* named = named_picture(look);
  for (const char* attribute : {"wrap", "scale", "rotate"})
    if (!named && look.source.given(attribute))
      look.source.fail(attribute, fmt::format("{} of <look> has no use without a texture", attribute),
                       "name a picture: texture=\"picture.png\"");
  if (named && crosses)
    look.source.fail(named, "a picture cannot lie on a twisted band that is this wide for its length",
                     "make it narrower than its length over pi");
  if (named && (look.as == DrawStyle::Exploded || look.as == DrawStyle::Darts))
    look.source.fail(named,
                     fmt::format("{} cannot be seen on a body that is shown as=\"{}\"", named,
                                 look.as == DrawStyle::Darts ? "darts" : "exploded"),
                     "leave it out, or show the body as=\"surface\" or \"wires\"");
  for (const char* attribute : {"roughness", "roughness-inside"})
    if (look.as == DrawStyle::Wires && look.source.given(attribute))
      look.source.fail(attribute, "lines have no gloss: roughness cannot be seen on a body shown as=\"wires\"",
                       "leave it out, or show the body as=\"surface\"");
}

} // namespace

double texture_aspect(const LookSettings& look, const std::string& attribute, const std::string& file) {
  const PictureInfo info = info_of(look, attribute, file);
  return static_cast<double>(info.width) / info.height;
}

void check_textures(const LookSettings& look, bool solid) {
  check_use(look);
  check_sides(look, solid);
  const std::string opaque = "save it without transparency";
  if (solid) {
    check_holes(look, "texture", look.texture, "and a solid has nothing behind its surface", opaque);
  } else if (!look.texture.empty()) {
    if (is_transparent(image_of(look, "texture", look.texture)) && look.thickness)
      look.source.fail("thickness", "the holes of a picture have no rim",
                       "leave the thickness out, or save the picture without transparency");
  }
  check_holes(look, "texture-back", look.texture_back, "but holes of a sheet are those of its texture", opaque);
  check_holes(look, "texture-inside", look.texture_inside, "and a solid has nothing behind its surface",
              opaque);
  for (const auto& [file, attribute] :
       {std::pair(&look.roughness, "roughness"), std::pair(&look.roughness_inside, "roughness-inside")})
    if (!file->empty()) image_of(look, attribute, *file);
}

std::shared_ptr<const Texture> TextureFiles::texture(const LookSettings& look, const std::string& attribute,
                                                     const std::string& file, Use use) {
  if (file.empty()) return nullptr;
  std::shared_ptr<const Texture>& texture = read_[{path_of(look, file), use}];
  if (texture) return texture;
  Image image = image_of(look, attribute, file);
  texture = use == Use::Numbers ? make_number_texture(image) : make_texture(std::move(image));
  return texture;
}

LookTextures TextureFiles::of(const LookSettings& look) {
  if (look.by != ColourBy::Plain) return {}; // they are not shown
  return {texture(look, "texture", look.texture), texture(look, "texture-back", look.texture_back),
          texture(look, "texture-inside", look.texture_inside),
          texture(look, "roughness", look.roughness, Use::Numbers),
          texture(look, "roughness-inside", look.roughness_inside, Use::Numbers)};
}

} // namespace rend
