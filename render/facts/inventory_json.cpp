// What a scene is made of, as JSON.
#include "render/console/json_or_null.h"
#include "render/facts/inventory.h"

#include <nlohmann/json.hpp>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const TimeFacts& time) {
  Json out = {{"integrator", time.integrator},
              {"order", time.order},
              {"evaluations", time.evaluations},
              {"step", time.step},
              {"from", time.automatic ? "auto" : "preset"},
              {"limit", json_or_null(time.limit)},
              {"limited_by", time.cause.empty() ? Json(nullptr) : Json(time.cause)},
              {"bounds", {{"omega", time.omega}, {"damping_rate", time.damping_rate}}},
              {"duration", time.duration},
              {"steps", time.steps},
              {"fps", time.fps},
              {"frames", time.frames}};
  if (time.clip_duration) out["clip_duration"] = *time.clip_duration;
  return out;
}

Json json_of(const SlotFacts& one) {
  return {
      {"orbit", name(one.orbit)}, {"links", to_string(one.orbit)}, {"slots", one.slots}, {"bytes", one.bytes}};
}

Json json_of(const EmbeddingFacts& one) {
  return {
      {"name", one.name}, {"orbit", name(one.orbit)}, {"links", to_string(one.orbit)}, {"bytes", one.bytes}};
}

Json json_of(const InteractionFacts& one) {
  return {{"name", one.name},         {"rows_are", name_of(one.rows_are)},
          {"orbit", name(one.owner)}, {"links", to_string(one.owner)},
          {"rows", one.rows},         {"bytes", one.bytes}};
}

Json json_of(const LawFacts& law) {
  return {{"criterion", law.criterion}, {"what", law.what},     {"threshold", law.threshold},
          {"unit", law.unit},           {"change", law.change}, {"bytes", law.bytes}};
}

Json json_of(const AppliedRule& one) {
  return {{"rule", one.rule}, {"line", one.line}, {"applied", one.applied}, {"skipped", one.skipped}};
}

Json json_of(const MemoryEntry& one) {
  return {{"part", one.part}, {"name", one.name}, {"per", one.per}, {"bytes", one.bytes}};
}

Json json_of(const BytesByPart& bytes) {
  Json json = Json::object();
  for (const auto& [part, count] : bytes.parts) json[part] = count;
  json["total"] = bytes.total;
  return json;
}

Json json_of(const BodyFacts& body);

template <class T> Json list_of(const std::vector<T>& all) {
  Json list = Json::array();
  for (const T& one : all) list.push_back(json_of(one));
  return list;
}

Json json_of(const BodyFacts& body) {
  Json json{{"name", body.name},
            {"kind", body.dimension == 2 ? "sheet" : "solid"},
            {"applied", list_of(body.applied)},
            {"vertices", body.vertices},
            {"edges", body.edges},
            {"elements", body.elements},
            {"darts", body.darts},
            {"fragments", body.fragments},
            {"euler", body.euler},
            {"prescribed", body.prescribed},
            {"slots", list_of(body.slots)},
            {"embeddings", list_of(body.embeddings)},
            {"interactions", list_of(body.interactions)},
            {"laws", list_of(body.laws)},
            {"arrays", list_of(body.arrays)},
            {"bytes", json_of(body.bytes)},
            {"left_out", body.left_out},
            {"notes", body.notes}};
  if (body.solver)
    json["solver"] = {{"blocks", body.solver->blocks},
                      {"newton", body.solver->all.newton},
                      {"cg", body.solver->all.cg},
                      {"factorisations", body.solver->all.factorisations}};
  return json;
}

} // namespace

Json json_of(const Inventory& inventory) {
  Json json{{"preset", inventory.preset}, {"name", inventory.name}};
  if (inventory.thesis) json["thesis"] = *inventory.thesis;
  json["time"] = json_of(inventory.time);
  json["first_step"] = json_or_null(inventory.first_step);
  json["arrays"] = list_of(inventory.arrays);
  json["bodies"] = list_of(inventory.bodies);
  json["bytes"] = json_of(inventory.bytes);
  json["step"] = json_of(inventory.step);
  json["left_out"] = inventory.left_out;
  return json;
}

} // namespace rend
