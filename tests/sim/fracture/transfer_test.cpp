// Where a change acts, against lists of elements, edges and borders by their vertices: without darts or orbits.
#include "sim/fracture/plain_body.h"
#include "sim/fracture/torn_bodies.h"
#include "sim/rows/continuum.h"

#include <gtest/gtest.h>

#include <map>

namespace rend::transfer_test {
namespace {

using namespace torn;
using Corners = std::set<Slot>; // the vertices of a cell

// A body as lists, with the forces of each element on its corners.
class Lists {
public:
  explicit Lists(const Body& body) : body_(body) {
    const CellIndex& corners = body.map->cells(body.mass->orbit());
    for (const plain::Polyhedron& p : plain::polyhedra(*body.map)) {
      Element& element = elements.emplace_back();
      for (const plain::Polygon& polygon : p.faces) {
        const std::size_t n = polygon.vertex.size();
        for (std::size_t k = 0; k < n; ++k) {
          element.force[polygon.vertex[k]] = body.corner_force[corners.slot(polygon.dart[k])].vec();
          element.edges.insert({polygon.vertex[k], polygon.vertex[(k + 1) % n]});
        }
        element.faces.push_back(polygon.vertex);
      }
    }
  }

  struct Element {
    std::map<Slot, Vec3> force; // [N], by vertex
    std::set<Corners> edges;
    std::vector<std::vector<Slot>> faces; // of a sheet: itself
    Corners corners() const {
      Corners all;
      for (const auto& [v, f] : force) all.insert(v);
      return all;
    }
    bool holds(const Corners& cell) const {
      return std::all_of(cell.begin(), cell.end(), [&](Slot v) { return force.contains(v); });
    }
  };
  std::vector<Element> elements;

  Vec3 at(Slot v) const { return body_.map->position()[v]; }
  bool sheet() const { return body_.map->dimension() == 2; }
  Vec3 along(const Corners& edge) const { return (at(*edge.rbegin()) - at(*edge.begin())).normalized(); }

  std::vector<const Element*> around(const Corners& cell) const {
    std::vector<const Element*> all;
    for (const Element& e : elements)
      if (cell.size() == 2 ? e.edges.contains(cell) : e.holds(cell)) all.push_back(&e);
    return all;
  }
  // Edges of a sheet or faces of a solid between two elements.
  std::set<Corners> borders() const {
    std::set<Corners> all;
    for (const Element& e : elements) {
      std::set<Corners> own;
      if (sheet()) own = e.edges;
      for (const auto& face : e.faces)
        if (!sheet()) own.insert(Corners(face.begin(), face.end()));
      for (const Corners& border : own)
        if (around(border).size() == 2) all.insert(border);
    }
    return all;
  }
  Vec3 normal(const std::vector<Slot>& face) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t k = 0; k < face.size(); ++k) sum += at(face[k]).cross(at(face[(k + 1) % face.size()]));
    return sum.normalized();
  }
  Vec3 across(const Corners& border) const {
    const auto two = around(border);
    if (sheet()) {
      Vec3 sum = Vec3::Zero();
      for (const Element* e : two) { // the sheets here face up
        const Vec3 n = normal(e->faces[0]);
        sum += n.z() < 0 ? Vec3(-n) : n;
      }
      return along(border).cross(sum).normalized();
    }
    for (const auto& face : two[0]->faces)
      if (Corners(face.begin(), face.end()) == border) return normal(face);
    throw std::logic_error("no such border");
  }
  // |(f_1 − f_2)·n|, summed over these vertices of the border before the magnitude is taken.
  double opened(const Corners& border, const Corners& there, const Vec3& n) const {
    const auto two = around(border);
    Vec3 sum = Vec3::Zero();
    for (Slot v : there) sum += two[0]->force.at(v) - two[1]->force.at(v);
    return std::abs(sum.dot(n));
  }
  double tension(const Element& e, const Corners& edge) const {
    return std::abs((e.force.at(*edge.begin()) - e.force.at(*edge.rbegin())).dot(along(edge)));
  }
  double pull_at(Slot end, const Corners& edge) const {
    double sum = 0;
    for (const Element* e : around(edge)) sum += std::abs(e->force.at(end).dot(along(edge)));
    return sum;
  }

private:
  const Body& body_;
};

