// Edges against edges: bars and sheets that meet with their edges alone do not pass each other, keep their
// momentum and make no energy; without such contacts they pass.
#include "sim/contact/edge_contact.h"

#include "sim/base/archive.h"
#include "sim/presets.h"
#include "sim/topology/count.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace rend::edge_contact_test {
namespace {

// A bar of one cell, 1 x 0.1 x 0.1 m about its middle, that stands on an edge.
std::string bar(const std::string& name, const std::string& place, const std::string& more) {
  return "<body name=\"" + name + R"("><bar pattern="hexahedra" cells="1 1 1" size="1 0.1 0.1"/><place )" +
         place + R"(/><mass total="1"/><elasticity model="corotational" young="1e5" poisson="0.3"/>)" + more +
         R"(<contact with="fragments" thickness="0.004"/></body>)";
}

// Its middle [m].
Vec3 middle(const Body& body) {
  Vec3 sum = Vec3::Zero();
  const CellIndex& cells = body.map->cells(Vertex);
  for (Slot v = 0; v < cells.slots(); ++v) sum += body.map->position()[v].vec() / cells.slots();
  return sum;
}

// Two bars across each other, edge upon edge; the upper one falls.
presets::Loaded crossed_bars(double gravity) {
  return presets::load(
      "<scene>" +
      bar("lower", R"(rotate="45 0 0" translate="-0.5 0 0")", R"(<fix side="-x"/><fix side="+x"/>)") +
      bar("upper", R"(rotate="45 0 90" translate="0 -0.5 0.3" velocity="0 0 -1")", "") +
      fmt::format(R"(<world gravity="0 0 {}"/><time step="2e-4" duration="2"/></scene>)", gravity));
}

TEST(EdgeContact, bars_that_meet_with_their_edges_do_not_pass) {
  const auto scene = crossed_bars(-9.81);
  const double energy = scene->kinetic_energy() + scene->elastic_energy() + 9.81 * middle(scene.body(1)).z();
  for (int n = 0; n < 4000; ++n) {
    scene->step();
    const double height = middle(scene.body(1)).z() - middle(scene.body(0)).z();
    // Edges are 0.1/sqrt 2 m from the middle of a bar; both bars bend.
    ASSERT_GT(height, 0.1) << n;
    if (height > 0.35) break; // it has bounced off
    const double now = scene->kinetic_energy() + scene->elastic_energy() + 9.81 * middle(scene.body(1)).z();
    ASSERT_LT(now, 1.01 * energy + 0.01) << n;
  }
}

std::string sheet(const std::string& name, const std::string& place, const std::string& pattern) {
  return "<body name=\"" + name + R"("><sheet pattern=")" + pattern + R"(" cells="2 2" size="1 1"/><place )" +
         place + R"(/><mass total="0.2"/><springs><stretch k="400" damping="0.02"/></springs>)" +
         R"(<contact with="fragments" thickness="0.01"/></body>)";
}

// Two sheets of large cells, upright and across each other: only edges meet, far from any vertex.
TEST(EdgeContact, sheets_that_meet_with_their_edges_keep_momentum_and_make_no_energy) {
  for (const char* pattern : {"quads", "triangles", "crossed"}) {
    const auto scene = presets::load(
        "<scene>" + sheet("lower", R"(rotate="90 0 0" translate="0 0 0")", pattern) +
        sheet("upper", R"(rotate="90 0 90" translate="0.31 -0.43 1.05" velocity="0 0 -1.5")", pattern) +
        R"(<world gravity="0 0 0"/><time step="2e-4" duration="2"/></scene>)");
    const Vec3 momentum = scene->momentum();
    const double energy = scene->kinetic_energy() + scene->elastic_energy();
    for (int n = 0; n < 1500; ++n) {
      scene->step();
      ASSERT_LE(scene->kinetic_energy() + scene->elastic_energy(), 1.01 * energy) << pattern << " " << n;
    }
    EXPECT_LT((scene->momentum() - momentum).norm(), 1e-12 * momentum.norm() + 1e-13) << pattern;
    EXPECT_LT(total_momentum(*scene.body(0).map, *scene.body(0).mass).z(), 0.2 * momentum.z())
        << pattern << ": the lower one was struck";
  }
}

TEST(EdgeContact, goes_on_from_a_stored_state_bit_for_bit) {
  const auto whole = crossed_bars(-9.81), again = crossed_bars(-9.81);
  for (int n = 0; n < 700; ++n) whole->step();
  for (int n = 0; n < 1500; ++n) again->step(); // what it has listed there is of no use
  Archive written;
  whole->store(written);
  Archive read(std::span<const std::uint8_t>(written.bytes()));
  again->store(read);
  for (int n = 0; n < 500; ++n) {
    whole->step();
    again->step();
  }
  EXPECT_EQ(whole->hash(), again->hash());
}

TEST(EdgeContact, is_there_where_two_bodies_or_one_can_touch_alone) {
  const auto pairs = [](const std::string& bodies) {
    const auto scene = presets::load("<scene>" + bodies + R"(<time step="1e-4" duration="1"/></scene>)");
    scene->step();
    return scene->contacts() && scene->contacts()->edges();
  };
  const std::string one = sheet("one", R"(translate="0 0 0")", "quads");
  EXPECT_FALSE(pairs(one));
  EXPECT_TRUE(pairs(one + sheet("other", R"(translate="0 0 1")", "quads")));
}

} // namespace
} // namespace rend::edge_contact_test
