// A cloth without a preset, pulled until it is torn in two. Prints tears and fragments; writes cloth.png.
#include "render/files/png.h"
#include "render/picture/still_pictures.h"
#include "sim/build/build_scene.h"
#include "sim/scene/scene.h"

#include <cstdio>

int main() {
  try {
    rend::BodySettings cloth; // in metres, kilograms, seconds, newtons
    cloth.shape = rend::SheetShape{.nx = 12, .ny = 12, .size = {{1, 1}}};
    cloth.place.rotate = {90, 0, 0};
    cloth.mass.total = 0.1;
    cloth.springs = {.springs = {{.type = rend::find_interaction("stretch"), .k = 60},
                                 {.type = rend::find_interaction("shear", "isotropic"), .k = 60}}};
    cloth.viscosity = {.value = 0.5, .per = rend::ViscositySettings::Per::Body}; // of the air
    cloth.motions = {rend::FixSettings{.where = {.side = "-x"}},
                     rend::DriveSettings{.where = {.side = "+x"}, .velocity = {{1, 0, 0}}}};
    cloth.tears = {{.criterion = rend::find_criterion("atomic-border"), .threshold = 6}};
    rend::SceneDefinition definition;
    rend::add_body(definition, cloth);
    definition.time.duration = 0.8;
    rend::Scene scene(std::move(definition), {});
    while (scene.time() < scene.duration()) scene.step();
    rend::StillPictures pictures({.looks = {{.colour = {200, 55, 74}}}}, scene);
    rend::write_png("cloth.png", pictures.take());
    std::printf("%zu tears, %zu fragments\n", scene.tears(), scene.fragments());
    return 0;
  } catch (const rend::UserError& error) { // what is wrong, and what would do
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
