// A body that has shattered into cubes, which move as they are told and take part in contact.
#pragma once

#include "sim/contact/contact_fragments.h"
#include "sim/elements.h"
#include "sim/mesh/cells.h"
#include "sim/random_meshes.h"

#include <array>
#include <cmath>

namespace rend::cubes {

inline constexpr double edge = 0.1;         // [m]
inline constexpr double thickness = 0.0025; // [m], of contact

inline CellMesh mesh_of(const std::array<int, 3>& count, double spacing) {
  CellMesh mesh;
  for (int k = 0; k < count[2]; ++k)
    for (int j = 0; j < count[1]; ++j)
      for (int i = 0; i < count[0]; ++i) {
        std::array<std::uint32_t, 8> corners{};
        for (std::size_t c = 0; c < 8; ++c) {
          corners[c] = static_cast<std::uint32_t>(mesh.points.size());
          mesh.points.push_back(edge *
                                (spacing * Vec3(i, j, k) + elements::regular(ElementKind::Hexahedron)[c]));
        }
        mesh.add(CellKind::Hexahedron, corners);
      }
  return mesh;
}

class Cubes {
public:
  // `spacing`: in edges; from 1.025 on those side by side are no neighbours of contact.
  explicit Cubes(const std::array<int, 3>& count, double spacing = 1.05) {
    body.map = solid_from(mesh_of(count, spacing));
    CornerMass mass;
    mass.density = 1000;
    body.mass = &body.map->add(mass.on(*body.map));
    elements::add_elasticity(body, {});
    body.contact = ContactSettings{.fragments = true, .thickness = thickness};
    body.contact_table.bodies.resize(1);
    body.prepare(*find_scheme("symplectic"));
    body.inverse_mass = body.program->inverse_mass();
    body.next.position = body.map->position().values();
    bodies.push_back(std::make_unique<ContactBody>(body, ContactIn::Step, 0));
    bodies.front()->changed = false;
    meshes::Noise noise(3);
    for (std::size_t n = 0; n < number(); ++n) {
      middle.push_back(where(n));
      axis.push_back(noise.vector().normalized());
    }
  }
  std::size_t number() const { return body.vertices() / 8; } // of cubes; the slots of each follow one another
  Vec3 where(std::size_t cube) const {                       // [m], its middle
    Vec3 sum = Vec3::Zero();
    for (std::size_t c = 0; c < 8; ++c) sum += body.next.position[8 * cube + c].vec() / 8;
    return sum;
  }

  // A step, in which each moves to place(its middle at rest) and turns by `angle` [rad].
  template <class Place> void step(const Place& place, double angle) {
    std::vector<Record>& next = body.next.position;
    body.map->position().values() = next;
    for (std::size_t n = 0; n < number(); ++n) {
      const Vec3 from = where(n), to = place(middle[n]);
      const Eigen::Matrix3d turned = Eigen::AngleAxisd(angle, axis[n]).toRotationMatrix();
      for (std::size_t c = 0; c < 8; ++c)
        next[8 * n + c] = Record(Vec3(to + turned * (next[8 * n + c].vec() - from)));
    }
  }

  Body body;
  ContactBodies bodies;           // this one
  std::vector<Vec3> middle, axis; // [m], one per cube: at rest; about which it turns
};

} // namespace rend::cubes
