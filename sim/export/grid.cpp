#include "sim/export/grid.h"

#include "sim/body/probe.h"
#include "sim/export/element_stress.h"
#include "sim/export/obstacle_skin.h"
#include "sim/mechanics/element.h"
#include "sim/mechanics/winding.h"
#include "sim/mesh/cell_shapes.h"
#include "sim/topology/count.h"
#include "sim/topology/walk.h"

#include <algorithm>
#include <utility>

namespace rend {
namespace {

// The data on points, while they are collected.
struct OnPoints {
  std::vector<double> rest, velocity, mass;
  std::vector<std::int64_t> vertex, body;
  std::vector<std::uint8_t> prescribed;
};

// The data on cells.
struct OnCells {
  std::vector<std::int64_t> element, body, fragment;
  std::vector<double> stress, equivalent; // empty: no body has finite elements
};

CellKind cell_kind(ElementKind kind) {
  switch (kind) {
  case ElementKind::Hexahedron:
    return CellKind::Hexahedron;
  case ElementKind::Prism:
    return CellKind::Prism;
  case ElementKind::Pyramid:
    return CellKind::Pyramid;
  default:
    return CellKind::Tetrahedron;
  }
}

GridCell grid_cell(ElementKind kind) {
  switch (kind) {
  case ElementKind::Triangle:
    return GridCell::Triangle;
  case ElementKind::Quad:
    return GridCell::Quad;
  case ElementKind::Tetrahedron:
    return GridCell::Tetrahedron;
  case ElementKind::Hexahedron:
    return GridCell::Hexahedron;
  case ElementKind::Prism:
    return GridCell::Prism;
  default:
    return GridCell::Pyramid;
  }
}

// Appends one body to the grid.
class BodyCells {
public:
  // picture: of a sheet; null: it has none.
  BodyCells(const Body& body, std::int64_t number, const Sides& sides, const SkinPicture* picture, Grid& grid)
      : body_(body), map_(*body.map), number_(number), sides_(sides), picture_(picture), grid_(grid) {}

  void add_points(OnPoints& on);
  // `fragments`: the number in the bodies before; increased by those of this body.
  void add_cells(OnCells& on, std::int64_t& fragments);

private:
  void add_cell(Dart first);
  void add_face(Dart first);
  void add_polyhedron(Dart first);
  void add_corner(Dart d) { grid_.corners.push_back(point_[map_.vertex(d)]); }
  void close(GridCell kind);
  void add_stress(OnCells& on) const;

