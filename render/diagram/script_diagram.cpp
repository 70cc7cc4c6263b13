#include "render/diagram/script_diagram.h"

#include "render/diagram/diagram_parts.h"
#include "sim/rules/script_run.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

constexpr std::size_t most_stages = 5, most_darts = 400;

// A law that has looked at the sample.
class PlaneAcrossX final : public RuleQuantities {
public:
  PlaneAcrossX() { across = Vec3(1, 0, 0); }
  double stress(const Edit&, Dart, Of) override { throw ExpressionError(1, "a drawing knows no stress"); }
  double strain(const Edit&, Dart, Of) override { throw ExpressionError(1, "a drawing knows no strain"); }
};

// How many darts the script has used in a map, by its first steps; 0: it does not apply.
std::size_t run(const Script& script, EmbeddedMap& map, const Hooks& hooks) {
  PlaneAcrossX law;
  ScriptRunner runner(script, {.quantities = script.quantities_of_law().empty() ? nullptr : &law});
  bool applied = false;
  map.edit([&](Edit& edit) { applied = runner.apply(edit, hooks); });
  return applied ? runner.used().size() : 0;
}

// The script up to a step.
Script beginning_of(const Script& script, std::size_t steps) {
  ScriptSettings settings = script.settings;
  settings.steps.resize(steps);
  std::size_t next = 0;
  return Script(std::move(settings), [&](const ScriptStepSettings&) { return script.steps[next++].what; });
}

// The dart at which most changes; none: it applies nowhere.
std::optional<Hooks> best_hook(const Script& script, const SampleMap& sample) {
  if (!script.has_hook()) return run(script, *sample.make(), {}) > 0 ? std::optional(Hooks()) : std::nullopt;
  const auto original = sample.make();
  std::optional<Hooks> best;
  std::size_t most = 0;
  std::vector<bool> tried(original->map().capacity());
  for (std::uint32_t n = 0; n < std::min(original->map().capacity(), most_darts); ++n) {
    if (!original->map().alive(Dart{n}) || tried[n]) continue;
    for (Dart d : darts_of(original->map(), script.hook_orbit(), Dart{n})) tried[d.value] = true;
    const auto map = sample.make();
    const std::size_t used = run(script, *map, Dart{n});
    if (used > most) best = Hooks(Dart{n});
    most = std::max(most, used);
  }
  return best;
}

ScriptShown shown_on(const Script& script, const SampleMap& sample, const Hooks& hooks) {
  ScriptShown shown;
  shown.sample = &sample;
  shown.stages.push_back(sample.make());
  const std::size_t steps = script.steps.size();
  for (std::size_t n = steps < most_stages ? 1 : steps; n <= steps; ++n) {
    shown.stages.push_back(sample.make());
    run(beginning_of(script, n), *shown.stages.back(), hooks); // early steps may apply nowhere
  }
  shown.hook.assign(hooks.span().begin(), hooks.span().end());
  return shown;
}

} // namespace

ScriptShown show(const Script& script, const std::string& sample) {
  for (const std::string& name : script.quantities_of_law())
    if (name != "across" && name != "time") return {};
  std::vector<const SampleMap*> order = samples_called(sample);
  const int dimension = script.fits_sheets() ? 2 : 3;
  const auto misfits = [&](const SampleMap* each) {
    return (each->make()->dimension() != dimension ? 2 : 0) + (each->apart ? 1 : 0);
  };
  std::stable_sort(order.begin(), order.end(),
                   [&](const SampleMap* a, const SampleMap* b) { return misfits(a) < misfits(b); });
  for (const SampleMap* each : order)
    if (const std::optional<Hooks> hooks = best_hook(script, *each)) return shown_on(script, *each, *hooks);
  return {};
}

std::string step_in_words(const Script& script, std::size_t step) {
  using Which = ScriptStepSettings::Which;
  using AtLeast = ScriptStepSettings::AtLeast;
  const ScriptStepSettings& settings = script.settings.steps[step];
  std::string words = fmt::format("{}. ", step + 1);
  if (!settings.each.empty())
    words += fmt::format("at each {}{}", settings.each,
                         settings.which == Which::Old   ? " from before"
                         : settings.which == Which::New ? " that it has made"
                                                        : "");
  if (!settings.test.empty()) words += " where " + settings.test;
  words += (settings.each.empty() && settings.test.empty() ? "" : ": ") + settings.apply;
  if (settings.at_least == AtLeast::None) words += ", wherever it applies";
  if (settings.at_least == AtLeast::One) words += ", at one of them at least";
  return words;
}

Drawing diagram_of(const Script& script, const ScriptShown& shown) {
  const std::size_t maps = std::max<std::size_t>(shown.stages.size(), 2);
  Drawing page;
  page.width = std::max(diagram::width_of_maps(maps) + 40, diagram::width_of_heading(script.name()));
  double y = diagram::add_heading(page, script.name(), script.settings.about);
  if (script.has_hook()) {
    page.parts.push_back(DrawnText{{20, y + 6}, "hook " + script.settings.hook, 12, diagram::text_ink});
    y += 20;
  }
  constexpr std::size_t most_steps = 40; // told in words
  for (std::size_t n = 0; n < std::min(script.steps.size(), most_steps); ++n)
    for (const std::string& line : in_lines(step_in_words(script, n), 12, page.width - 40)) {
      page.parts.push_back(DrawnText{{20, y + 6}, line, 12, diagram::text_ink});
      y += 18;
    }
  y += 10;
  if (shown.sample) {
    std::vector<const EmbeddedMap*> stages;
    for (const auto& each : shown.stages) stages.push_back(each.get());
    y = diagram::add_maps(page, stages, shown.hook, y);
    const bool each_step = shown.stages.size() == script.steps.size() + 1;
    diagram::add_caption(page,
                         "on " + shown.sample->what + (each_step ? "; after each step" : "; before and after") +
                             (shown.hook.empty() ? "" : "; orange: the hook"),
                         y);
    y += 14;
  }
  page.height = y + 12;
  return page;
}

} // namespace rend
