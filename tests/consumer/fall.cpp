// Steps a scene given as the text of a preset: a sheet in free fall. Prints the height of fall in millimetres.
#include "render/picture/scene_preset.h"
#include "sim/build/build_scene.h"
#include "sim/scene/scene.h"

#include <cstdio>

int main() {
  const char* text = R"(<scene name="fall">
    <body name="sheet">
      <sheet cells="3 2" size="1 1"/><mass total="1"/><springs><stretch k="50"/></springs>
    </body>
    <world gravity="0 0 -8"/>
    <time step="0.01" integrator="verlet" duration="1"/>
  </scene>)";
  try {
    const auto preset = rend::load_scene_text(text, "fall.xml");
    rend::Scene scene(rend::read_scene(*preset), {});
    const double before = scene.gravity_energy();
    while (scene.time() < scene.duration() - 1e-9) scene.step();
    std::printf("%.6f\n", (before - scene.gravity_energy()) / 8 * 1000); // of 1 kg
    return 0;
  } catch (const rend::UserError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
