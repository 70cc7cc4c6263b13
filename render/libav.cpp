#ifdef REND_VIDEO
#include "render/libav.h"

#include "sim/base/error.h"

namespace rend {

void must_av(int result, const std::filesystem::path& file, const char* doing) {
  if (result >= 0) return;
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(result, text.data(), text.size());
  throw UserError(Exit::ReadWrite, {file.string()}, std::string(doing) + " failed: " + text.data() + ".");
}

AvOptions::AvOptions(const std::vector<std::pair<std::string, std::string>>& options) {
  for (const auto& [name, value] : options) av_dict_set(&dictionary_, name.c_str(), value.c_str(), 0);
}

} // namespace rend

#endif
