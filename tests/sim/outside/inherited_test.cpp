// What acts from outside, after cells were divided: vertices that are held; points, edges and faces that are
// loaded. And which sides are torn.
#include "sim/embedding/initial_border.h"
#include "sim/divided.h"
#include "sim/outside/constraint.h"
#include "sim/outside/patch.h"

namespace rend::inherited_test {
namespace {

using namespace meshes;
using divided::Division, divided::divisions, divided::flat;

TEST(Inherited, motions_hold_a_vertex_between_held_ones_alone) {
  const auto map = sheet_from(sheet(SheetPattern::Quads, 4, 4));
  Constraints constraints;
  Changes changes;
  map->subscribe(changes);
  std::vector<Slot> low, left;
  for (Slot v = 0; v < map->cells(Vertex).slots(); ++v) {
    if (map->rest()[v].y < 1.5) low.push_back(v);
    if (map->rest()[v].x < 0.5) left.push_back(v);
  }
  Motion along_x;
  along_x.axes = {true, false, false};
  constraints.add(*map, Motion{}, low);
  constraints.add(*map, along_x, left);
  map->edit([](Edit& edit) { ASSERT_TRUE(divided::subdivided(edit, Dart{0u})); });
  constraints.rebind(*map, changes);
  std::vector<std::uint8_t> axes(map->cells(Vertex).slots(), 0);
  constraints.mark(0, axes.data());
  for (Slot v = 0; v < axes.size(); ++v) {
    const Vec3 x = map->rest()[v].vec();
    const int expected = x.y() <= 1 ? 7 : x.x() == 0 ? 1 : 0; // whole cells below 1 and at the left side
    EXPECT_EQ(axes[v], expected) << x.transpose();
  }
}

TEST(Inherited, corner_shares_keep_sum_and_middle_of_the_selected_points) {
  for (const Division& division : divisions()) {
    const auto map = sheet_from(warped(sheet(SheetPattern::Mixed, 4, 4), 0.2, 3));
    std::vector<Slot> chosen;
    Vec3 middle = Vec3::Zero();
    for (Slot v = 0; v < map->cells(Vertex).slots(); v += 3) {
      chosen.push_back(v);
      middle += map->rest()[v].vec();
    }
    middle /= static_cast<double>(chosen.size());
    const ShareColumn& shares = share_equally(*map, "probe", chosen);
    Noise noise(7);
    for (int times = 0; times < 2; ++times) map->edit([&](Edit& edit) { division.change(edit, noise); });
    const CellIndex& corners = map->cells(VertexOfFace);
    double sum = 0;
    Vec3 x = Vec3::Zero();
    for (Slot c = 0; c < corners.slots(); ++c) {
      if (!corners.alive(c)) continue;
      sum += shares[c];
      x += shares[c] * map->rest_of(corners.first_dart(c));
    }
    EXPECT_NEAR(sum, 1, 1e-14) << division.name;
    EXPECT_LT((x - middle).norm(), 1e-13) << division.name;
  }
}

TEST(Inherited, patches_keep_their_length_and_their_vector_area) {
  for (const Division& division : divisions()) {
    for (unsigned seed = 0; seed < 5; ++seed) {
      const auto map = sheet_from(flat(warped(sheet(SheetPattern::Mixed, 4, 4), 0.2, seed)));
      std::vector<Slot> left, all;
      for (Slot v = 0; v < map->cells(Vertex).slots(); ++v) {
        all.push_back(v);
        if (map->rest()[v].x < 2.5) left.push_back(v);
      }
      Patch border = Patch::boundary(*map, "border", left), faces = Patch::faces(*map, "faces", left);
      const auto size = [&] {
        double sum = 0;
        for (const double part : border.measures(*map)) sum += part;
        return sum;
      };
      const auto area = [&] {
        Vec3 sum = Vec3::Zero();
        for (std::size_t c = 0; c < faces.cells().size(); ++c) {
          std::vector<Vec3> x, parts;
          for (const Slot v : faces.cells()[c]) x.push_back(map->rest()[v].vec());
          parts.resize(x.size());
          corner_areas(x, parts);
          for (const Vec3& part : parts) sum += part;
        }
        return sum;
      };
      const double before = size();
      const Vec3 area_before = area();
      EXPECT_GT(area_before.norm(), 1);
      Noise noise(seed);
      for (int times = 0; times < 2; ++times) map->edit([&](Edit& edit) { division.change(edit, noise); });
      border.rebind(*map);
      faces.rebind(*map);
      EXPECT_NEAR(size(), before, 1e-13) << division.name;
      EXPECT_LT((area() - area_before).norm(), 1e-13) << division.name;
    }
  }
}

TEST(Inherited, initial_border_keeps_torn_sides_torn) {
  for (const Division& division : divisions()) {
    const auto map = sheet_from(sheet(SheetPattern::Quads, 4, 4));
    const auto& border = map->add(InitialBorder{});
    map->edit([&](Edit& edit) {
      for (const Dart d : assets::all_darts(edit.map())) {
        const Vec3 a = map->rest_of(d), b = map->rest_of(map->map().alpha(0, d));
        if (a.y() == 2 && b.y() == 2) unsew(edit, 2, d);
      }
    });
    Noise noise(7);
    for (int times = 0; times < 3; ++times) map->edit([&](Edit& edit) { division.change(edit, noise); });
    map->map().for_each_dart([&](Dart d) {
      const Vec3 x = (map->rest_of(d) + map->rest_of(map->map().alpha(0, d))) / 2;
      const bool outside = x.x() == 0 || x.x() == 4 || x.y() == 0 || x.y() == 4;
      EXPECT_EQ(border[map->slot(EdgeOfFace, d)], outside ? 1 : 0) << division.name << ": " << x.transpose();
    });
  }
}

} // namespace
} // namespace rend::inherited_test
