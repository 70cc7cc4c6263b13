// Renumbering a map (embedding/reorder.h) after elements were deleted and vertices split: all that depends on
// it equals what is built from scratch; and a run continues with the same results.
#include "sim/contact/contact_faces.h"
#include "sim/fracture/torn_bodies.h"
#include "sim/fracture/torn_checks.h"
#include "sim/presets.h"

#include <gtest/gtest.h>

namespace rend::number_anew_test {
namespace {

using namespace torn;

const std::vector<RandomChange>& holes_and_splits() { // slots become free, and new ones are allocated
  static const std::vector<RandomChange> all{{"delete-element", Cell::Elements},
                                             {"split-vertex", Cell::Vertices}};
  return all;
}

bool has_free_slots(const EmbeddedMap& map, Orbit orbit) {
  return map.cells(orbit).count() < map.cells(orbit).slots();
}

void expect_stiffness_as_built_anew(Body& body) {
  const Assembly anew(*body.map, *body.program);
  ASSERT_TRUE(body.pattern()->same_as(*anew.pattern()));
  BlockMatrix ours, theirs;
  ours.reset(body.pattern());
  theirs.reset(anew.pattern());
  const Record *x = body.map->position().values().data(), *v = body.map->velocity().values().data();
  body.assembly->add(x, v, Tangent::Exact, 1, 1, ours);
  anew.add(x, v, Tangent::Exact, 1, 1, theirs);
  for (std::size_t n = 0; n < ours.pattern()->blocks(); ++n)
    EXPECT_EQ(std::memcmp(&ours.at(n), &theirs.at(n), sizeof(Block3)), 0);
}

void expect_blocks_without_gaps(const std::vector<Binder>& binders) {
  for (const Binder& binder : binders) {
    const PackedRows& rows = binder.rows();
    std::size_t end = 0;
    for (std::size_t block = 0; block < rows.blocks(); ++block) {
      if (rows.rows_in(block) == 0) continue;
      EXPECT_EQ(rows.begin(block), end) << binder.interaction()->name;
      end += rows.padded_in(block);
    }
    EXPECT_EQ(rows.end(), end);
  }
}

void expect_same_faces(const ContactFaces& a, const ContactFaces& b) {
  EXPECT_TRUE(
      std::equal(a.triangles().begin(), a.triangles().end(), b.triangles().begin(), b.triangles().end(),
                 [](const auto& p, const auto& q) { return p.vertex == q.vertex && p.face == q.face; }));
}

TEST(NumberAnew, binds_all_as_if_it_were_built_now_and_follows_changes_from_there) {
  for (const char* scheme : {"rk4", "implicit", "alpha"}) { // both sets of rows; a matrix; accelerations
    for (auto& each : elements::irregular_maps()) {
      SCOPED_TRACE(each.name + std::string(", ") + scheme);
      const auto body = torn::body(std::move(each.map), holes_and_splits(), scheme, true);
      Seen seen(*body);
      ContactFaces faces(*body->map, body->boundary());
      bool free = false;
      for (int n = 0; n < 12; ++n) {
        body->evaluate();
        body->tear(n, n, [] {});
        free = free || has_free_slots(*body->map, Vertex) || has_free_slots(*body->map, body->mass->orbit());
        if (n % 3 == 2) {
          body->map->renumber();
          body->rebind();
          expect_blocks_without_gaps(body->program->rows());
        }
        seen.update();
        expect_as_built_anew(*body, seen);
        faces.update();
        Boundary anew(*body->map, body->border);
        expect_same_faces(faces, ContactFaces(*body->map, anew));
        if (body->assembly) expect_stiffness_as_built_anew(*body);
        if (HasFailure()) FAIL() << "after step " << n;
      }
      EXPECT_TRUE(free);
    }
  }
}

// The arrays of rows: their addresses must not change.
std::vector<const double*> places_of_rows(const Body& body) {
  std::vector<const double*> places;
  for (const Binder& binder : body.program->rows()) places.push_back(binder.rows().lanes_at(0));
  places.push_back(body.program->inverse_mass());
  return places;
}

TEST(NumberAnew, leaves_room_for_all_separations_that_are_to_come) {
  const auto body = torn::body(solid_from(elements::warped_bar(BarPattern::Tetrahedra, 5, 4, 4, 0.05, 2)),
                               {{"separate", Cell::Borders}});
  RandomCriterion<Cell::Borders>::most = 40;
  for (int n = 0; n < 4; ++n) body->tear(n, n, [] {});
  RandomCriterion<Cell::Borders>::most = 4;
  body->map->renumber();
  body->rebind();
  const auto before = places_of_rows(*body);
  body->map->edit([](Edit& edit) { edit.map().for_each_dart([&](Dart d) { unsew(edit, 3, d); }); });
  body->rebind();
  EXPECT_EQ(body->map->cells(Vertex).count(), 4u * body->map->cells(Volume).count());
  EXPECT_EQ(places_of_rows(*body), before);
}

// ---- whole scenes, with everything that a body can have

const std::string sheet = R"(<sheet pattern="mixed" cells="9 8" size="1 1"/><mass total="0.1"/><springs>
  <stretch k="60" damping="0.02"/><shear kind="isotropic" k="43"/><bend kind="angular" k="1e-3"/></springs>
  <tear criterion="global-border" threshold="0.6"/><tear criterion="atomic-vertex" threshold="0.9"/>
  <tear criterion="atomic-spring" kind="stretch" change="delete-edge" threshold="0.6"/>)";
const std::string mixed_bar = R"(<bar pattern="mixed" cells="6 3 2" size="1 0.5 0.4"/><mass total="1"/>
  <elasticity model="corotational" young="2e4" poisson="0.3"/>
  <tear criterion="atomic-element" change="delete-element" threshold="900" max-per-step="1"/>
  <tear criterion="vertex-stress" threshold="1.5e3" max-per-step="1"/>
  <tear criterion="atomic-border" threshold="60"/>
  <load side="-y" moment="0.01 0 0"/>)";