  const Body& body_;
  const EmbeddedMap& map_;
  std::int64_t number_;
  const Sides& sides_;
  const SkinPicture* picture_;
  Grid& grid_;
  std::vector<std::int64_t> point_; // of each vertex slot
  std::vector<Dart> elements_;      // the smallest dart of each appended cell
  std::vector<Dart> ring_;          // scratch: the corners of a face
};

void BodyCells::add_points(OnPoints& on) {
  const CellIndex& vertices = map_.cells(Vertex);
  std::vector<std::uint8_t> axes(vertices.slots(), 0);
  body_.constraints.mark(body_.time(), axes.data());
  point_.assign(vertices.slots(), -1);
  for (Slot v = 0; v < vertices.slots(); ++v) {
    if (!vertices.alive(v)) continue;
    point_[v] = static_cast<std::int64_t>(grid_.points.size() / 3);
    append(grid_.points, map_.position()[v]);
    append(on.rest, map_.rest()[v]);
    append(on.velocity, map_.velocity()[v]);
    on.mass.push_back(sum_at_vertex(map_, body_.mass->orbit(), body_.mass->values(), vertices.first_dart(v)));
    on.vertex.push_back(v);
    on.body.push_back(number_);
    on.prescribed.push_back(axes[v]);
  }
}

void BodyCells::add_cells(OnCells& on, std::int64_t& fragments) {
  const GMap& map = map_.map();
  const std::vector<std::uint32_t> labels = label_fragments(map);
  std::vector<bool> seen(map.capacity(), false); // darts of appended elements
  std::vector<Dart> darts;
  std::int64_t most = 0;
  map.for_each_dart([&](Dart first) {
    if (seen[first.value]) return;
    darts.clear();
    collect(map, element_orbit(map.dimension()), first, darts);
    for (const Dart d : darts) seen[d.value] = true;
    add_cell(first);
    on.element.push_back(first.value);
    on.body.push_back(number_);
    on.fragment.push_back(fragments + labels[first.value]);
    most = std::max<std::int64_t>(most, labels[first.value] + 1);
  });
  fragments += most;
  add_stress(on);
}

void BodyCells::add_cell(Dart first) {
  elements_.push_back(first);
  if (map_.dimension() == 2) return add_face(first);
  const std::optional<ElementPlace> place = element_at(map_.map(), first);
  if (!place) return add_polyhedron(first);
  const std::vector<Word>& words = shape_of(place->kind).units[place->unit];
  std::array<Dart, most_particles> corner{};
  for (std::size_t n = 0; n < words.size(); ++n) corner[n] = map_.map().follow(first, words[n]);
  // The first ring must be counter-clockwise as seen from inside.
  if (winds_outward(map_, corner[0]))
    for (const auto& [a, b] : shape_of(cell_kind(place->kind)).mirror)
      std::swap(corner[static_cast<std::size_t>(a)], corner[static_cast<std::size_t>(b)]);
  for (std::size_t n = 0; n < words.size(); ++n) add_corner(corner[n]);
  close(grid_cell(place->kind));
}

void BodyCells::add_face(Dart first) {
  const GMap& map = map_.map();
  const Dart start = sides_.of_dart[first.value] == 1 ? first : map.alpha(0, first);
  ring_.clear();
  for (Dart at = start; at != start || ring_.empty(); at = map.follow(at, to_next_side)) ring_.push_back(at);
  if (picture_) { // cells before this one may have none
    grid_.texture.resize(grid_.corners.size());
    picture_->lay(ring_, false, grid_.texture);
  }
  for (const Dart d : ring_) add_corner(d);
  close(ring_.size() == 3 ? GridCell::Triangle : ring_.size() == 4 ? GridCell::Quad : GridCell::Polygon);
}

void BodyCells::add_polyhedron(Dart first) {
  const GMap& map = map_.map();
  const std::size_t begin = grid_.corners.size(), count = grid_.faces.size();
  grid_.faces.push_back(0);
  std::vector<Dart> starts{winds_outward(map_, first) ? first : map.alpha(0, first)};
  IndexSet seen; // darts of visited faces
  for (std::size_t n = 0; n < starts.size(); ++n) {
    if (seen.contains(starts[n].value)) continue;
    const std::size_t sides = grid_.faces.size();
    grid_.faces.push_back(0);
    Dart at = starts[n];
    do {
      seen.insert(at.value);
      starts.push_back(map.follow(at, to_next_face));
      grid_.faces.push_back(point_[map_.vertex(at)]);
      grid_.corners.push_back(grid_.faces.back());
      ++grid_.faces[sides];
      at = map.follow(at, to_next_side);
    } while (at != starts[n]);
    ++grid_.faces[count];
  }
  const auto own = grid_.corners.begin() + static_cast<std::ptrdiff_t>(begin);
  std::sort(own, grid_.corners.end()); // then without duplicates
  grid_.corners.erase(std::unique(own, grid_.corners.end()), grid_.corners.end());
  close(GridCell::Polyhedron);
}

void BodyCells::close(GridCell kind) {
  grid_.kinds.push_back(kind);
  grid_.ends.push_back(static_cast<std::int64_t>(grid_.corners.size()));
  grid_.face_ends.push_back(kind == GridCell::Polyhedron ? static_cast<std::int64_t>(grid_.faces.size()) : -1);
}

void BodyCells::add_stress(OnCells& on) const {
  const std::size_t before = on.element.size() - elements_.size();
  if (on.stress.empty() && !has_stress(body_)) return;
  on.stress.resize(9 * before, 0);
  on.equivalent.resize(before, 0);
  for (const Eigen::Matrix3d& stress : stress_of_elements(body_, elements_)) {
    for (int row = 0; row < 3; ++row) append(on.stress, stress.row(row));
    on.equivalent.push_back(von_mises(stress));
  }
}

void add_obstacle(const ObstacleSkin& obstacle, std::int64_t number, Grid& grid, OnPoints& on_points,
                  OnCells& on_cells) {
  const auto first = static_cast<std::int64_t>(grid.points.size() / 3);
  for (std::size_t p = 0; p < obstacle.points.size(); ++p) {
    append(grid.points, obstacle.points[p]);
    append(on_points.rest, obstacle.start[p]);
    append(on_points.velocity, obstacle.velocities[p]);
    on_points.mass.push_back(0);
    on_points.vertex.push_back(static_cast<std::int64_t>(p));
    on_points.body.push_back(number);
    on_points.prescribed.push_back(0);
  }
  obstacle.each_face([&](std::span<const std::int32_t> face) {
    for (const std::int32_t p : face) grid.corners.push_back(first + p);
    grid.kinds.push_back(face.size() == 4 ? GridCell::Quad : GridCell::Triangle);
    grid.ends.push_back(static_cast<std::int64_t>(grid.corners.size()));
    grid.face_ends.push_back(-1);
    on_cells.element.push_back(0);
    on_cells.body.push_back(number);
    on_cells.fragment.push_back(-1);
  });
  if (on_cells.stress.empty()) return;
  on_cells.stress.resize(9 * on_cells.element.size(), 0);
  on_cells.equivalent.resize(on_cells.element.size(), 0);
}

} // namespace

GridMaker::GridMaker(const Scene& scene, SkinPictures pictures)
    : scene_(&scene), pictures_(std::move(pictures)) {
  for (const auto& body : scene.bodies())
    sides_.push_back(body->map->dimension() == 2 ? sides_of(body->map->map()) : Sides{});
  for (std::size_t n = 0; n < sides_.size(); ++n) textured_ = textured_ || picture_of(n);
}

const SkinPicture* GridMaker::picture_of(std::size_t body) const {
  if (pictures_.empty() || scene_->bodies()[body]->map->dimension() == 3) return nullptr;
  return pictures_[body].outside.picture.empty() ? nullptr : &pictures_[body];
}

Grid GridMaker::grid() const {
  Grid grid;
  grid.time = scene_->time();
  OnPoints on_points;
  OnCells on_cells;
  std::int64_t fragments = 0;
  for (std::size_t n = 0; n < sides_.size(); ++n) {
    BodyCells cells(*scene_->bodies()[n], static_cast<std::int64_t>(n), sides_[n], picture_of(n), grid);
    cells.add_points(on_points);
    cells.add_cells(on_cells, fragments);
  }
  auto number = static_cast<std::int64_t>(sides_.size());
  for (const ObstacleSkin& obstacle : obstacle_skins(scene_->world(), grid.time))
    add_obstacle(obstacle, number++, grid, on_points, on_cells);
  if (textured_) grid.texture.resize(grid.corners.size());
  grid.on_points = {{"rest", 3, std::move(on_points.rest)}, {"velocity", 3, std::move(on_points.velocity)},
                    {"mass", 1, std::move(on_points.mass)}, {"vertex", 1, std::move(on_points.vertex)},
                    {"body", 1, std::move(on_points.body)}, {"prescribed", 1, std::move(on_points.prescribed)}};
  grid.on_cells = {{"element", 1, std::move(on_cells.element)},
                   {"body", 1, std::move(on_cells.body)},
                   {"fragment", 1, std::move(on_cells.fragment)}};
  if (on_cells.stress.empty()) return grid;
  grid.on_cells.push_back({"stress", 9, std::move(on_cells.stress)});
  grid.on_cells.push_back({"von Mises stress", 1, std::move(on_cells.equivalent)});
  return grid;
}

} // namespace rend
