#include "sim/build/build_matter.h"

#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>

namespace rend {
namespace {

// How far a material's formulas can be trusted on the cells that there are.
void note_exactness(Body& body, const SpringMaterial& material) {
  bool triangles = false, quads = false;
  for_each_face(*body.map, [&](Dart d) {
    const int sides = sides_of_face(body.map->map(), d);
    triangles = triangles || sides == 3;
    quads = quads || sides == 4;
  });
  const double nu = material.poisson;
  if (quads && std::abs(nu - 1.0 / 3) > 1e-3)
    body.notes.push_back(
        fmt::format("springs on rectangles have the right shear modulus, but otherwise behave as with poisson "
                    "{:.4g} and young {:.4g} (only poisson 1/3 is exact); for other materials use <elasticity>",
                    1 / (3 * nu + 2), 3 * material.young * (1 + 3 * nu) / (2 * (2 + 3 * nu))));
  if (triangles)
    body.notes.push_back("springs on triangles reproduce young and poisson only on equilateral triangles with "
                         "poisson 1/3; on squares cut along one diagonal they behave, along the sides, as with "
                         "poisson 0 and 1.125 times young; for exact materials use <elasticity>");
}

std::optional<SpringMaterial> spring_material(Body& body, const SpringsSettings& springs) {
  std::optional<SpringMaterial> material;
  if (springs.young) {
    if (body.map->dimension() == 3)
      springs.source.fail("young", "the springs of a solid cannot be computed from young",
                          "give each its k, or use <elasticity> for a material");
    if (!springs.thickness)
      springs.source.fail("young", "stiffness from young needs the thickness of the sheet",
                          "thickness=\"0.001\"");
    material = SpringMaterial{*springs.young, springs.poisson, *springs.thickness};
    note_exactness(body, *material);
  }
  for (const char* name : {"poisson", "thickness"})
    if (!material && springs.source.given(name))
      springs.source.fail(name, fmt::format("{} of <springs> has no use without young", name),
                          "give young, or leave it out");
  return material;
}

// Null: no law makes cells.
std::vector<AwaitedInteraction>* awaited_of(Body& body, const BodySettings& settings) {
  const bool rules = std::any_of(settings.tears.begin(), settings.tears.end(),
                                 [](const LawSettings& law) { return !law.rule.empty(); });
  return rules ? &body.awaited.all() : nullptr;
}

void build_springs(Body& body, const SpringsSettings& springs, std::vector<AwaitedInteraction>* awaited) {
  check_settings(springs);
  const std::optional<SpringMaterial> material = spring_material(body, springs);
  const bool surface = springs.on == SpringsSettings::On::Surface;
  body.cumulated = springs.cumulated;
  for (const SpringSettings& spring : springs.springs) {
    check_settings(spring);
    if (!spring.type) spring.source.fail("", "there is no such spring", "find_interaction() knows them");
    std::vector<std::string> why_not;
    if (auto made =
            spring.type->make(*body.map, {spring, spring.type->element, material, why_not, surface, awaited}))
      body.interactions.push_back(std::move(made));
    for (auto* list : {&body.left_out, &body.notes}) list->insert(list->end(), why_not.begin(), why_not.end());
  }
}

// Every vertex is fixed along that axis.
bool held_along(const std::vector<MotionSettings>& motions, int axis) {
  return std::any_of(motions.begin(), motions.end(), [&](const MotionSettings& motion) {
    const auto* fix = std::get_if<FixSettings>(&motion);
    return fix && fix->where.all.value_or(false) && holds(fix->axes, axis);
  });
}

// Small strain gives a sheet no stiffness out of its plane: it must lie in a plane of two axes and be held
// there.
void check_flat(const Body& body, const BodySettings& settings) {
  const ElasticitySettings& elasticity = *settings.elasticity;
  if (body.map->dimension() == 3 || elasticity.model == ContinuumModel::Corotational) return;
  Vec3 low = Vec3::Constant(1e300), high = -low;
  body.map->map().for_each_dart([&](Dart d) {
    low = low.cwiseMin(body.map->rest_of(d));
    high = high.cwiseMax(body.map->rest_of(d));
  });
  Vec3::Index axis = 0;
  const double depth = (high - low).minCoeff(&axis);
  const bool flat = depth <= 1e-9 * (high - low).norm();
  if (flat && held_along(settings.motions, static_cast<int>(axis))) return;
  elasticity.source.fail(
      "model",
      fmt::format("model '{}' gives a sheet no stiffness out of its plane",
                  elasticity.model == ContinuumModel::Linear ? "linear" : "mass-tensor"),
      flat ? fmt::format("keep it there with <fix all=\"yes\" axes=\"{}\"/>, or take "
                         "model=\"corotational\"",
                         static_cast<char>('x' + axis))
           : "take model=\"corotational\", or a sheet in the plane of two axes that is held there");
}

template <class S> bool says_cumulated(const S& settings) {
  return settings.source.given("cumulated") || settings.cumulated != Cumulated::Auto;
}

void build_elasticity(Body& body, const BodySettings& settings) {
  const ElasticitySettings& elasticity = *settings.elasticity;
  check_settings(elasticity);
  check_flat(body, settings);
  for (auto& made : make_elasticity(*body.map, elasticity, body.notes, awaited_of(body, settings)))
    body.interactions.push_back(std::move(made));
  body.uniform_drag += elasticity.damping_mass;
  if (!says_cumulated(elasticity)) return;
  if (settings.springs && says_cumulated(*settings.springs) && elasticity.cumulated != body.cumulated)
    elasticity.source.fail("cumulated", "differs from that of <springs>", "give both the same value");
  body.cumulated = elasticity.cumulated;
}

void build_viscosity(Body& body, const ViscositySettings& viscosity) {
  check_settings(viscosity);
  if (viscosity.value == 0) return;
  // distributed like the mass: one rate for all, and no array
  if (viscosity.per == ViscositySettings::Per::Body) {
    body.uniform_drag += viscosity.value / total_mass(*body.map, *body.mass);
    return;
  }
  CornerDrag embedding;
  embedding.per_vertex = viscosity.value;
  body.drag = &body.map->add(embedding.on(*body.map));
}

} // namespace

void build_matter(Body& body, const BodySettings& settings) {
  if (settings.springs) build_springs(body, *settings.springs, awaited_of(body, settings));
  if (settings.elasticity) build_elasticity(body, settings);
  if (settings.viscosity) build_viscosity(body, *settings.viscosity);
  if (!body.drag) body.left_out.emplace_back("viscosity per particle: none");
}

} // namespace rend
