#include "sim/fracture/transfer.h"

#include "sim/base/check.h"
#include "sim/fracture/border.h"
#include "sim/mechanics/mass.h"
#include "sim/rows/continuum.h"
#include "sim/topology/walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace rend {
namespace {

using Cells = std::span<const Dart>;

// One side of a border: an edge of one face of a sheet, one side of a face of a solid.
Orbit side_orbit(const EmbeddedMap& map) {
  return map.dimension() == 2 ? EdgeOfFace : FaceOfVolume;
}

// The force [N] that the element of d applies at its corner there.
Vec3 force_at(const ForceView& view, Dart d) {
  return view.corner[view.map.slot(corner_orbit(view.map.dimension()), d)].vec();
}

// The sum [N] over the corners of these darts.
Vec3 force_on(const ForceView& view, Cells darts) {
  Vec3 sum = Vec3::Zero();
  for (Slot c : corners_of(view.map, darts)) sum += view.corner[c].vec();
  return sum;
}

// Σ |f·u| [N] over the corners of these darts.
double pull_at(const ForceView& view, Cells darts, const Vec3& along) {
  double sum = 0;
  for (Slot c : corners_of(view.map, darts)) sum += std::abs(view.corner[c].vec().dot(along));
  return sum;
}

// The unit vector along the edge of d, away from d; 0 if it has no length.
Vec3 along_edge(const ForceView& view, Dart d) {
  const Dart other = view.map.map().alpha(0, d);
  Vec3 along = view.position[view.map.vertex(other)].vec() - view.position[view.map.vertex(d)].vec();
  const double length = along.norm();
  if (length > 0) along /= length;
  return along;
}

// By how much the element of d pulls the ends of its edge together or apart [N].
double tension_of(const ForceView& view, Dart d) {
  return std::abs((force_at(view, d) - force_at(view, view.map.map().alpha(0, d))).dot(along_edge(view, d)));
}

// The direction in which an element is pulled most; if it is pressed from all sides, pressed most.
Vec3 pull_on_element(const ForceView& view, Cells element) {
  const Vec3 middle = middle_of(view.map, view.position, element);
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero(); // times volume [N.m]
  const CellIndex& corners = view.map.cells(corner_orbit(view.map.dimension()));
  for (Slot c : corners_of(view.map, element)) {
    const Vec3 arm = view.position[view.map.vertex(corners.first_dart(c))].vec() - middle;
    stress -= arm * view.corner[c].vec().transpose();
  }
  stress = (0.5 * (stress + stress.transpose())).eval();
  const Principal pulled = largest_principal(stress, Compression::Ignored);
  const Principal either = largest_principal(stress, Compression::Counts);
  return pulled.value > 1e-9 * either.value ? pulled.direction : either.direction;
}

// The darts of a list in increasing order.
std::vector<Dart> sorted(Cells darts) {
  std::vector<Dart> list(darts.begin(), darts.end());
  std::sort(list.begin(), list.end());
  return list;
}

// The smallest dart of each orbit among these darts, which are whole orbits.
std::vector<Dart> firsts(const GMap& map, Orbit orbit, Cells darts) {
  std::vector<Dart> list = sorted(darts);
  std::erase_if(list, [&](Dart d) { return smallest_dart(map, orbit, d) != d; });
  return list;
}

// Cells to choose from, by their values.
class Choice {
public:
  void offer(double value, Dart d) {
    if (value > 0) offers_.push_back({value, d});
  }
  // The darts that were offered, by decreasing value.
  std::vector<Dart> ranked() {
    double most = 0;
    for (const Offer& each : offers_) most = std::max(most, each.value);
    for (Offer& each : offers_) each.value = std::round(each.value / most * 1e9);
    std::sort(offers_.begin(), offers_.end(), [](const Offer& a, const Offer& b) {
      return a.value != b.value ? a.value > b.value : a.dart < b.dart;
    });
    std::vector<Dart> list;
    for (const Offer& each : offers_) list.push_back(each.dart);
    return list;
  }
  // All darts of the orbit with the largest value.
  void put_best(const GMap& map, Orbit orbit, Places& places) {
    if (!offers_.empty()) places.add(darts_of(map, orbit, ranked().front()));
  }

private:
  struct Offer {
    double value;
    Dart dart;
  };
  std::vector<Offer> offers_;
};

// Offers the borders at a vertex, by how much they are opened there in a direction.
void offer_borders_at(const ForceView& view, Cells vertex, const Vec3& direction, Choice& choice) {
  const GMap& map = view.map.map();
  const int link = map.dimension();
  for (Dart d : firsts(map, link == 2 ? EdgeEnd : VertexOfFaceBothSides, vertex))
    if (!map.is_free(link, d))
      choice.offer(std::abs((force_at(view, d) - force_at(view, map.alpha(link, d))).dot(direction)), d);
}

void edge_to_border(const ForceView& view, const Candidate& candidate, Cells, Places& places) {
  const GMap& map = view.map.map();
  const Vec3 along = along_edge(view, candidate.dart);
  Choice choice;
  offer_borders_at(view, darts_of(map, Vertex, candidate.dart), along, choice);
  offer_borders_at(view, darts_of(map, Vertex, map.alpha(0, candidate.dart)), along, choice);
  choice.put_best(map, orbit_of(Cell::Borders, map.dimension()), places);
}

void edge_to_element(const ForceView& view, const Candidate&, Cells edge, Places& places) {
  const GMap& map = view.map.map();
  Choice choice;
  for (Dart d : firsts(map, map.dimension() == 2 ? EdgeOfFace : EdgeOfVolume, edge))
    choice.offer(tension_of(view, d), d);
  choice.put_best(map, element_orbit(map.dimension()), places);
}

// As the ends of one spring: at each end the elements around the edge alone count.
void edge_to_vertex(const ForceView& view, const Candidate&, Cells edge, Places& places) {
  std::vector<Dart> first, second; // darts of the edge at each end
  const Slot here = view.map.vertex(edge.front());
  for (Dart d : edge) (view.map.vertex(d) == here ? first : second).push_back(d);
  const Vec3 along = along_edge(view, edge.front());
  if (second.empty() || along.isZero(0)) return; // a loop, or without length
  if (pull_at(view, second, along) > pull_at(view, first, along)) std::swap(first, second);
  places.add(first, along);
  places.add(second, along);
}

void border_to_element(const ForceView& view, const Candidate& candidate, Cells, Places& places) {
  const GMap& map = view.map.map();
  const Dart d = candidate.dart, other = map.alpha(map.dimension(), d);
  if (other == d) return;
  const Vec3 normal = across_border(view.map, view.position, d);
  Choice choice;
  for (Dart side : {d, other})
    choice.offer(std::abs(force_on(view, darts_of(map, side_orbit(view.map), side)).dot(normal)), side);
  choice.put_best(map, element_orbit(map.dimension()), places);
}

// |(f_1 − f_2)·n| at the vertex of d, whose border is sewn.
double opening_at(const ForceView& view, Dart d, const Vec3& normal) {
  const Dart other = view.map.map().alpha(view.map.dimension(), d);
  return std::abs((force_at(view, d) - force_at(view, other)).dot(normal));
}

void border_to_vertex(const ForceView& view, const Candidate& candidate, Cells border, Places& places) {
  const GMap& map = view.map.map();
  if (map.is_free(map.dimension(), candidate.dart)) return;
  const Vec3 normal = across_border(view.map, view.position, candidate.dart);
  const Orbit end = map.dimension() == 2 ? EdgeEnd : VertexOfFaceBothSides;
  Choice choice;
  for (Dart d : firsts(map, end, border)) choice.offer(opening_at(view, d, normal), d);
  for (Dart d : choice.ranked()) places.add(darts_of(map, end, d), normal);
}

void border_to_edge(const ForceView& view, const Candidate& candidate, Cells border, Places& places) {
  const GMap& map = view.map.map();
  if (map.is_free(map.dimension(), candidate.dart)) return;
  const Vec3 normal = across_border(view.map, view.position, candidate.dart);
  Choice choice;
  for (Dart d : firsts(map, EdgeOfFaceBothSides, border))
    choice.offer(opening_at(view, d, normal) + opening_at(view, map.alpha(0, d), normal), d);
  choice.put_best(map, Edge, places);
}

void vertex_to_border(const ForceView& view, const Candidate& candidate, Cells vertex, Places& places) {
  Choice choice;
  offer_borders_at(view, vertex, candidate.normal, choice);
  choice.put_best(view.map.map(), orbit_of(Cell::Borders, view.map.dimension()), places);
}

void vertex_to_element(const ForceView& view, const Candidate& candidate, Cells vertex, Places& places) {
  const GMap& map = view.map.map();
  Choice choice;
  for (Dart d : firsts(map, corner_orbit(map.dimension()), vertex))
    choice.offer(std::abs(force_at(view, d).dot(candidate.normal)), d);
  choice.put_best(map, element_orbit(map.dimension()), places);
}

void vertex_to_edge(const ForceView& view, const Candidate&, Cells vertex, Places& places) {
  const GMap& map = view.map.map();
  Choice choice;
  for (Dart d : firsts(map, EdgeEnd, vertex))
    choice.offer(pull_at(view, darts_of(map, EdgeEnd, d), along_edge(view, d)), d);
  choice.put_best(map, Edge, places);
}

void element_to_border(const ForceView& view, const Candidate&, Cells element, Places& places) {
  const GMap& map = view.map.map();
  const int link = map.dimension();
  Choice choice;
  for (Dart d : firsts(map, side_orbit(view.map), element)) {
    if (map.is_free(link, d)) continue;
    const std::vector<Dart> own = darts_of(map, side_orbit(view.map), d);
    const std::vector<Dart> other = darts_of(map, side_orbit(view.map), map.alpha(link, d));
    const Vec3 normal = across_border(view.map, view.position, d);
    choice.offer(std::abs((force_on(view, own) - force_on(view, other)).dot(normal)), d);
  }
  choice.put_best(map, orbit_of(Cell::Borders, link), places);
}

void element_to_vertex(const ForceView& view, const Candidate&, Cells element, Places& places) {
  const GMap& map = view.map.map();
  const Orbit corner = corner_orbit(map.dimension());
  const Vec3 direction = pull_on_element(view, element);
  Choice choice;
  for (Dart d : firsts(map, corner, element)) choice.offer(std::abs(force_at(view, d).dot(direction)), d);
  for (Dart d : choice.ranked()) places.add(darts_of(map, corner, d), direction);
}

void element_to_edge(const ForceView& view, const Candidate&, Cells element, Places& places) {
  const GMap& map = view.map.map();
  Choice choice;
  for (Dart d : firsts(map, map.dimension() == 2 ? EdgeOfFace : EdgeOfVolume, element))
    choice.offer(tension_of(view, d), d);
  choice.put_best(map, Edge, places);
}

const std::vector<Transfer>& between_cells() {
  using enum Cell;
  static const std::vector<Transfer> list{
      {Edges, Borders, "at its ends, the {border} that is opened most along the edge", edge_to_border},
      {Edges, Elements, "the {element} that pulls its ends together most", edge_to_element},
      {Edges, Vertices, "its end that is pulled more, across the edge; or else the other", edge_to_vertex},
      {Borders, Elements, "the {element} that pulls more across it", border_to_element},
      {Borders, Vertices, "its vertex where it is opened most, along it; or else the next", border_to_vertex},
      {Borders, Edges, "its edge where it is opened most", border_to_edge},
      {Vertices, Borders, "the {border} at it that is opened most across the plane", vertex_to_border},
      {Vertices, Elements, "the {element} at it that pulls most across the plane", vertex_to_element},
      {Vertices, Edges, "the edge at it that is pulled most", vertex_to_edge},
      {Elements, Borders, "its {border} that is opened most", element_to_border},
      {Elements, Vertices, "its vertex that it pulls most along its largest stress; or else the next",
       element_to_vertex},
      {Elements, Edges, "its edge that it pulls together most", element_to_edge}};
  return list;
}

constexpr std::array every_cell{Cell::Edges, Cell::Borders, Cell::Vertices, Cell::Elements};

// Where the cell itself is the place: of one kind, or an edge as the border of a sheet.
const std::vector<Transfer>& to_itself() {
  static const std::vector<Transfer> list = [] {
    std::vector<Transfer> out;
    for (Cell from : every_cell)
      for (Cell to : every_cell) out.push_back({from, to, "the {cell} itself", nullptr});
    return out;
  }();
  return list;
}

} // namespace

