#include "sim/mechanics/mass_tensor.h"

#include "sim/base/check.h"
#include "sim/mechanics/elasticity.h"
#include "sim/mechanics/mass.h"
#include "sim/topology/walk.h"

#include <algorithm>

namespace rend {

ElementTensors element_tensors(const ElementShape& shape, const std::vector<Vec3>& rest,
                               const MassTensorRequest& request) {
  const int dim = shape.dimension;
  const Eigen::Matrix3d frame = dim == 2 ? rest_frame(shape, rest.data()) : Eigen::Matrix3d::Identity();
  std::vector<double> values(static_cast<std::size_t>(shape.values()));
  if (!write_element(shape, rest.data(), frame, request.thickness, values.data()))
    refuse_flat_element(request.place, shape, rest);
  ElementTensors tensors{shape.kind, shape.corners, 0, {}};
  tensors.largest = largest_stiffness(shape, values.data(), request.material, nullptr);
  for (auto& row : tensors.K) row.fill(Eigen::Matrix3d::Zero());
  const Eigen::Matrix3d across = frame.leftCols(dim) * frame.leftCols(dim).transpose();
  const double* at = values.data();
  for (const ReferencePoint& point : shape.points) {
    std::array<Vec3, most_particles> g; // in world axes
    for (std::size_t n = 0; n < static_cast<std::size_t>(shape.corners); ++n) {
      g[n].setZero();
      for (int r = 0; r < dim; ++r)
        for (int c = 0; c < dim; ++c)
          g[n] += point.gradient[n][static_cast<std::size_t>(r)] * at[r * dim + c] * frame.col(c);
    }
    const double lambda = at[dim * dim] * request.material.lambda, mu = at[dim * dim] * request.material.mu;
    for (std::size_t i = 0; i < static_cast<std::size_t>(shape.corners); ++i)
      for (std::size_t j = 0; j < static_cast<std::size_t>(shape.corners); ++j)
        tensors.K[i][j] +=
            lambda * g[i] * g[j].transpose() + mu * g[j] * g[i].transpose() + mu * g[i].dot(g[j]) * across;
    at += dim * dim + 1;
  }
  return tensors;
}

namespace {

// The corner of d in its element, named by its smallest dart.
Dart corner_of(const GMap& map, Dart d) {
  if (map.dimension() == 2) return std::min(d, map.alpha(1, d));
  Dart least = d;
  walk_two(map, 1, 2, d, [&](Dart e) { least = std::min(least, e); });
  return least;
}

// The element of a dart, and the tensors between its corners.
class ElementAround {
public:
  ElementAround(const EmbeddedMap& body, const MassTensorRequest& request, Dart d) : map_(body.map()) {
    std::optional<ElementPlace> at = element_at(map_, d);
    if (!at) return;
    first_ = at->first; // the same order of corners for all darts of the element
    if (first_ != d) at = element_at(map_, first_);
    const ElementShape& shape = shape_of(at->kind);
    words_ = &shape.units[at->unit];
    tensors_ = &remembered(shape, rest_positions(body, first_, *words_), request);
  }

  const ElementTensors* tensors() const { return tensors_; } // null: no element. Valid until the next element

  std::size_t corner(Dart d) const { // index of the corner of d
    const Dart at = corner_of(map_, d);
    std::size_t n = 0;
    while (n < words_->size() && corner_of(map_, map_.follow(first_, (*words_)[n])) != at) ++n;
    CHECK(n < words_->size());
    return n;
  }

private:
  // The last element's tensors are cached: owners in the same element come consecutively.
  static const ElementTensors& remembered(const ElementShape& shape, std::vector<Vec3> rest,
                                          const MassTensorRequest& request) {
    struct Memory {
      std::vector<Vec3> rest;
      double lambda = 0, mu = 0, thickness = 0;
      ElementTensors tensors{};
    };
    thread_local Memory memory;
    const ElasticMaterial& m = request.material;
    if (memory.rest.empty() || memory.tensors.kind != shape.kind || memory.rest != rest ||
        memory.lambda != m.lambda || memory.mu != m.mu || memory.thickness != request.thickness) {
      memory.rest.clear(); // stays empty if the next line throws
      memory.tensors = element_tensors(shape, rest, request);
      memory.rest = std::move(rest);
      memory.lambda = m.lambda;
      memory.mu = m.mu;
      memory.thickness = request.thickness;
    }
    return memory.tensors;
  }

