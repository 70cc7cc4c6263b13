#include "render/clip/printed_figures.h"

#include <nlohmann/json.hpp>

namespace rend {
namespace {

// None where the figure is null; throws where it is of another type, or not there.
template <class T> std::optional<T> read(const nlohmann::json& json, const char* name) {
  const nlohmann::json& value = json.at(name);
  return value.is_null() ? std::optional<T>() : std::optional<T>(value.get<T>());
}

} // namespace

std::optional<PrintedFigures> read_figures(const std::string& text) {
  try {
    const nlohmann::json json = nlohmann::json::parse(text);
    return PrintedFigures{.pictures = {json.value("frames", 0L), json.value("kept", 0L)},
                          .steps = read<long>(json, "steps"),
                          .time = read<double>(json, "time"),
                          .tears = read<std::size_t>(json, "tears"),
                          .hash = read<std::string>(json, "hash")};
  } catch (const nlohmann::json::exception&) {
    return {};
  }
}

} // namespace rend
