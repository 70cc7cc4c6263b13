// Element kernels: nanoseconds per element and evaluation of forces, one thread.
#include "sim/elements.h"
#include "sim/fracture/pairs.h"
#include "sim/presets.h"

#include <benchmark/benchmark.h>

namespace rend {
namespace {

using namespace elements;

void forces_of(benchmark::State& state, const CellMesh& mesh, const Elastic& recipe) {
  const auto body = elastic_body(solid_from(mesh), recipe);
  meshes::shake(*body, 0.05, 2);
  std::vector<Record> force(body->program->vertices());
  for (auto _ : state) body->program->forces(meshes::positions(*body), meshes::velocities(*body), force.data());
  const double elements = static_cast<double>(body->map->cells(Volume).count());
  state.counters["elements"] = elements;
  state.counters["per element"] =
      benchmark::Counter(elements, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}
void forces(benchmark::State& state, BarPattern pattern, int nx, const Elastic& recipe) {
  forces_of(state, warped_bar(pattern, nx, 10, 10, 0.1, 1), recipe);
}
void pyramids(benchmark::State& state, const Elastic& recipe) {
  forces_of(state, in_pyramids(warped_bar(BarPattern::Hexahedra, 17, 10, 10, 0.1, 1)), recipe);
}
const auto tetrahedra = BarPattern::Tetrahedra;
BENCHMARK_CAPTURE(forces, tetrahedra_linear, tetrahedra, 34, {"linear"});
BENCHMARK_CAPTURE(forces, tetrahedra_qr, tetrahedra, 34, {"corotational", "qr"});
BENCHMARK_CAPTURE(forces, tetrahedra_polar, tetrahedra, 34, {"corotational"});
BENCHMARK_CAPTURE(forces, tetrahedra_polar_damped, tetrahedra, 34, {"corotational", "polar", 0.01});
BENCHMARK_CAPTURE(forces, tetrahedra_tensors, tetrahedra, 34, {"mass-tensor"});
BENCHMARK_CAPTURE(forces, tetrahedra_tensors_elementary, tetrahedra, 34,
                  {"mass-tensor", "polar", 0, Cumulated::No});
const auto hexahedra = BarPattern::Hexahedra;
BENCHMARK_CAPTURE(forces, hexahedra_linear, hexahedra, 100, {"linear"});
BENCHMARK_CAPTURE(forces, hexahedra_qr, hexahedra, 100, {"corotational", "qr"});
BENCHMARK_CAPTURE(forces, hexahedra_polar, hexahedra, 100, {"corotational"});
BENCHMARK_CAPTURE(forces, hexahedra_tensors, hexahedra, 100, {"mass-tensor"});
BENCHMARK_CAPTURE(forces, hexahedra_tensors_elementary, hexahedra, 100,
                  {"mass-tensor", "polar", 0, Cumulated::No});
BENCHMARK_CAPTURE(forces, hexahedra_polar_damped, hexahedra, 100, {"corotational", "polar", 0.01});
BENCHMARK_CAPTURE(forces, hexahedra_enhanced, hexahedra, 100,
                  {"corotational", "polar", 0, Cumulated::Auto, false, Formulation::Enhanced});
BENCHMARK_CAPTURE(forces, prisms_polar, BarPattern::Prisms, 50, {"corotational"});
BENCHMARK_CAPTURE(forces, prisms_qr, BarPattern::Prisms, 50, {"corotational", "qr"});
BENCHMARK_CAPTURE(pyramids, polar, {"corotational"});

// A symplectic step of 20,400 tetrahedra held at a stretch of 1 %, and what a tearing law adds to it. Far: all
// stresses are far below the threshold; near: two thirds of it, everywhere.
std::string stretched() {
  return R"(<scene name="bar"><body name="bar">)"
         R"(<bar pattern="tetrahedra" cells="34 10 10" size="0.34 0.1 0.1"/>)"
         R"(<mass total="3.4"/><elasticity young="1e5" poisson="0.3"/><fix side="-x"/><fix side="+x"/></body>)"
         R"(<world gravity="0 0 0"/>)"
         R"(<time step="1e-4" integrator="symplectic" duration="1"/></scene>)";
}
void corotational_step(benchmark::State& state, const std::string& criterion, bool near) {
  double threshold = 1e12;
  presets::Loaded scene = presets::load(stretched());
  for (Record& x : scene.body().map->position().values()) x.x *= 1.01;
  for (int n = 0; n < 200; ++n) scene->step();
  LawSettings settings;
  for (const CriterionType& type : all_criteria())
    if (type.name == criterion) settings.criterion = &type;
  settings.threshold = 1e-12;
  if (settings.criterion) {
    settings.cell = settings.criterion->cell("");
    settings.change = &default_change(settings.cell);
    Body& body = scene.body();
    body.evaluate();
    TearLaw all(body.request_for(settings), settings);
    if (near) threshold = 1.5 * all.find(body.view()).front().value;
    settings.threshold = threshold;
    body.tear_laws.emplace_back(body.request_for(settings), settings);
  }
  for (auto _ : state) scene->step();
}
BENCHMARK_CAPTURE(corotational_step, none, "", false);
BENCHMARK_CAPTURE(corotational_step, vertex_stress, "vertex-stress", false);
BENCHMARK_CAPTURE(corotational_step, vertex_stress_near, "vertex-stress", true);
BENCHMARK_CAPTURE(corotational_step, element_stress, "atomic-element", false);
BENCHMARK_CAPTURE(corotational_step, element_stress_near, "atomic-element", true);
BENCHMARK_CAPTURE(corotational_step, vertex_force, "atomic-vertex", false);

// Force and stiffness, as in an implicit step.
void stiffness(benchmark::State& state, ElementKind kind, const Model& model, Tangent tangent) {
  Element e(kind, model, distorted(kind, 0.1, 3), 0.01);
  e.shake(0.1, 2);
  UnitMatrix K, by_velocity;
  std::vector<Vec3> f(e.corners());
  for (auto _ : state) {
    e.law->forces(e.unit.data(), e.state(), f.data());
    e.law->stiffness(e.unit.data(), e.state(), tangent, K, by_velocity);
    benchmark::DoNotOptimize(K.data());
    benchmark::DoNotOptimize(f.data());
  }
}
BENCHMARK_CAPTURE(stiffness, tetrahedron_definite, ElementKind::Tetrahedron, every_model()[2],
                  Tangent::SemiDefinite);
BENCHMARK_CAPTURE(stiffness, tetrahedron_exact, ElementKind::Tetrahedron, every_model()[2], Tangent::Exact);
BENCHMARK_CAPTURE(stiffness, tetrahedron_linear, ElementKind::Tetrahedron, every_model()[0],
                  Tangent::SemiDefinite);
BENCHMARK_CAPTURE(stiffness, hexahedron_definite, ElementKind::Hexahedron, every_model()[2],
                  Tangent::SemiDefinite);
BENCHMARK_CAPTURE(stiffness, hexahedron_exact, ElementKind::Hexahedron, every_model()[2], Tangent::Exact);

void bound(benchmark::State& state, ElementKind kind) {
  const Element e(kind, every_model()[2], distorted(kind, 0.1, 3));
  const std::vector<double> mass(e.corners(), 1);
  std::vector<double> s(e.corners()), d(e.corners());
  for (auto _ : state) {
    e.law->bound(e.unit.data(), e.rest.data(), mass.data(), s.data(), d.data());
    benchmark::DoNotOptimize(s.data());
  }
}
BENCHMARK_CAPTURE(bound, tetrahedron, ElementKind::Tetrahedron);
BENCHMARK_CAPTURE(bound, hexahedron, ElementKind::Hexahedron);

void recognise(benchmark::State& state, BarPattern pattern) {
  const auto map = solid_from(warped_bar(pattern, 4, 4, 4, 0.1, 1));
  const CellIndex& volumes = map->use(Volume);
  Slot n = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(element_at(map->map(), volumes.first_dart(n)));
    n = n + 1 == volumes.slots() ? 0 : n + 1;
  }
}
BENCHMARK_CAPTURE(recognise, tetrahedra, tetrahedra);
BENCHMARK_CAPTURE(recognise, hexahedra, hexahedra);

} // namespace
} // namespace rend