struct Found {
  double value = -1;
  Corners cell;
  void offer(double v, const Corners& c) {
    if (v > value) *this = {v, c};
  }
};

Corners corners_of_cell(const Body& body, Cell cell, Dart d) {
  Corners all;
  for (Dart e : cell_of(body, cell, d)) all.insert(body.map->vertex(e));
  return all;
}

// The best cell of kind `to`, by the table of transfer.h. Directions of elements are tested below.
Corners expected(const Lists& lists, Cell from, Cell to, const Corners& cell, const Vec3& normal) {
  Found best;
  const auto edges_of = [&](const auto& elements, auto&& value) {
    for (const Lists::Element* e : elements)
      for (const Corners& edge : e->edges) value(*e, edge);
  };
  std::vector<const Lists::Element*> every;
  for (const Lists::Element& e : lists.elements) every.push_back(&e);
  const auto within = [&](const Corners& small, const Corners& large) {
    return std::includes(large.begin(), large.end(), small.begin(), small.end());
  };
  for (const Corners& border : lists.borders()) {
    if (to != Cell::Borders) break;
    if (from == Cell::Edges)
      for (Slot end : cell)
        if (border.contains(end)) best.offer(lists.opened(border, {end}, lists.along(cell)), border);
    if (from == Cell::Vertices && within(cell, border)) best.offer(lists.opened(border, cell, normal), border);
    if (from == Cell::Elements && within(border, cell) && lists.around(border).size() == 2 &&
        (lists.around(border)[0]->corners() == cell || lists.around(border)[1]->corners() == cell))
      best.offer(lists.opened(border, border, lists.across(border)), border);
  }
  if (to == Cell::Elements)
    for (const Lists::Element* e : lists.around(cell)) {
      Vec3 sum = Vec3::Zero();
      for (Slot v : cell) sum += e->force.at(v);
      const double value = from == Cell::Edges     ? lists.tension(*e, cell)
                           : from == Cell::Borders ? std::abs(sum.dot(lists.across(cell)))
                                                   : std::abs(sum.dot(normal));
      best.offer(value, e->corners());
    }
  if (to == Cell::Vertices)
    for (Slot v : cell) {
      if (from == Cell::Edges) best.offer(lists.pull_at(v, cell), {v});
      if (from == Cell::Borders) best.offer(lists.opened(cell, {v}, lists.across(cell)), {v});
      if (from == Cell::Elements) best.offer(std::abs(lists.around(cell)[0]->force.at(v).dot(normal)), {v});
    }
  if (to == Cell::Edges)
    edges_of(every, [&](const Lists::Element& e, const Corners& edge) {
      if (from == Cell::Vertices && within(cell, edge)) best.offer(lists.pull_at(*cell.begin(), edge), edge);
      if (from == Cell::Elements && e.corners() == cell) best.offer(lists.tension(e, edge), edge);
      if (from == Cell::Borders && within(edge, cell)) {
        const Vec3 n = lists.across(cell);
        best.offer(lists.opened(cell, {*edge.begin()}, n) + lists.opened(cell, {*edge.rbegin()}, n), edge);
      }
    });
  return best.cell;
}

constexpr std::array cells{Cell::Edges, Cell::Borders, Cell::Vertices, Cell::Elements};

// A body whose corner forces are evaluated.
std::unique_ptr<Body> shaken(std::unique_ptr<EmbeddedMap> map, unsigned seed) {
  auto made = torn::body(std::move(map), {{"split-vertex", Cell::Edges}});
  meshes::shake(*made, 0.08, seed);
  made->evaluate();
  return made;
}

