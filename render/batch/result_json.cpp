#include "render/batch/result_json.h"

#include "render/console/json_or_null.h"

#include <nlohmann/json.hpp>

namespace rend {

using Json = nlohmann::ordered_json;

Json line_of(const BatchJob& job, const BatchResult& result) {
  Json line{{"job", job.name},           {"preset", job.preset},
            {"set", job.sets},           {"state", name_of(result.state())},
            {"code", result.code},       {"tries", result.tries},
            {"seconds", result.seconds}, {"peak_bytes", result.peak}};
  if (const auto& figures = result.figures) {
    line["frames"] = figures->pictures.made;
    line["kept"] = figures->pictures.kept;
    line["steps"] = json_or_null(figures->steps);
    line["time"] = json_or_null(figures->time);
    line["tears"] = json_or_null(figures->tears);
    line["hash"] = json_or_null(figures->hash);
  }
  if (!result.message.empty()) line["message"] = result.message;
  return line;
}

Json stored_result(const BatchJob& job, const BatchResult& result) {
  Json out = line_of(job, result);
  out["ran"] = result.ran;
  out["log"] = result.log;
  out["printed"] = result.printed;
  return out;
}

BatchJob job_from(const Json& json) {
  return {json.at("job").get<std::string>(), json.at("preset").get<std::string>(),
          json.at("set").get<std::vector<std::string>>()};
}

BatchResult result_from(const Json& json) {
  BatchResult out;
  out.ran = json.at("ran").get<bool>();
  out.tries = json.at("tries").get<int>();
  out.code = json.at("code").get<int>();
  out.seconds = json.at("seconds").get<double>();
  out.peak = json.at("peak_bytes").get<std::size_t>();
  out.log = json.at("log").get<std::string>();
  out.printed = json.at("printed").get<std::string>();
  out.message = json.value("message", "");
  out.figures = read_figures(out.printed);
  return out;
}

} // namespace rend
