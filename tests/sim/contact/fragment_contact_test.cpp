// Contact between fragments: they conserve momentum, do not interpenetrate, and neither explode nor stick where
// they were separated.
#include "sim/contact/fragment_contact.h"

#include "sim/base/archive.h"
#include "sim/presets.h"
#include "sim/topology/count.h"
#include "sim/topology/walk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace rend::fragment_contact_test {
namespace {

std::string moving(const std::string& name, const std::string& shape, const std::string& velocity,
                   const std::string& more = "") {
  return "<body name=\"" + name + "\">" + shape + "<drive all=\"yes\" velocity=\"" + velocity +
         R"(" until="0.0015" then="free"/>)" + more + "</body>";
}

std::string sheet(const std::string& place, const std::string& cells = "8 8") {
  return "<sheet pattern=\"triangles\" cells=\"" + cells + R"(" size="1 1"/><place )" + place +
         R"(/><mass total="0.2"/>)" +
         R"(<springs><stretch k="100" damping="0.02"/><bend kind="provot" k="2"/></springs>)";
}

const std::string weightless = R"(<world gravity="0 0 0"/><time step="5e-4" duration="1"/></scene>)";
const std::string fragments = R"(<contact with="fragments" thickness="0.01" friction="0.3"/>)";

Vec3 mean(const Body& body) {
  Vec3 sum = Vec3::Zero();
  for (Slot v = 0; v < body.map->cells(Vertex).slots(); ++v) sum += body.map->position()[v].vec();
  return sum / static_cast<double>(body.map->cells(Vertex).slots());
}

TEST(FragmentContact, sheets_that_collide_keep_their_momentum_and_do_not_pass) {
  const auto scene = presets::load(
      "<scene>" + moving("a", sheet(R"(translate="0 0 0.1")"), "0.3 0 -3", fragments) +
      moving("b", sheet(R"(rotate="0 0 5" translate="0.03 -0.02 0")", "7 9"), "0 0 0", fragments) + weightless);
  for (int n = 0; n < 4; ++n) scene->step();
  const Vec3 momentum = scene->momentum(), turning = scene->angular_momentum();
  const double energy = scene->kinetic_energy() + scene->elastic_energy();
  for (int n = 0; n < 400; ++n) {
    scene->step();
    ASSERT_LE(scene->kinetic_energy() + scene->elastic_energy(), 1.02 * energy) << n;
  }
  EXPECT_LT((scene->momentum() - momentum).norm(), 1e-13);
  EXPECT_LT((scene->angular_momentum() - turning).norm(), 0.02 * momentum.norm());
  EXPECT_GT(mean(scene.body(0)).z(), mean(scene.body(1)).z()) << "a stays above b";
  EXPECT_LT(total_momentum(*scene.body(1).map, *scene.body(1).mass).z(), 0.3 * momentum.z());
}

TEST(FragmentContact, without_it_they_pass) {
  const auto scene = presets::load("<scene>" + moving("a", sheet(R"(translate="0 0 0.1")"), "0 0 -3") +
                                   moving("b", sheet(R"(translate="0.3 0 0")"), "0 0 0") + weightless);
  for (int n = 0; n < 400; ++n) scene->step();
  EXPECT_LT(mean(scene.body(0)).z(), mean(scene.body(1)).z());
}

std::string bar(const std::string& place) {
  return R"(<bar pattern="tetrahedra" cells="3 3 3" size="0.3 0.3 0.3"/><place )" + place +
         R"(/><mass total="1"/>
      <elasticity model="corotational" young="2e4" poisson="0.3" damping-stiffness="1e-3"/>)";
}

TEST(FragmentContact, solids_that_collide_keep_their_momentum_and_do_not_pass) {
  const auto scene = presets::load(
      "<scene>" + moving("a", bar(R"(rotate="10 20 30" translate="0 0 0.6")"), "0 0 -3", fragments) +
      moving("b", bar(R"(translate="0.05 0.03 0")"), "0 0 0", fragments) + weightless);
  for (int n = 0; n < 4; ++n) scene->step();
  const Vec3 momentum = scene->momentum();
  for (int n = 0; n < 600; ++n) scene->step();
  EXPECT_LT((scene->momentum() - momentum).norm(), 1e-12);
  const Vec3 apart = mean(scene.body(0)) - mean(scene.body(1));
  EXPECT_GT(apart.norm(), 0.25);
  EXPECT_GT(apart.z(), 0.1);
}

