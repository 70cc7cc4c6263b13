#include "render/studies/study_options.h"

#include "render/console/number_option.h"
#include "render/help/usage.h"
#include "render/picture/mask_file.h"
#include "sim/build/build_scene.h"
#include "sim/preset/paths.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

namespace rend {
namespace {

[[noreturn]] void refuse(const std::string& option, const std::string& what, const std::string& hint) {
  throw UserError(Exit::Usage, {option}, what, hint);
}

std::vector<std::string> split(const std::string& text, const std::string& option) {
  std::vector<std::string> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(',', at), text.size());
    parts.push_back(text.substr(at, end - at));
    if (parts.back().empty()) refuse(option, "a value is missing between commas", "write a,b,c without blanks");
    if (std::find(parts.begin(), parts.end() - 1, parts.back()) != parts.end() - 1)
      refuse(option, in_quotes(parts.back()) + " is there twice", "name each once");
    at = end + 1;
  }
  return parts;
}

// Schemes that step in time: a static solve has no error against step size.
std::vector<std::string> schemes_that_move() {
  std::vector<std::string> names;
  for (const Scheme& scheme : all_schemes())
    if (scheme.name != "static") names.push_back(scheme.name);
  return names;
}

std::vector<std::string> integrators_of(const StudyOptions& options) {
  const std::vector<std::string> all = schemes_that_move();
  if (options.integrators.empty()) return all;
  const std::string option = "--integrators " + options.integrators;
  std::vector<std::string> chosen = split(options.integrators, option);
  for (const std::string& name : chosen) {
    if (name == "static")
      refuse(option, "'static' has no time steps to study",
             "study " + listed(all) + "; how a static answer depends on the mesh, 'rend run' tells");
    if (std::find(all.begin(), all.end(), name) == all.end())
      refuse(option, "there is no integrator " + in_quotes(name), suggestion(name, all, "there are"));
  }
  return chosen;
}

// The values of one dimension of the sweep.
using Values = std::vector<StudyGroup>;

Values values_of_sweep(const std::string& sweep) {
  const std::string option = "--sweep " + sweep;
  Override all;
  try {
    all = parse_override(sweep);
  } catch (const UserError&) {
    refuse(option, "there is no '=' in it",
           "write --sweep PATH=a,b,c, such as body.elasticity.rotation=polar,qr");
  }
  if (all.path == "time.step" || all.path == "time.integrator" || all.path == "time.tolerance")
    refuse(option, all.path + " is swept in any case", "choose with --integrators and --steps");
  Values values;
  for (const std::string& value : split(all.value, option))
    values.push_back({all.path + "=" + value, {{all.path, value}}});
  return values;
}

std::string multiplied(const std::vector<double>& cells, int factor) {
  std::string out;
  for (double n : cells) {
    if (!out.empty()) out += ' ';
    out += std::to_string(static_cast<long>(n) * factor);
  }
  return out;
}

// The override that refines a body's mesh by a factor: more cells of its generator. A mesh from a file has
// none.
Setting refinement_of(const PresetNode& body, std::size_t number, int factor, const std::string& option) {
  for (const char* shape : {"sheet", "bar", "tube"})
    if (const PresetNode* node = body.child(shape))
      return {fmt::format("body[{}].{}.cells", number, shape), multiplied(node->integers("cells"), factor)};
  refuse(option, fmt::format("the mesh of body {} comes from a file, and cannot be made finer", number),
         "a <sheet>, <bar> or <tube> can; or study presets with coarser and finer files one by one");
}

Values values_of_refine(const PresetNode& preset, const std::string& refine) {
  const std::string option = "--refine " + refine;
  Values values;
  for (const std::string& text : split(refine, option)) {
    int factor = 0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), factor);
    if (read.ec != std::errc() || read.ptr != text.data() + text.size() || factor < 1 || factor > 64)
      refuse(option, in_quotes(text) + " is not a factor", "whole numbers from 1 to 64, such as 1,2,4");
    StudyGroup group{fmt::format("mesh × {}", factor), {}};
    const auto bodies = preset.all("body");
    if (factor > 1)
      for (std::size_t n = 0; n < bodies.size(); ++n)
        group.settings.push_back(refinement_of(*bodies[n], n + 1, factor, option));
    values.push_back(std::move(group));
  }
  std::reverse(values.begin(), values.end()); // the finest mesh is the most exact
  return values;
}

std::vector<StudyGroup> crossed(const std::vector<Values>& dimensions) {
  std::vector<StudyGroup> groups{{}};
  for (const Values& values : dimensions) {
    std::vector<StudyGroup> next;
    for (const StudyGroup& group : groups) {
      for (const StudyGroup& value : values) {
        StudyGroup both = group;
        if (!both.name.empty()) both.name += ", ";
        both.name += value.name;
        both.settings.insert(both.settings.end(), value.settings.begin(), value.settings.end());
        next.push_back(std::move(both));
      }
    }
    groups = std::move(next);
  }
  return groups;
}