TEST(Transfer, goes_to_the_cell_that_lists_of_elements_say) {
  for (auto& each : elements::irregular_maps()) {
    const auto body = shaken(std::move(each.map), 5);
    const Lists lists(*body);
    const int dimension = body->map->dimension();
    Noise noise(3);
    for (Cell from : cells)
      for (Cell to : cells) {
        const Transfer& one = transfer(from, to, dimension);
        if (!one.find) continue;
        SCOPED_TRACE(each.name + ": " + name_of(from, dimension) + " to " + name_of(to, dimension));
        int found = 0;
        for (int n = 0; n < 12; ++n) {
          const Dart d = smallest_dart(body->map->map(), orbit_of(from, dimension),
                                       Dart{noise.below(body->map->map().capacity())});
          if (from == Cell::Borders && body->map->map().is_free(dimension, d)) continue;
          const Candidate candidate{1, d, noise.vector().normalized()};
          Places places;
          one.find(body->view(), candidate, cell_of(*body, from, d), places);
          const Vec3 normal =
              from == Cell::Elements && places.count() > 0 ? places.normal(0) : candidate.normal;
          const Corners at = corners_of_cell(*body, from, d), best = expected(lists, from, to, at, normal);
          ASSERT_EQ(places.count() > 0, !best.empty());
          if (best.empty()) continue;
          ++found;
          EXPECT_EQ(corners_of_cell(*body, to, places.darts(0).front()), best);
          if (to != Cell::Vertices) {
            EXPECT_EQ(places.count(), 1u);
            continue;
          }
          EXPECT_EQ(places.count(), at.size()); // or else the next: each vertex of the cell once
          const Vec3 across = from == Cell::Edges     ? lists.along(at)
                              : from == Cell::Borders ? lists.across(at)
                                                      : normal;
          EXPECT_NEAR(std::abs(places.normal(0).dot(across)), 1, 1e-12);
        }
        EXPECT_GT(found, 3);
      }
  }
}

// Linear elements alone, without damping: Σ x fᵀ = −V σ up to the strain, which is 1e-7 here.
void expect_splits_across_stress(elements::NamedMap each, int& compared) {
  Body body;
  body.map = std::move(each.map);
  CornerMass mass;
  mass.density = 10;
  body.mass = &body.map->add(mass.on(*body.map));
  elements::add_elasticity(body, {"linear", "polar", 0});
  LawSettings law;
  law.criterion = find_criterion("atomic-element");
  law.cell = Cell::Elements;
  law.change = find_change("split-vertex"); // so that the forces of each element are evaluated
  body.tear_laws.emplace_back(body.request_for(law), law);
  body.prepare(*find_scheme("symplectic"));
  Noise noise(8);
  for (Slot v = 0; v < body.vertices(); ++v) {
    Vec3 by = 1e-7 * noise.vector();
    if (body.map->dimension() == 2) by.z() = 0;
    body.map->position()[v] = Record(body.map->rest()[v].vec() + by);
  }
  body.evaluate();
  const Continuum continuum(*body.map, body.interactions);
  const ForceView view = body.view();
  ASSERT_NE(view.corner, nullptr);
  continuum.each(view.position, nullptr, [&](const Continuum::Part& part, const CurrentUnit& element) {
    const Eigen::Matrix3d stress = stress_of(part, element);
    const Vec3 values = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress).eigenvalues();
    const bool pulled = values[2] > 1e-6 * stress.norm(); // of a sheet pressed from all sides the largest is 0
    const double next = pulled ? values[2] - values[1] : values[1] - values[0];
    if (next < 0.1 * stress.norm()) return; // the direction is hardly determined
    Places places;
    transfer(Cell::Elements, Cell::Vertices, body.map->dimension())
        .find(view, {1, element.owner, {}}, cell_of(body, Cell::Elements, element.owner), places);
    ASSERT_GT(places.count(), 0u);
    const Vec3 direction =
        largest_principal(stress, pulled ? Compression::Ignored : Compression::Counts).direction;
    EXPECT_GT(std::abs(places.normal(0).dot(direction)), 1 - 1e-6);
    ++compared;
  });
}