  const GMap& map_;
  Dart first_;
  const std::vector<Word>* words_ = nullptr;
  const ElementTensors* tensors_ = nullptr;
};

void write(const Eigen::Matrix3d& K, double* to) {
  Eigen::Map<Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>{to} = K;
}

// Tensors on an orbit: `Values` numbers for each of `Units` units; 0 if there is none.
template <int Units, int Values> struct TensorEmbedding {
  using Value = std::array<double, Units * Values>;
  std::string name;
  Orbit orbit, support;
  std::vector<std::vector<Word>> units;
  bool (*present)(const GMap&, Dart, std::size_t);
  MassTensorRequest request;

  Value birth(const EmbeddedMap& map, Dart d) const {
    Value value{};
    const ElementAround element(map, request, d);
    if (!element.tensors()) return value;
    for (std::size_t unit = 0; unit < units.size(); ++unit) {
      if (!present(map.map(), d, unit)) continue;
      double* to = value.data() + unit * Values;
      const std::size_t i = element.corner(map.map().follow(d, units[unit].front()));
      const std::size_t j = element.corner(map.map().follow(d, units[unit].back()));
      write(element.tensors()->K[i][j], to);
      if (Values == 10) to[Values - 1] = element.tensors()->largest;
    }
    return value;
  }
  Value split(const Value& whole) const { return whole; }
};

template <int Units, int Values>
std::unique_ptr<Interaction> made(EmbeddedMap& map, const std::string& name,
                                  std::shared_ptr<const ForceLaw> law, Pattern pattern,
                                  const MassTensorRequest& request) {
  struct Carried final : Interaction {
    const Column<TensorEmbedding<Units, Values>>* column = nullptr;
    const double* unit(Slot owner, std::size_t unit) const override {
      return (*column)[owner].data() + unit * Values;
    }
  };
  pattern.support = element_orbit(map.dimension());
  pattern.fold = {map.dimension() == 2 ? "2" : "3"};
  auto interaction = std::make_unique<Carried>();
  interaction->column = &map.add(TensorEmbedding<Units, Values>{name, pattern.owner, pattern.support,
                                                                pattern.units, pattern.present, request});
  interaction->name = name;
  interaction->law = std::move(law);
  interaction->pattern = std::move(pattern);
  interaction->damped = request.material.damping > 0;
  return interaction;
}

bool whole_edge(const GMap& map, Dart d, std::size_t) {
  return !map.is_free(0, d);
}
bool always(const GMap&, Dart, std::size_t) {
  return true;
}
bool in_quad(const GMap& map, Dart d, std::size_t) {
  return sides_of_face(map, d) == 4;
}
} // namespace

std::vector<std::unique_ptr<Interaction>> make_mass_tensors(EmbeddedMap& map, const MassTensorRequest& request,
                                                            std::vector<AwaitedInteraction>* awaited) {
  const bool sheet = map.dimension() == 2;
  bool any = false, quads = false, hexahedra = false;
  const CellIndex& elements = map.use(element_orbit(map.dimension()));
  for (Slot e = 0; e < elements.slots(); ++e) {
    if (!elements.alive(e)) continue;
    const auto at = element_at(map.map(), elements.first_dart(e));
    if (!at) continue;
    any = true;
    quads = quads || (at->kind != ElementKind::Triangle && at->kind != ElementKind::Tetrahedron);
    hexahedra = hexahedra || at->kind == ElementKind::Hexahedron;
  }
  std::vector<std::unique_ptr<Interaction>> all;
  if (!any) return all;
  const auto pair = pair_tensor_law(request);
  all.push_back(made<1, 10>(map, "mass-tensor vertices", vertex_tensor_law(request),
                            {corner_orbit(map.dimension()), {}, {{""}}, {}, &always}, request));
  all.push_back(made<1, 9>(map, "mass-tensor edges", pair,
                           {sheet ? EdgeOfFace : EdgeOfVolume, {}, {{"", "0"}}, {}, &whole_edge}, request));
  const auto add = [&](bool there, const std::string& name, const Pattern& pattern, auto make) {
    if (there)
      all.push_back(make(map));
    else if (awaited)
      awaited->push_back({name, pair, pattern, make});
  };
  const Pattern in_faces{FaceOfVolume, {}, {{"", "010"}, {"0", "10"}}, {}, &in_quad};
  add(quads, "mass-tensor face diagonals", in_faces,
      [=](EmbeddedMap& to) { return made<2, 9>(to, "mass-tensor face diagonals", pair, in_faces, request); });
  const Pattern in_volumes{
      Volume,
      {},
      {{"", "010210"}, {"0", "10210"}, {"010", "210"}, {"10", "0210"}},
      {},
      [](const GMap& m, Dart d, std::size_t) { return element_present<ElementKind::Hexahedron>(m, d, 0); }};
  if (!sheet)
    add(hexahedra, "mass-tensor volume diagonals", in_volumes, [=](EmbeddedMap& to) {
      return made<4, 9>(to, "mass-tensor volume diagonals", pair, in_volumes, request);
    });
  return all;
}

} // namespace rend
