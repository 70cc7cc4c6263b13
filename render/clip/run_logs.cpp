#include "render/clip/run_logs.h"

#include "render/console/json_text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <vector>

namespace rend {
namespace {

using Json = nlohmann::ordered_json;

void write_text(OutputFile& file, const std::string& text) {
  file.write({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
}

void commit(OutputFile& file) {
  file.commit();
  sync_folder(file.path().parent_path());
}

std::string header_of(const Scene& scene) {
  std::string header =
      "frame,step,time,kinetic,elastic,gravity,work,dissipated,balance,momentum_x,momentum_y,momentum_z,"
      "angular_momentum_x,angular_momentum_y,angular_momentum_z,tears,fragments";
  for (const auto& body : scene.bodies())
    for (const Probe& probe : body->probes)
      for (const char* what : {"x", "y", "z", "dx", "dy", "dz", "reaction_x", "reaction_y", "reaction_z"})
        header += fmt::format(",{}_{}", probe.name(), what);
  return header + "\n";
}

std::string cells_of(const std::optional<Vec3>& v) {
  return v ? fmt::format(",{},{},{}", v->x(), v->y(), v->z()) : ",,,";
}

std::string probe_cells(const Scene& scene) {
  std::string cells;
  for (const auto& body : scene.bodies()) {
    for (const Probe& probe : body->probes) {
      const auto reading = probe.read(*body);
      cells += reading
                   ? cells_of(reading->position) + cells_of(reading->displacement) + cells_of(reading->reaction)
                   : std::string(9, ',');
    }
  }
  return cells;
}

} // namespace

Diagnostics::Diagnostics(const std::filesystem::path& path) : file_(path) {}

void Diagnostics::add(long frame, const Scene& scene) {
  flush();
  if (!any_ && text_.empty()) text_ = header_of(scene);
  const EnergyFigures e = scene.energy();
  const Vec3 p = scene.momentum(), l = scene.angular_momentum();
  // {} of a double gives the shortest text that reads back as the same number.
  held_ = fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}{}\n", frame, scene.steps_done(),
                      scene.time(), e.now.kinetic, e.now.elastic, e.now.gravity, e.now.work.sum(), e.dissipated,
                      e.balance, p.x(), p.y(), p.z(), l.x(), l.y(), l.z(), scene.tears(), scene.fragments(),
                      probe_cells(scene));
}

void Diagnostics::flush() {
  any_ = any_ || !held_.empty();
  text_ += held_;
  held_.clear();
  constexpr std::size_t enough = 1 << 16;
  if (text_.size() < enough) return;
  write_text(file_, text_);
  text_.clear();
}

void Diagnostics::finish() {
  flush();
  write_text(file_, text_);
  commit(file_);
}

void Diagnostics::abandon() {
  held_.clear();
  if (any_) finish();
}

EventFile::EventFile(const std::filesystem::path& path) : file_(path) {}

void EventFile::write(const Scene& scene) {
  struct Entry {
    const Body* body;
    const TearEvent* event;
  };
  std::vector<Entry> entries;
  for (const auto& body : scene.bodies())
    for (const TearEvent& event : body->events) entries.push_back({body.get(), &event});
  std::stable_sort(entries.begin(), entries.end(),
                   [](const Entry& a, const Entry& b) { return a.event->step < b.event->step; });
  std::string text;
  for (const auto& [body, event] : entries) {
    const LawSettings& law = body->tear_laws[static_cast<std::size_t>(event->law)].settings();
    const Json line{{"time", event->time},
                    {"step", event->step},
                    {"body", body->name},
                    {"criterion", law.criterion->name},
                    {"kind", law.kind.empty() ? Json(nullptr) : Json(law.kind)},
                    {"value", event->value},
                    {"threshold", law.threshold},
                    {"unit", law.unit},
                    {"change", law.change->name},
                    {"cell", name_of(law.cell, body->map->dimension())},
                    {"dart", event->dart.value},
                    {"position", {event->place.x(), event->place.y(), event->place.z()}},
                    {"fragments", event->fragments},
                    {"born", event->born}};
    text += text_of(line) + "\n";
  }
  write_text(file_, text);
  commit(file_);
}

} // namespace rend
