// What is found through lists, of vertices near faces, edges near edges, and edges that may go through faces,
// against all pairs, one by one, with what the headers say of a pair written down a second time: of crumpled
// sheets one of which is torn, and of a solid in fragments, with margins held at either of their bounds.
#include "sim/contact/edge_contact.h"
#include "sim/contact/fragment_contact.h"

#include "sim/all_contacts.h"
#include "sim/random_meshes.h"
#include "sim/topology/count.h"
#include "sim/topology/walk.h"

#include <map>

namespace rend::all_pairs_test {
namespace {

using presets::Loaded;
using namespace all_contacts;

// Parts what lies on either side of the plane n·x = c at rest, or all elements from each other.
void part(Body& body, const Vec3& n, double c, bool all = false) {
  EmbeddedMap& map = *body.map;
  const int dimension = map.dimension();
  const Orbit element = dimension == 3 ? Volume : Face;
  const auto beyond = [&](Dart d) {
    double sum = 0;
    for (const Dart e : darts_of(map.map(), element, d)) sum += n.dot(map.rest_of(e)) - c;
    return sum > 0;
  };
  std::vector<Dart> darts;
  map.map().for_each_dart([&](Dart d) {
    const Dart e = map.map().alpha(dimension, d);
    if (d < e && (all || beyond(d) != beyond(e))) darts.push_back(d);
  });
  map.edit([&](Edit& edit) {
    for (const Dart d : darts)
      if (!map.map().is_free(dimension, d)) unsew(edit, dimension, d);
  });
  body.rebind();
}

// A course that bodies take: positions at the start of each step, and at its end before anything is answered.
struct Course {
  struct Step {
    std::vector<std::vector<Record>> from, to; // [m], of each body
  };
  std::vector<Step> steps;
  std::vector<Found> found; // of each, by brute force
};

ContactBodies bodies_of(const Loaded& scene) {
  ContactBodies bodies;
  for (std::size_t b = 0; b < scene->bodies().size(); ++b) {
    scene.body(b).next.position = scene.body(b).map->position().values();
    bodies.push_back(std::make_unique<ContactBody>(scene.body(b), ContactIn::Step, b));
  }
  return bodies;
}

void place(const Loaded& scene, const Course::Step& step) {
  for (std::size_t b = 0; b < step.from.size(); ++b) {
    scene.body(b).map->position().values() = step.from[b];
    scene.body(b).next.position = step.to[b];
  }
}

void solve(Course& course, const Loaded& scene) {
  const ContactBodies bodies = bodies_of(scene);
  for (const Course::Step& step : course.steps) {
    place(scene, step);
    std::vector<Matter> all;
    for (const auto& body : bodies) all.push_back(matter_of(*body));
    course.found.push_back(by_brute_force(all));
  }
}

// Compares what lists find on the course, with margins at `share` of the widest. `searches`: so many.
void expect_the_same(const Course& course, const Loaded& scene, double share, long& searches) {
  ContactBodies bodies = bodies_of(scene);
  ContactPairs pairs(true, SearchMargin(share));
  EdgeContact edges(EdgeContact::With::Bodies, SearchMargin(share));
  for (std::size_t n = 0; n < course.steps.size(); ++n) {
    place(scene, course.steps[n]);
    Found listed;
    for (const ContactPair& pair : pairs.find(bodies)) {
      const auto touching = FragmentContact::touch(bodies, pair);
      if (touching && touching->gap() < 0)
        listed.vertices.insert({pair.body, pair.vertex, pair.face_body, pair.triangle});
    }
    const std::vector<double> pushed(pairs.fragments().all().size(), 0.0);
    for (const EdgeFacePair& pair : pairs.crossing(bodies, pushed))
      listed.through.insert({pair.body,
                             {std::min(pair.edge[0], pair.edge[1]), std::max(pair.edge[0], pair.edge[1])},
                             pair.face_body,
                             pair.triangle});
    ContactAnswer answer(false);
    answer.begin();
    edges.detect(bodies, answer);
    for (const ContactConstraint& each : answer.contacts()) {
      const ContactPoint &a = each.a.point(), &b = each.b.point();
      listed.edges.insert(
          name_of(a.body->number, {a.vertex[0], a.vertex[1]}, b.body->number, {b.vertex[0], b.vertex[1]}));
    }
    for (auto& body : bodies) body->changed = false;
    ASSERT_EQ(listed.vertices, course.found[n].vertices) << "step " << n << ", margin " << share;
    ASSERT_EQ(listed.edges, course.found[n].edges) << "step " << n << ", margin " << share;
    ASSERT_TRUE(std::ranges::includes(listed.through, course.found[n].through))
        << "step " << n << ", " << share;
  }
  searches = pairs.searches() + edges.searches();
}

void expect_the_same_with_any_margin(const Course& course, const Loaded& scene) {
  long wide = 0, narrow = 0;
  expect_the_same(course, scene, 1, wide);
  expect_the_same(course, scene, SearchMargin::least, narrow);
  EXPECT_LT(wide, narrow);
}

std::string sheet(const std::string& name, const std::string& place) {
  return "<body name=\"" + name + R"("><sheet pattern="crossed" cells="7 7" size="0.42 0.42"/><place )" +
         place +
         R"(/><mass total="0.03"/><springs><stretch k="20" damping="5e-3"/>
            <bend kind="angular" k="2e-6"/></springs><viscosity value="0.02" per="body"/>
            <contact with="floor fragments self" thickness="0.002" friction="0.3"/></body>)";
}

