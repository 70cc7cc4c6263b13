#include "render/console/json_text.h"

#include "sim/base/printable.h"

#include <nlohmann/json.hpp>

namespace rend {

std::string text_of(const nlohmann::ordered_json& json, int indent) {
  return printable_json(json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
}

} // namespace rend