// Cuts a sheet or solid in two at the plane x = `at`, by unsewing.
void cut(Body& body, double at) {
  EmbeddedMap& map = *body.map;
  const int link = map.dimension();
  std::vector<Dart> darts;
  const auto side = [&](Dart d) {
    double sum = 0;
    const std::vector<Dart> cell = darts_of(map.map(), link == 2 ? FaceOfVolume : Volume, d);
    for (Dart e : cell) sum += map.rest_of(e).x();
    return sum / static_cast<double>(cell.size()) < at;
  };
  map.map().for_each_dart([&](Dart d) {
    const Dart e = map.map().alpha(link, d);
    if (d < e && side(d) != side(e)) darts.push_back(d);
  });
  map.edit([&](Edit& edit) {
    for (Dart d : darts)
      if (!map.map().is_free(link, d)) unsew(edit, link, d);
  });
}

TEST(FragmentContact, what_was_just_parted_neither_explodes_nor_sticks) {
  for (const std::string& shape : {sheet(""), bar("")}) {
    const auto scene = presets::load("<scene><body>" + shape + fragments + "</body>" + weightless);
    for (int n = 0; n < 3; ++n) scene->step();
    cut(scene.body(), scene.body().map->dimension() == 2 ? 0.5 : 0.1);
    scene.body().rebind();
    for (int n = 0; n < 200; ++n) scene->step();
    EXPECT_LT(scene->kinetic_energy(), 1e-20) << "nothing moves them";
    Record* v = scene.body().map->velocity().values().data();
    const auto label = label_fragments(scene.body().map->map());
    const CellIndex& vertices = scene.body().map->cells(Vertex);
    for (Slot n = 0; n < vertices.slots(); ++n)
      v[n] = Record(label[vertices.first_dart(n).value] == 0 ? -0.5 : 0.5, 0, 0);
    const double energy = scene->kinetic_energy();
    for (int n = 0; n < 200; ++n) scene->step();
    EXPECT_NEAR(scene->kinetic_energy(), energy, 1e-9 * energy) << "they part freely";
  }
}

TEST(FragmentContact, halves_of_a_solid_that_was_cut_do_not_pass_back_through_each_other) {
  const auto scene = presets::load("<scene><body>" + bar("") + fragments + "</body>" + weightless);
  cut(scene.body(), 0.1);
  scene.body().rebind();
  scene->step();
  Record* v = scene.body().map->velocity().values().data();
  const auto label = label_fragments(scene.body().map->map());
  const CellIndex& vertices = scene.body().map->cells(Vertex);
  for (Slot n = 0; n < vertices.slots(); ++n)
    v[n] = Record(label[vertices.first_dart(n).value] == 0 ? 1 : -1, 0, 0);
  const Vec3 momentum = scene->momentum();
  for (int n = 0; n < 400; ++n) scene->step();
  EXPECT_LT((scene->momentum() - momentum).norm(), 1e-12);
  double left = -1e300, right = 1e300; // x of the halves where they meet
  const auto& x = scene.body().map->position();
  for (Slot n = 0; n < vertices.slots(); ++n)
    if (label[vertices.first_dart(n).value] == 0)
      left = std::max(left, x[n].x);
    else
      right = std::min(right, x[n].x);
  EXPECT_LT(left - right, 0.03) << "a tenth of the size";
}

// The number of edges of a sheet that intersect faces with which they share no vertex: by brute force.
int crossings(const Body& body) {
  const auto& x = body.map->position();
  Boundary boundary(*body.map, body.border);
  const ContactFaces faces(*body.map, boundary);
  int count = 0;
  for (const ContactFaces::Triangle& t : faces.triangles()) {
    const Vec3 a = x[t.vertex[0]], n = (x[t.vertex[1]].vec() - a).cross(x[t.vertex[2]].vec() - a);
    for (const ContactFaces::Triangle& other : faces.triangles()) {
      const auto shares = [&](Slot v) {
        return std::find(t.vertex.begin(), t.vertex.end(), v) != t.vertex.end();
      };
      if (std::any_of(other.vertex.begin(), other.vertex.end(), shares)) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 p = x[other.vertex[k]], q = x[other.vertex[(k + 1) % 3]];
        const double from = n.dot(p - a), to = n.dot(q - a);
        if (from * to >= 0) continue;
        const Vec3 at = p + from / (from - to) * (q - p);
        bool inside = true;
        for (std::size_t i = 0; i < 3; ++i) {
          const Vec3 corner = x[t.vertex[i]], side = x[t.vertex[(i + 1) % 3]].vec() - corner;
          inside = inside && side.cross(at - corner).dot(n) > 0;
        }
        count += inside;
      }
    }
  }
  return count;
}