TEST(Transfer, splits_a_vertex_of_an_element_across_the_largest_principal_stress_of_the_element) {
  for (double warp : {0.0, 0.15}) {
    for (auto& each : elements::irregular_maps(warp)) {
      // The stress of a quad that is warped out of its plane is that of the quad made flat.
      if (warp > 0 && (each.name == "quads" || each.name == "mixed sheet")) continue;
      SCOPED_TRACE(each.name);
      int compared = 0;
      expect_splits_across_stress(std::move(each), compared);
      EXPECT_GT(compared, 3);
    }
  }
}

TEST(Transfer, chooses_by_the_smallest_dart_among_equals) {
  // Pulled along x alike everywhere: a quad inside is opened alike at both sides across x.
  const auto body =
      torn::body(sheet_from(meshes::sheet(SheetPattern::Quads, 5, 5)), {{"split-vertex", Cell::Edges}});
  for (Slot v = 0; v < body->vertices(); ++v) {
    const Vec3 rest = body->map->rest()[v];
    body->map->position()[v] = Record(Vec3(1.1 * rest.x(), rest.y(), 0));
    body->map->velocity()[v] = Record();
  }
  body->evaluate();
  for (double x : {1.5, 2.5, 3.5}) {
    const Dart d = smallest_dart(body->map->map(), FaceOfVolume, cell_at(*body, Cell::Elements, {x, 2.5, 0}));
    Places places;
    transfer(Cell::Elements, Cell::Borders, 2)
        .find(body->view(), {1, d, {}}, cell_of(*body, Cell::Elements, d), places);
    ASSERT_EQ(places.count(), 1u);
    const Dart chosen = smallest_dart(body->map->map(), Edge, places.darts(0).front());
    const auto side = [&](double at) {
      std::vector<Dart> own;
      const Corners edge = corners_of_cell(*body, Cell::Edges, cell_at(*body, Cell::Edges, {at, 2.5, 0}));
      for (Dart e : cell_of(*body, Cell::Elements, d))
        if (corners_of_cell(*body, Cell::Edges, e) == edge) own.push_back(e);
      return *std::min_element(own.begin(), own.end());
    };
    const double nearer = side(x - 0.5) < side(x + 0.5) ? x - 0.5 : x + 0.5;
    EXPECT_EQ(chosen, smallest_dart(body->map->map(), Edge, cell_at(*body, Cell::Edges, {nearer, 2.5, 0})));
  }
}

TEST(Transfer, is_told_in_the_words_of_sheets_and_solids) {
  EXPECT_EQ(told(transfer(Cell::Edges, Cell::Borders, 2), 2), "the edge itself");
  EXPECT_NE(told(transfer(Cell::Edges, Cell::Borders, 3), 3).find("face"), std::string::npos);
  EXPECT_NE(told(transfer(Cell::Borders, Cell::Elements, 2), 2).find("the face"), std::string::npos);
  EXPECT_NE(told(transfer(Cell::Borders, Cell::Elements, 3), 3).find("the volume"), std::string::npos);
  for (int dimension : {2, 3})
    for (Cell from : cells)
      for (Cell to : cells) {
        const Transfer& one = transfer(from, to, dimension);
        EXPECT_EQ(one.from, from);
        EXPECT_EQ(one.to, to);
        EXPECT_EQ(one.find == nullptr, orbit_of(from, dimension) == orbit_of(to, dimension));
        EXPECT_EQ(told(one, dimension).find('{'), std::string::npos);
      }
}

} // namespace
} // namespace rend::transfer_test
