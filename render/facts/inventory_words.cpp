#include "render/console/console.h"
#include "render/facts/inventory.h"
#include "sim/base/printable.h"

#include <fmt/format.h>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

// Lines of at most 100 columns, the first after `head`, the others below its end.
std::string folded(const std::string& head, const std::string& words) {
  const std::string text = printable(words);
  constexpr std::size_t columns = 100;
  std::string out, line = head;
  bool bare = true; // nothing stands on the line yet
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find(' ', at), text.size());
    const std::string token = text.substr(at, end - at);
    if (!bare && line.size() + 1 + token.size() > columns) {
      out += line + '\n';
      line.assign(head.size(), ' ');
      bare = true;
    }
    line += (bare ? "" : " ") + token;
    bare = false;
    at = end + 1;
  }
  return out + line + '\n';
}

std::string text(const Json& json, const char* key) {
  return printable(json[key].get<std::string>());
}
std::size_t whole(const Json& json, const char* key) {
  return json[key].get<std::size_t>();
}
double real(const Json& json, const char* key) {
  return json[key].get<double>();
}

std::string time_in_words(const Json& time) {
  std::string step = fmt::format("{:.6g} s a step by {} (order {}, {} evaluation{})", real(time, "step"),
                                 text(time, "integrator"), whole(time, "order"), whole(time, "evaluations"),
                                 whole(time, "evaluations") == 1 ? "" : "s");
  if (text(time, "from") == "auto")
    step += text(time, "integrator") == "static" ? "; auto: all of the clip, one equilibrium"
                                                 : "; auto: 0.9 of the largest that is stable at rest";
  else
    step += "; given by the preset";
  if (time["limit"].is_null())
    step += "; nothing limits it";
  else if (real(time, "limit") > 0)
    step += fmt::format("; stable at rest: up to {:.3g} s", real(time, "limit"));
  else
    step += "; no step is stable";
  step += fmt::format(", from modes of at most {:.4g} rad/s, damped at most {:.4g}/s",
                      real(time["bounds"], "omega"), real(time["bounds"], "damping_rate"));
  return folded("time      ", step) +
         fmt::format("          {:.6g} s in {} steps; {} frames at {:g} a second\n", real(time, "duration"),
                     whole(time, "steps"), whole(time, "frames"), real(time, "fps"));
}

std::string orbit_in_words(const Json& json) {
  return text(json, "orbit") + " " + text(json, "links");
}

std::string tables_in_words(const Json& body) {
  std::string out = fmt::format("  {:<52}{:>22}{:>12}{:>12}\n", "orbits in use", "", "slots", "bytes");
  for (const Json& one : body["slots"])
    out +=
        fmt::format("    {:<72}{:>12}{:>12}\n", orbit_in_words(one), whole(one, "slots"), whole(one, "bytes"));
  out += fmt::format("  {:<40}{:<46}{:>12}\n", "embeddings", "on", "bytes");
  for (const Json& one : body["embeddings"])
    out += fmt::format("    {:<38}{:<46}{:>12}\n", text(one, "name"), orbit_in_words(one), whole(one, "bytes"));
  out += fmt::format("  {:<40}{:<34}{:>12}{:>12}\n", "interactions", "caused by", "rows", "bytes");
  for (const Json& one : body["interactions"]) {
    std::string label = text(one, "name");
    if (text(one, "rows_are") != "folded") label += fmt::format(" ({})", text(one, "rows_are"));
    out += fmt::format("    {:<38}{:<34}{:>12}{:>12}\n", label, orbit_in_words(one), whole(one, "rows"),
                       whole(one, "bytes"));
  }
  return out;
}

// Those that no other table has.
std::string arrays_in_words(const Json& arrays) {
  std::string out;
  for (const Json& one : arrays) {
    const std::string part = text(one, "part");
    if (part == "slots" || part == "embeddings" || part == "laws" || text(one, "name").starts_with("rows of "))
      continue;
    out +=
        fmt::format("    {:<38}{:<34}{:>24}\n", text(one, "name"),
                    part + (text(one, "per").empty() ? "" : ", per " + text(one, "per")), whole(one, "bytes"));
  }
  return out.empty() ? out : fmt::format("  {:<40}{:<34}{:>24}\n", "other arrays", "", "bytes") + out;
}