std::string renumbered_scene_xml(const std::string& body, const std::string& integrator) {
  return R"(<scene name="anew"><world gravity="0 0 -9.81"><floor z="-0.1"/><wind velocity="0.5 0.2 2"/></world>
    <body name="it">)" +
         body + R"(<viscosity value="0.1" per="body"/><fix side="-x"/><drive side="+x" velocity="1.2 0.1 0"/>
    <load side="+y" force="0 0.3 -0.1"/>
    <contact with="floor obstacles"/>
    <probe name="end" side="+x"/><probe name="edge" side="+y"/>
    <answer probe="edge" quantity="dz" at="0.01" value="1" tolerance="1"/></body>
    <time step="5e-4" duration="1" integrator=")" +
         integrator + R"("/></scene>)";
}

void expect_near(const ProbeReading& a, const ProbeReading& b) {
  EXPECT_LT((a.position - b.position).norm(), 1e-8);
  EXPECT_LT((a.displacement - b.displacement).norm(), 1e-8);
  ASSERT_TRUE(a.reaction.has_value() == b.reaction.has_value());
  if (a.reaction) {
    EXPECT_LT((*a.reaction - *b.reaction).norm(), 1e-5 * (1 + b.reaction->norm()));
  }
  ASSERT_TRUE(a.stress.has_value() == b.stress.has_value());
  if (a.stress) {
    EXPECT_LT((*a.stress - *b.stress).norm(), 1e-5 * (1 + b.stress->norm()));
  }
}

// Sums are made in another order: only the last bits may differ.
void expect_same_course(Body& a, Body& b) {
  ASSERT_EQ(a.events.size(), b.events.size());
  for (std::size_t e = 0; e < a.events.size(); ++e) {
    EXPECT_EQ(a.events[e].dart, b.events[e].dart);
    EXPECT_EQ(a.events[e].step, b.events[e].step);
    EXPECT_EQ(a.events[e].law, b.events[e].law);
    EXPECT_EQ(a.events[e].fragments, b.events[e].fragments);
    EXPECT_NEAR(a.events[e].value, b.events[e].value, 1e-6 * b.events[e].value);
  }
  double apart = 0;
  a.map->map().for_each_dart(
      [&](Dart d) { apart = std::max(apart, (a.map->position_of(d) - b.map->position_of(d)).norm()); });
  EXPECT_LT(apart, 1e-8);
  for (std::size_t n = 0; n < a.probes.size(); ++n) {
    const auto ours = a.probes[n].read(a), theirs = b.probes[n].read(b);
    ASSERT_TRUE(ours.has_value() == theirs.has_value());
    if (ours) expect_near(*ours, *theirs);
  }
  ASSERT_TRUE(a.answers[0].measured && b.answers[0].measured);
  EXPECT_NEAR(*a.answers[0].measured, *b.answers[0].measured, 1e-8);
}

TEST(NumberAnew, at_every_change_leaves_the_course_of_a_scene_as_it_is) {
  for (const std::string& body : {sheet, mixed_bar}) {
    for (const char* integrator : {"symplectic", "rk4", "implicit"}) {
      SCOPED_TRACE(body + integrator);
      const std::string xml = renumbered_scene_xml(body, integrator);
      const auto one = presets::load(xml, {.count_fragments = true}),
                 other = presets::load(xml, {.count_fragments = true});
      Body& renumbered = one.body();
      Seen seen(renumbered);
      bool free = false;
      int times = 0;
      renumbered.change_observer = [&](WitnessAt when) {
        if (when == WitnessAt::BeforeChanges) return;
        ++times;
        free = free || has_free_slots(*renumbered.map, renumbered.mass->orbit());
        renumbered.map->renumber();
        renumbered.rebind();
        seen.update();
        expect_as_built_anew(renumbered, seen);
      };
      while (one->steps_done() < 400 && times < 15 && !HasFailure()) {
        one->step();
        other->step();
        ASSERT_EQ(one->tears(), other->tears());
      }
      EXPECT_GE(times, 10);
      EXPECT_TRUE(free);
      expect_same_course(renumbered, other.body());
      EXPECT_NEAR(one->elastic_energy(), other->elastic_energy(), 1e-6 * other->elastic_energy());
    }
  }
}

} // namespace
} // namespace rend::number_anew_test