// A strip that folds under its own weight.
TEST(FragmentContact, self_keeps_a_falling_strip_from_passing_through_itself) {
  const auto run = [](const std::string& with, int threads) {
    SceneOptions options;
    options.threads = threads;
    auto scene = presets::load(
        R"(<scene><body><sheet cells="40 4" size="1 0.1"/><place rotate="0 82 0" translate="0 0 1.1"/>
        <mass total="0.05"/>
        <springs><stretch k="60" damping="0.02"/><shear k="40"/><bend kind="provot" k="1"/></springs>
        <viscosity value="0.02" per="body"/><contact with=")" +
            with + R"(" thickness="0.008"/></body>
        <world><floor z="0"/></world><time step="5e-4" duration="2"/></scene>)",
        options);
    for (int n = 0; n < 1600; ++n) scene->step();
    return scene;
  };
  const auto self = run("obstacles self", 1), twice = run("obstacles self", 2), without = run("floor", 1);
  EXPECT_EQ(self->hash(), twice->hash());
  EXPECT_GT(crossings(without.body()), 50);
  EXPECT_LE(crossings(self.body()), 2);
}

TEST(FragmentContact, costs_nothing_before_there_are_fragments) {
  ContactPairs pairs;
  const auto scene = presets::load("<scene><body>" + sheet("") + fragments + "</body>" + weightless);
  scene->step();
  std::vector<std::unique_ptr<ContactBody>> bodies;
  bodies.push_back(std::make_unique<ContactBody>(scene.body(), ContactIn::Result));
  EXPECT_TRUE(pairs.find(bodies).empty());
  EXPECT_EQ(pairs.searches(), 0);
}

// Pairs are not stored, but found again.
TEST(FragmentContact, a_run_that_is_resumed_is_the_same) {
  const auto made = [] {
    return presets::load(
        "<scene>" + moving("a", sheet(R"(translate="0 0 0.1")"), "0.3 0 -3", fragments) +
        moving("b", sheet(R"(rotate="0 0 5" translate="0.03 -0.02 0")", "7 9"), "0 0 0", fragments) +
        weightless);
  };
  const auto whole = made();
  for (int n = 0; n < 200; ++n) {
    whole->step();
    if (n % 40 != 0) continue;
    Archive written;
    whole->store(written);
    Archive read(std::span<const std::uint8_t>(written.bytes()));
    const auto resumed = made(), other = made();
    resumed->store(read);
    Archive again;
    resumed->store(again);
    EXPECT_EQ(written.bytes(), again.bytes()) << n;
    for (int k = 0; k <= n; ++k) other->step();
    for (int k = 0; k < 60; ++k) {
      resumed->step();
      other->step();
      ASSERT_EQ(resumed->hash(), other->hash()) << n << ", then " << k;
    }
  }
  EXPECT_GT(whole->contacts()->fragments()->pairs(), 0u);
}

TEST(FragmentContact, a_block_rests_on_a_sheet_that_is_held_along_its_fall) {
  const auto scene =
      presets::load(R"(<scene><body name="sheet"><sheet pattern="triangles" cells="12 12" size="1 1"/>
      <place translate="0 0 0.5"/><mass total="0.2"/><springs><stretch k="200"/></springs>
      <contact with="fragments" thickness="0.004"/><fix all="yes" axes="z"/></body>
      <body name="block"><bar pattern="tetrahedra" cells="2 2 2" size="0.3 0.3 0.3"/>
      <place rotate="10 20 5" translate="0.35 0.35 0.65"/>
      <mass total="5"/><elasticity young="1e5"/><contact with="fragments" thickness="0.004"/></body><world/>
      <time step="5e-4" duration="0.5"/></scene>)");
  const auto energy = [&] {
    return scene->kinetic_energy() + scene->elastic_energy() + scene->gravity_energy();
  };
  const double start = energy();
  while (scene->time() < 0.5) {
    scene->step();
    ASSERT_LE(energy(), start + 0.02 * std::abs(start)) << scene->time();
    for (const Record& x : scene.body(1).map->position().values()) ASSERT_GT(x.z, 0.48) << scene->time();
  }
}

} // namespace
} // namespace rend::fragment_contact_test