std::string bytes_by_part(const Json& bytes) {
  std::string out;
  for (const auto& [part, count] : bytes.items())
    if (part != "total") out += fmt::format("{} {}, ", part, bytes_in_words(count.get<std::size_t>()));
  return out + fmt::format("in all {}", bytes_in_words(whole(bytes, "total")));
}

std::string body_in_words(const Json& body) {
  std::string out = fmt::format("body {}: a {}\n", text(body, "name"), text(body, "kind"));
  out += fmt::format("  {} vertices, {} edges, {} elements, {} darts, {} fragment{}, Euler characteristic {}\n",
                     whole(body, "vertices"), whole(body, "edges"), whole(body, "elements"),
                     whole(body, "darts"), whole(body, "fragments"), whole(body, "fragments") == 1 ? "" : "s",
                     body["euler"].get<long>());
  if (whole(body, "prescribed") > 0)
    out += fmt::format("  {} vertices are prescribed\n", whole(body, "prescribed"));
  out += tables_in_words(body);
  if (!body["laws"].empty()) out += fmt::format("  {:<86}{:>12}\n", "laws", "bytes");
  for (const Json& law : body["laws"])
    out += fmt::format("    {:<84}{:>12}\n",
                       fmt::format("{} above {:g} {}: {}", text(law, "criterion"), real(law, "threshold"),
                                   text(law, "unit"), text(law, "change")),
                       whole(law, "bytes"));
  out += arrays_in_words(body["arrays"]);
  for (const Json& one : body["left_out"]) out += folded("  left out  ", one.get<std::string>());
  for (const Json& one : body["notes"]) out += folded("  note      ", one.get<std::string>());
  if (body.contains("solver")) {
    const Json& solver = body["solver"];
    out += fmt::format(
        "  solver    {} blocks; in the first step {} Newton iterations, {} of conjugate gradients, {} "
        "factorisations\n",
        whole(solver, "blocks"), whole(solver, "newton"), whole(solver, "cg"), whole(solver, "factorisations"));
  }
  return out + folded("  bytes     ", bytes_by_part(body["bytes"]));
}

std::string steps_in_words(const Json& passes) {
  std::string out = fmt::format("\n{:<72}{:>8}{:>20}\n", "a step, in this order", "times", "bytes each time");
  double whole_step = 0;
  std::string last;
  for (const Json& pass : passes) {
    const double times = real(pass, "times");
    const std::string stage = text(pass, "stage");
    whole_step += times * real(pass, "bytes");
    out += fmt::format("  {:<16}{:<36}{:>9} {:<9}{:>7g}{:>20}\n", stage == last ? "" : stage,
                       text(pass, "what"), whole(pass, "count"), text(pass, "of"), times, whole(pass, "bytes"));
    last = stage;
  }
  return out + fmt::format("  {:<78}{:>20}\n", "and in sum, each array counted once a pass",
                           bytes_in_words(static_cast<std::size_t>(whole_step)));
}

} // namespace

std::string inventory_in_words(const Json& inventory) {
  std::string out = text(inventory, "name");
  if (inventory.contains("thesis")) out += fmt::format(" (thesis, {})", text(inventory, "thesis"));
  out += '\n';
  out += time_in_words(inventory["time"]);
  for (const Json& body : inventory["bodies"]) out += fmt::format("\n{}", body_in_words(body));
  out += steps_in_words(inventory["step"]);
  if (!inventory["first_step"].is_null())
    out += folded("  note      ", "its arrays are as they were: " + text(inventory, "first_step"));
  out += "\n";
  out += arrays_in_words(inventory["arrays"]);
  for (const Json& one : inventory["left_out"]) out += folded("left out  ", one.get<std::string>());
  return out + fmt::format("total     {} bytes: {}\n", whole(inventory["bytes"], "total"),
                           bytes_in_words(whole(inventory["bytes"], "total")));
}

} // namespace rend
