#ifdef REND_VIDEO
#include "render/files/libav.h"

#include "sim/base/error.h"

namespace rend {

void check_av(int result, const std::filesystem::path& file, const char* doing) {
  if (result >= 0) return;
  // Encoders and filters below libav return these codes when they get no memory or no threads; their arguments
  // are known to be valid here.
  const bool out_of_room = result == AVERROR(ENOMEM) || result == AVERROR(EAGAIN) || result == AVERROR_EXTERNAL;
  if (out_of_room)
    throw UserError(Exit::OutOfBudget, {file.string()},
                    std::string(doing) +
                        " failed: there is not enough memory, or a thread could not be started",
                    "make smaller pictures, or allow more memory (ulimit -v) and threads (ulimit -u)");
  std::array<char, AV_ERROR_MAX_STRING_SIZE> text{};
  av_strerror(result, text.data(), text.size());
  throw UserError(Exit::ReadWrite, {file.string()}, std::string(doing) + " failed: " + text.data() + ".");
}

AvOptions::AvOptions(const std::vector<std::pair<std::string, std::string>>& options) {
  for (const auto& [name, value] : options) av_dict_set(&dictionary_, name.c_str(), value.c_str(), 0);
}

} // namespace rend

#endif
