// The pictures that looks name, from their files.
//
// What is wrong with one is told at the attribute that names it. Its size is that of the header, and is asked
// before anything is decoded.
#pragma once

#include "render/draw/texture.h"
#include "render/picture/look.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace rend {

// Those of a body; null: none.
struct LookTextures {
  std::shared_ptr<const Texture> front, back, inside;
  std::shared_ptr<const Texture> roughness, roughness_inside; // numbers

  // By whose proportions those outside and inside lie; null: there is none.
  const Texture* leading() const { return (front ? front : back ? back : roughness).get(); }
  const Texture* leading_inside() const { return (inside ? inside : roughness_inside).get(); }
};

// What a look says of pictures, and the pictures themselves. solid: the body is. UserError (BadInput): a
// picture that the body has no side for, is drawn without, or that is no picture or too large; one with holes
// on anything but the front of a sheet. NoInput: there is no such file.
void check_textures(const LookSettings& look, bool solid);

// Width / height of a picture that a look names, by its header alone. UserError: what it is refused for.
double texture_aspect(const LookSettings& look, const std::string& attribute, const std::string& file);

// Reads files once, for as long as it lives.
class TextureFiles {
public:
  LookTextures of(const LookSettings& look); // UserError: what a file is refused for

private:
  enum class Use { Colours, Numbers };
  std::shared_ptr<const Texture> texture(const LookSettings& look, const std::string& attribute,
                                         const std::string& file, Use use = Use::Colours);
  std::map<std::pair<std::filesystem::path, Use>, std::shared_ptr<const Texture>> read_;
};

} // namespace rend
