// A cloth without a preset, pulled until it is torn in two. Prints tears and fragments; writes cloth.png.
#include "render/files/png.h"
#include "render/picture/still_pictures.h"
#include "sim/mesh/sheet.h"
#include "sim/scene/scene.h"

#include <cstdio>

int main() {
  auto cloth = std::make_unique<rend::Body>(); // in metres, kilograms, seconds, newtons
  const std::array<rend::Vec3, 4> corners{{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}};
  cloth->map = rend::sheet_from(rend::sheet_polygons({.nx = 12, .ny = 12, .corners = corners}));
  rend::EmbeddedMap& map = *cloth->map;
  rend::CornerMass mass;
  mass.density = 0.1; // kg/m2
  cloth->mass = &map.add(mass.on(map));
  for (const rend::InteractionType& type : rend::all_interactions())
    if (type.element == "stretch" || type.kind == "isotropic")
      if (auto springs = type.make(map, {{.k = 60}, type.element, {}, cloth->notes}))
        cloth->interactions.push_back(std::move(springs));
  std::vector<rend::Slot> held, pulled;
  for (rend::Slot v = 0; v < map.cells(rend::Vertex).slots(); ++v)
    if (const double x = map.position()[v].x; x == 0 || x == 1) (x == 0 ? held : pulled).push_back(v);
  cloth->uniform_drag = 5; // per second: viscosity of the air
  cloth->constraints.add(map, {}, held);
  cloth->constraints.add(map, {.velocity = {1, 0, 0}}, pulled);
  cloth->border = &map.add(rend::BornBorder());
  const rend::CriterionType criterion = rend::atomic_border();
  const rend::ChangeType change = rend::separate();
  const rend::LawSettings law{.criterion = &criterion, .change = &change, .threshold = 6};
  cloth->tear_laws.emplace_back(cloth->request_for(law), law);
  rend::SceneDefinition definition;
  definition.bodies.push_back(std::move(cloth));
  definition.time.duration = 0.8;
  rend::Scene scene(std::move(definition), {});
  while (scene.time() < scene.duration()) scene.step();
  rend::StillPictures pictures({.looks = {{.colour = {200, 55, 74}}}}, scene);
  rend::write_png("cloth.png", pictures.take());
  std::printf("%zu tears, %zu fragments\n", scene.tears(), scene.fragments());
}
