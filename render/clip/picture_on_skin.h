// The pictures of a scene as exports take them: their files, and where the corners of exported faces lie in
// them (texture_map.h). A body has one here where it is drawn with one: what texture-back shows is left out,
// since exported faces have one side.
#pragma once

#include "render/picture/picture_settings.h"
#include "sim/export/skin_picture.h"
#include "sim/scene/scene.h"

#include <filesystem>

namespace rend {

// Before the first step. folder: of the exported files, to which files of pictures are relative then. Empty
// where no body has a picture. The scene must outlive it. UserError: as TextureFiles::of.
SkinPictures pictures_on_skin(const PictureSettings& settings, const Scene& scene,
                              const std::filesystem::path& folder);

} // namespace rend