// The preset's text when the study began: later edits of the file have no effect.
struct Source {
  std::string preset, text;
  std::vector<Override> overrides;
  bool allow_path = false;

  std::unique_ptr<PresetNode> load(const Variant& variant) const {
    std::vector<Override> all = overrides;
    for (const Setting& setting : variant.settings) all.push_back({setting.path, setting.value});
    if (!variant.integrator.empty()) all.push_back({"time.integrator", variant.integrator});
    if (variant.step > 0) all.push_back({"time.step", fmt::format("{:.17g}", variant.step)});
    if (variant.tolerance) all.push_back({"time.tolerance", fmt::format("{:.17g}", *variant.tolerance)});
    std::unique_ptr<PresetNode> node = load_scene_text(text, preset, all);
    if (!allow_path) check_paths(*node);
    return node;
  }
};

// A scene together with the preset that it refers to, destroyed in the right order.
std::shared_ptr<Scene> build(const Source& source, const Variant& variant) {
  std::shared_ptr<PresetNode> node = source.load(variant);
  SceneOptions options;
  options.guard = false; // too large a step must show as such
  return {new Scene(read_scene(*node, {.is_textured = {}, .read_mask = read_mask}), options),
          [node](const Scene* scene) { delete scene; }};
}

} // namespace

void declare_study(const CommandLine& app, StudyOptions& options) {
  add_preset_options(app, options.session);
  app.option("preset").required(false); // --lean has built-in scenes
  app.add_option("further", options.further, "more presets; only with --lean").type_name("PRESET...");
  app.add_option("-o,--output", options.folder, "folder for page, plots and tables; default: out/SCENE-study")
      .type_name("DIR");
  app.add_option("--integrators", options.integrators,
                 "time schemes to compare, separated by commas; default: all but static")
      .type_name(choices(schemes_that_move()) + ",...");
  app.add_option(
         "--steps", options.steps,
         "number of time steps to try for each scheme, from its largest stable one down to a hundredth of it")
      .type_name("N")
      .show_default()
      .transform(whole_number(3, 64));
  app.add_option("--duration", options.duration,
                 "how much of the clip is simulated; default: chosen for the scene, about 0.2 s")
      .type_name("SECONDS")
      .transform(real_number(1e-12, 1e9));
  app.add_option("--refine", options.refine, "also study finer sheets, bars and tubes; factors such as 1,2,4")
      .type_name("a,b,c")
      .check(some_word());
  app.add_option("--sweep", options.sweeps, "also study these values of an attribute (can be repeated)")
      .type_name("PATH=a,b,c")
      .allow_extra_args(false);
  app.add_option("--reruns", options.reruns, "timed runs of each case; fewer if one takes over a second")
      .type_name("N")
      .show_default()
      .transform(whole_number(1, 1000));
  app.add_flag("--quick", options.quick, "quicker and less exact: four steps of each scheme, three timed runs");
  app.add_flag("--lean", options.lean,
               "instead of schemes, measure what each feature of rend costs in time, bytes and pixels, on "
               "built-in scenes or on the presets");
  app.add_flag("--json", options.json, "print all numbers as one JSON object on stdout");
  app.add_flag("-q,--quiet", options.session.quiet, "print no progress");
}

StudyTask study_task(const StudyOptions& options) {
  Source source{
      options.session.preset, read_preset_file(options.session.preset), {}, options.session.allow_path};
  for (const std::string& set : options.session.sets) source.overrides.push_back(parse_override(set));
  StudyTask task;
  task.text = source.text;
  task.plan.integrators = integrators_of(options);
  const std::unique_ptr<PresetNode> preset = source.load({});
  task.name = preset->text("name");
  std::vector<Values> dimensions;
  if (!options.refine.empty()) dimensions.push_back(values_of_refine(*preset, options.refine));
  for (const std::string& sweep : options.sweeps) dimensions.push_back(values_of_sweep(sweep));
  task.plan.groups = crossed(dimensions);
  task.plan.steps = options.quick ? std::min(4, options.steps) : options.steps;
  task.plan.reruns = options.quick ? std::min(3, options.reruns) : options.reruns;
  task.plan.duration = options.duration.value_or(0);
  task.make = [source](const Variant& variant) { return build(source, variant); };
  for (const StudyGroup& group : task.plan.groups) {
    const auto scene = task.make({"", 0, {}, group.settings}); // reports errors in it now
    if (options.duration && *options.duration > scene->duration() * (1 + 1e-9))
      refuse(fmt::format("--duration {:g}", *options.duration),
             fmt::format("the clip has {:g} s only", scene->duration()),
             "make it longer: --set time.duration=...");
  }
  return task;
}

} // namespace rend
