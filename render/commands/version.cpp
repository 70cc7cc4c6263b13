#include "render/commands/version.h"

#include "render/draw/device.h"
#include "render/report/machine.h"
#include "sim/base/error.h"

#include <fmt/format.h>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <expat.h>
#include <nlohmann/json.hpp>
#include <oneapi/tbb/version.h>
#include <xxhash.h>
#ifdef REND_PNG
#include <libdeflate.h>
#include <png.h>
#endif
#ifdef REND_JPEG
#include <cstdio>

#include <jpeglib.h> // needs <cstdio> before
#endif
#ifdef REND_VIDEO
extern "C" {
#include <libavutil/avutil.h>
}
#endif
#ifdef REND_HUD
#include <imgui.h>
#endif

#include <utility>
#include <vector>

namespace rend {
namespace {

using Version = std::pair<const char*, std::string>;

std::string dotted(int number, int place) { // 90103, 100: "9.1.3"
  return fmt::format("{}.{}.{}", number / place / place, number / place % place, number % place);
}

// Mesa reports its version only once a context exists.
std::string renderer() {
  try {
    return make_device()->renderer();
  } catch (const UserError& error) {
    return error.what();
  }
}

std::vector<Version> libraries() {
  const XML_Expat_Version expat = XML_ExpatVersionInfo();
  std::vector<Version> all{
      {"CLI11", CLI11_VERSION},
      {"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"Expat", fmt::format("{}.{}.{}", expat.major, expat.minor, expat.micro)},
      {"fmt", dotted(FMT_VERSION, 100)},
      {"nlohmann_json", fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR,
                                    NLOHMANN_JSON_VERSION_PATCH)},
      {"oneTBB", TBB_runtime_version()},
      {"xxHash", dotted(XXH_VERSION_NUMBER, 100)}};
#ifdef REND_PNG
  all.push_back({"libpng", png_get_libpng_ver(nullptr)});
  all.push_back({"libdeflate", LIBDEFLATE_VERSION_STRING});
#endif
#ifdef REND_JPEG
  all.push_back({"libjpeg-turbo", dotted(LIBJPEG_TURBO_VERSION_NUMBER, 1000)});
#endif
#ifdef REND_VIDEO
  all.push_back({"FFmpeg", av_version_info()});
#endif
  all.push_back({"OpenGL", renderer()});
#ifdef REND_HUD
  all.push_back({"Dear ImGui", ImGui::GetVersion()});
#endif
  return all;
}

} // namespace

std::string version_in_words() {
  const Machine build = this_machine();
  std::string out = fmt::format("rend {} (commit {}{}{})\n", build.version, build.commit,
                                build.date.empty() ? "" : " of ", build.date);
  out += fmt::format("{:14}{}, {}\n", "compiler", build.compiler, build.flags);
  for (const auto& [name, version] : libraries()) out += fmt::format("{:14}{}\n", name, version);
  out.pop_back(); // CLI11 adds a line end itself
  return out;
}

} // namespace rend
