// What a scene is made of, to be read.
#include "render/console/console.h"
#include "render/facts/inventory.h"
#include "sim/base/printable.h"

#include <fmt/format.h>

namespace rend {
namespace {

// Lines of at most 100 columns, the first after `head`, the others below its end.
std::string folded(const std::string& head, const std::string& words) {
  const std::string text = printable(words);
  constexpr std::size_t columns = 100;
  std::string out, line = head;
  bool bare = true; // the line is still empty
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

std::string folded_lines(const std::string& head, const std::vector<std::string>& all) {
  std::string out;
  for (const std::string& one : all) out += folded(head, one);
  return out;
}

std::string time_in_words(const TimeFacts& time) {
  std::string step =
      fmt::format("{:.6g} s a step by {} (order {}, {} evaluation{})", time.step, time.integrator, time.order,
                  time.evaluations, time.evaluations == 1 ? "" : "s");
  if (!time.automatic)
    step += "; given by the preset";
  else if (time.integrator == "static")
    step += "; auto: all of the clip, one equilibrium";
  else
    step += "; auto: 0.9 of the largest that is stable at rest";
  if (!time.limit)
    step += "; nothing limits it";
  else if (*time.limit > 0)
    step += fmt::format("; stable at rest: up to {:.3g} s", *time.limit);
  else
    step += "; no step is stable";
  step += fmt::format(", from modes of at most {:.4g} rad/s, damped at most {:.4g}/s", time.omega,
                      time.damping_rate);
  return folded("time      ", step) + (time.cause.empty() ? "" : folded("          ", time.cause)) +
         fmt::format("          {:.6g} s in {} steps; {} frames at {:g} a second{}\n", time.duration,
                     time.steps, time.frames, time.fps,
                     time.clip_duration ? fmt::format(", a clip of {:.6g} s", *time.clip_duration) : "");
}

std::string orbit_in_words(Orbit orbit) {
  return std::string(name(orbit)) + " " + to_string(orbit);
}

std::string tables_in_words(const BodyFacts& body) {
  std::string out = fmt::format("  {:<52}{:>22}{:>12}{:>12}\n", "orbits in use", "", "slots", "bytes");
  for (const SlotFacts& one : body.slots)
    out += fmt::format("    {:<72}{:>12}{:>12}\n", orbit_in_words(one.orbit), one.slots, one.bytes);
  out += fmt::format("  {:<40}{:<46}{:>12}\n", "embeddings", "on", "bytes");
  for (const EmbeddingFacts& one : body.embeddings)
    out += fmt::format("    {:<38}{:<46}{:>12}\n", printable(one.name), orbit_in_words(one.orbit), one.bytes);
  out += fmt::format("  {:<40}{:<34}{:>12}{:>12}\n", "interactions", "caused by", "rows", "bytes");
  for (const InteractionFacts& one : body.interactions) {
    std::string label = printable(one.name);
    if (one.rows_are != RowsAre::Folded) label += fmt::format(" ({})", name_of(one.rows_are));
    out += fmt::format("    {:<38}{:<34}{:>12}{:>12}\n", label, orbit_in_words(one.owner), one.rows, one.bytes);
  }
  return out;
}

std::string laws_in_words(const std::vector<LawFacts>& laws) {
  std::string out = laws.empty() ? "" : fmt::format("  {:<86}{:>12}\n", "laws", "bytes");
  for (const LawFacts& law : laws)
    out += fmt::format("    {:<84}{:>12}\n",
                       fmt::format("{} above {:g} {}: {}", printable(law.criterion), law.threshold,
                                   printable(law.unit), printable(law.change)),
                       law.bytes);
  return out;
}

// Those that no other table has.
std::string arrays_in_words(const std::vector<MemoryEntry>& arrays) {
  std::string out;
  for (const MemoryEntry& one : arrays) {
    const std::string &part = one.part, name = printable(one.name);
    if (part == "slots" || part == "embeddings" || part == "laws" || name.starts_with("rows of ")) continue;
    out += fmt::format("    {:<38}{:<34}{:>24}\n", name,
                       printable(part + (one.per.empty() ? "" : ", per " + one.per)), one.bytes);
  }
  return out.empty() ? out : fmt::format("  {:<40}{:<34}{:>24}\n", "other arrays", "", "bytes") + out;
}

std::string parts_in_words(const BytesByPart& bytes) {
  std::string out;
  for (const auto& [part, count] : bytes.parts) out += fmt::format("{} {}, ", part, bytes_in_words(count));
  return out + fmt::format("in all {}", bytes_in_words(bytes.total));
}

std::string rules_in_words(const std::vector<AppliedRule>& rules) {
  std::string out =
      rules.empty() ? "" : fmt::format("  {:<66}{:>12}{:>20}\n", "rules", "line", "applied at places");
  for (const AppliedRule& one : rules)
    out += fmt::format("    {:<64}{:>12}{:>20}\n", printable(one.rule), one.line, one.applied);
  return out;
}

std::string body_in_words(const BodyFacts& body) {
  std::string out =
      fmt::format("body {}: a {}\n", printable(body.name), body.dimension == 2 ? "sheet" : "solid");
  out += fmt::format("  {} vertices, {} edges, {} elements, {} darts, {} fragment{}, Euler characteristic {}\n",
                     body.vertices, body.edges, body.elements, body.darts, body.fragments,
                     body.fragments == 1 ? "" : "s", body.euler);
  if (body.prescribed > 0) out += fmt::format("  {} vertices are prescribed\n", body.prescribed);
  out += rules_in_words(body.applied) + tables_in_words(body) + laws_in_words(body.laws) +
         arrays_in_words(body.arrays);
  out += folded_lines("  left out  ", body.left_out) + folded_lines("  note      ", body.notes);
  if (body.solver)
    out += fmt::format(
        "  solver    {} blocks; in the first step {} Newton iterations, {} of conjugate gradients, {} "
        "factorisations\n",
        body.solver->blocks, body.solver->all.newton, body.solver->all.cg, body.solver->all.factorisations);
  return out + folded("  bytes     ", parts_in_words(body.bytes));
}

} // namespace

std::string inventory_in_words(const Inventory& inventory) {
  std::string out = printable(inventory.name);
  if (inventory.thesis) out += fmt::format(" (thesis, {})", printable(*inventory.thesis));
  out += '\n';
  out += time_in_words(inventory.time);
  for (const BodyFacts& body : inventory.bodies) out += fmt::format("\n{}", body_in_words(body));
  out += passes_in_words(inventory.step);
  if (inventory.first_step)
    out += folded("  note      ", "its arrays are as they were: " + printable(*inventory.first_step));
  out += "\n";
  out += arrays_in_words(inventory.arrays) + folded_lines("left out  ", inventory.left_out);
  return out +
         fmt::format("total     {} bytes: {}\n", inventory.bytes.total, bytes_in_words(inventory.bytes.total));
}

} // namespace rend