void Places::add(std::span<const Dart> darts, const Vec3& normal) {
  CHECK(!darts.empty());
  darts_.insert(darts_.end(), darts.begin(), darts.end());
  ends_.push_back(darts_.size());
  normals_.push_back(normal);
}

void Places::clear() {
  darts_.clear();
  ends_.clear();
  normals_.clear();
}

std::span<const Dart> Places::darts(std::size_t place) const {
  const std::size_t begin = place == 0 ? 0 : ends_[place - 1];
  return std::span(darts_).subspan(begin, ends_[place] - begin);
}

std::size_t Places::bytes() const {
  return darts_.capacity() * sizeof(Dart) + ends_.capacity() * sizeof(std::size_t) +
         normals_.capacity() * sizeof(Vec3);
}

const Transfer& transfer(Cell from, Cell to, int dimension) {
  const bool itself = orbit_of(from, dimension) == orbit_of(to, dimension);
  const std::vector<Transfer>& list = itself ? to_itself() : between_cells();
  const auto found = std::find_if(list.begin(), list.end(),
                                  [&](const Transfer& one) { return one.from == from && one.to == to; });
  CHECK(found != list.end());
  return *found;
}

std::string told(const Transfer& transfer, int dimension) {
  return fmt::format(fmt::runtime(transfer.what), fmt::arg("cell", name_of(transfer.from, dimension)),
                     fmt::arg("border", name_of(Cell::Borders, dimension)),
                     fmt::arg("element", name_of(Cell::Elements, dimension)));
}

void grown(const GMap& map, Orbit orbit, std::span<const Dart> darts, std::vector<Dart>& out) {
  out.clear();
  for (Dart d : darts)
    if (map.alive(d)) collect(map, orbit, d, out);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
}

} // namespace rend
