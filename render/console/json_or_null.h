// A value that may not be there, in JSON: null.
#pragma once

#include <nlohmann/json.hpp>

#include <optional>

namespace rend {

template <class T> nlohmann::ordered_json json_or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json(nullptr);
}

} // namespace rend
