// The texts of shaders/, embedded when rend is built (render/draw/embed.cmake), so that the program is one
// file.
#pragma once

#include <string_view>

namespace rend {

// The source of a file of shaders/, such as "body.frag". CHECK that there is one of that name.
std::string_view shader_source(std::string_view name);

} // namespace rend