// Two sheets that have been dropped upright, and lie in folds upon each other; one is torn in two.
Loaded sheets() {
  Loaded scene = presets::load("<scene>" + sheet("one", R"(rotate="88 0 5" translate="0 0 0.02")") +
                               sheet("two", R"(rotate="91 0 -4" translate="0 0.1 0.02" velocity="0 -0.8 0")") +
                               R"(<world gravity="0 0 -9.81"><floor z="0"/></world>
                                  <time integrator="symplectic" step="auto" duration="9"/></scene>)");
  part(scene.body(1), {1, 0, 0}, 0.2);
  scene->step(); // so that it has all arrays
  return scene;
}

// Each step goes on by so many of the scene's, and ends elsewhere by `noise` [m], as before an answer.
void follow(Course& course, const Loaded& scene, int steps, int stride, double noise_size) {
  meshes::Noise noise(7);
  const auto now = [&] {
    std::vector<std::vector<Record>> at;
    for (const auto& body : scene->bodies()) at.push_back(body->map->position().values());
    return at;
  };
  for (int n = 0; n < steps; ++n) {
    Course::Step step{now(), {}};
    for (int k = 0; k < stride; ++k) scene->step();
    step.to = now();
    for (auto& of_body : step.to)
      for (Record& x : of_body) x = Record(x.vec() + noise_size * noise.vector());
    course.steps.push_back(step);
  }
}

TEST(AllPairs, of_crumpled_sheets_are_found_by_lists_with_either_margin) {
  const Loaded runs = sheets(), scene = sheets();
  Course course;
  while (runs->time() < 0.08) runs->step(); // they fly towards each other
  follow(course, runs, 30, 3, 2e-4);
  while (runs->time() < 0.25) runs->step();
  follow(course, runs, 15, 2, 2e-3);
  follow(course, runs, 6, 8, 2e-3);
  follow(course, runs, 3, 40, 1e-2);
  solve(course, scene);
  std::size_t vertices = 0, edges = 0, through = 0;
  for (const Found& each : course.found) {
    vertices += each.vertices.size();
    edges += each.edges.size();
    through += each.through.size();
  }
  EXPECT_GT(vertices, 1000u);
  EXPECT_GT(edges, 1000u);
  EXPECT_GT(through, 20u);
  expect_the_same_with_any_margin(course, scene);
}

Loaded shattered() {
  Loaded scene = presets::load(
      R"(<scene><body><bar pattern="tetrahedra" cells="3 2 2" size="0.3 0.2 0.2"/><mass total="1"/>
         <elasticity young="2e4" poisson="0.3"/><contact with="fragments" thickness="0.004"/></body>
         <world gravity="0 0 0"/><time step="1e-4" duration="1"/></scene>)");
  part(scene.body(), Vec3::Zero(), 0, true);
  scene->step(); // so that it has all arrays
  return scene;
}

// Its fragments fly apart, turn, and come back.
TEST(AllPairs, of_fragments_of_a_solid_are_found_by_lists_with_either_margin) {
  const Loaded scene = shattered();
  Body& body = scene.body();
  const std::vector<Slot> fragment = fragments_of(body.vertices(), ContactFaces(*body.map, body.boundary()));
  const auto& rest = body.map->rest();
  std::map<Slot, std::vector<Slot>> members;
  for (Slot v = 0; v < fragment.size(); ++v) members[fragment[v]].push_back(v);
  ASSERT_EQ(members.size(), count_cells(body.map->map()).volumes);
  meshes::Noise noise(11);
  std::map<Slot, Vec3> axis;
  for (const auto& [first, of] : members) axis[first] = noise.vector().normalized();
  const auto at = [&](double time) {
    std::vector<Record> x(fragment.size());
    for (const auto& [first, of] : members) {
      Vec3 middle = Vec3::Zero();
      for (const Slot v : of) middle += rest[v].vec() / static_cast<double>(of.size());
      const Vec3 to = (1 + 0.4 * std::sin(0.1 * time)) * middle;
      const Eigen::Matrix3d turned = Eigen::AngleAxisd(0.03 * time, axis[first]).toRotationMatrix();
      for (const Slot v : of) x[v] = Record(Vec3(to + turned * (rest[v].vec() - middle)));
    }
    return x;
  };
  Course course;
  for (int n = 1; n < 45; ++n) course.steps.push_back({{at(n)}, {at(n + 1)}});
  solve(course, scene);
  std::size_t vertices = 0;
  for (const Found& each : course.found) vertices += each.vertices.size();
  EXPECT_GT(vertices, 1000u);
  expect_the_same_with_any_margin(course, scene);
}

} // namespace
} // namespace rend::all_pairs_test
