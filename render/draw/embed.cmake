# Writes OUTPUT, a C++ file with the contents of FILES (separated by commas) as raw strings: shader_source().
# cmake -DFILES=a,b -DOUTPUT=... -P embed.cmake
string(REPLACE "," ";" FILES "${FILES}")
set(rows "")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(APPEND rows "    {\"${name}\", R\"glsl(${text})glsl\"},\n")
endforeach()
list(LENGTH FILES count)
file(WRITE ${OUTPUT} "// Written by render/draw/embed.cmake out of shaders/.
#include \"render/draw/shaders.h\"

#include \"sim/base/check.h\"

#include <array>
#include <string>
#include <utility>

namespace rend {

std::string_view shader_source(std::string_view name) {
  static constexpr std::array<std::pair<std::string_view, std::string_view>, ${count}> texts{{
${rows}  }};
  for (const auto& [file, text] : texts)
    if (file == name) return text;
  CHECK_NOTE(false, std::string(name));
  return {};
}

} // namespace rend
")
