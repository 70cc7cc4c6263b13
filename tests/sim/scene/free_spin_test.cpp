// Free bodies of turned elements, spinning about an oblique axis: their forces are a gradient, so that a
// symplectic scheme keeps the angular momentum to round-off and the energy without drift, for as long as one
// likes.
#include "sim/presets.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::free_spin_test {
namespace {

struct Spinning {
  std::string shape, rotation;
  int steps;
};

presets::Loaded spinning(const Spinning& body) {
  const bool sheet = body.shape.starts_with("<sheet");
  auto scene = presets::load(fmt::format(
      R"(<scene><body>{}<mass {}/><elasticity young="1e4" rotation="{}"{}/></body><world gravity="0 0 0"/>)"
      R"(<time step="1e-3" integrator="verlet" duration="1e9"/></scene>)",
      body.shape, sheet ? R"(total="2")" : R"(density="100")", body.rotation,
      sheet ? R"( thickness="0.02")" : ""));
  EmbeddedMap& map = *scene.body().map;
  const Vec3 spin(0.7, 1.1, 3), centre(0.5, 0.15, 0.15);
  for (Slot v = 0; v < map.velocity().values().size(); ++v)
    map.velocity()[v] = Record(spin.cross(map.position()[v].vec() - centre));
  return scene;
}

double energy(const Scene& scene) {
  return scene.kinetic_energy() + scene.elastic_energy();
}

TEST(FreeSpin, keeps_angular_momentum_to_round_off_and_energy_without_drift) {
  const std::string bar = R"(<bar pattern="{}" cells="{}" size="1 0.3 0.3"/>)";
  const auto of = [&](const char* pattern, const char* cells) {
    return fmt::format(fmt::runtime(bar), pattern, cells);
  };
  const std::string quads = R"(<sheet pattern="mixed" cells="3 1" size="1 0.3"/>)";
  for (const Spinning& body : {Spinning{of("hexahedra", "2 1 1"), "polar", 1'000'000},
                               {of("hexahedra", "2 1 1"), "qr", 1'000'000},
                               {of("prisms", "1 1 1"), "polar", 100'000},
                               {of("prisms", "1 1 1"), "qr", 100'000},
                               {of("mixed", "3 1 1"), "polar", 100'000},
                               {of("mixed", "3 1 1"), "qr", 100'000},
                               {of("tetrahedra", "1 1 1"), "qr", 100'000},
                               {quads, "qr", 100'000}}) {
    SCOPED_TRACE(body.shape + " " + body.rotation);
    const auto scene = spinning(body);
    const Vec3 momentum = scene->angular_momentum();
    const double start = energy(*scene.scene);
    double most = 0, strained = 0;
    for (int n = 0; n < body.steps; ++n) {
      scene->step();
      if (n % 997 != 0) continue;
      most = std::max(most, std::abs(energy(*scene.scene) - start));
      strained = std::max(strained, scene->elastic_energy());
    }
    EXPECT_GT(strained, 1e-2 * start); // it is stretched and shakes
    EXPECT_LT((scene->angular_momentum() - momentum).norm(), 1e-12 * momentum.norm());
    EXPECT_LT(most, 1e-3 * start);
  }
}

} // namespace
} // namespace rend::free_spin_test
