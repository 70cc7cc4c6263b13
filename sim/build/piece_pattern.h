// How a body is divided into pieces: patterns of walls, for a given number of cells of about the same size.
//
//   voronoi   cell i is nearer to its seed s_i than to any other; seeds are drawn at random in the body, and
//             moved to the middles of their cells until the largest is twice the smallest (S. Lloyd, Least
//             squares quantization in PCM, IEEE Trans. Inf. Theory 1982)
//   radial    n rays from an axis along the shortest side of the body, as of a pane that is hit there, and in
//             each wedge between two of them K chords across its middle; n = π K, about
//   slabs     between planes across the longest side
//   bricks    between planes across its second longest side, the courses; each is divided along the longest
//             one, every other with half a brick at both ends. Bricks are twice as long as high, about
//
// Sides are those of the bounding box. Planes lie where a share of the body's volume (area) is on one side of
// them, which is measured by samples: points that are spread over the elements, each with a share of the
// volume.
#pragma once

#include "sim/base/settings.h"
#include "sim/cuts/wall.h"
#include "sim/embedding/embedded_map.h"

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace rend {

struct PiecesSettings {
  enum class Pattern { Voronoi, Radial, Slabs, Bricks };

  int count = 0;
  Pattern pattern = Pattern::Voronoi;
  int seed = 0;                // of voronoi and radial
  std::optional<Vec3> at = {}; // [m], of radial: a point on its axis
  double strength = 0.3;       // what thresholds are multiplied by on walls
  SettingsSource source = {};
};
template <> const Fields<PiecesSettings>& fields_of();

struct BodySample {
  Vec3 at;     // [m], at rest
  double size; // [m³], of a sheet [m²]
};
// At least `least` of them, and one in each element.
std::vector<BodySample> samples_of(const EmbeddedMap& map, std::size_t least);

struct PiecePattern {
  std::vector<Wall> walls;
  std::function<std::uint32_t(const Vec3&)> cell; // in which a point lies
};

// UserError: no point for radial, or one of no use.
PiecePattern pattern_of(const PiecesSettings& settings, const std::vector<BodySample>& samples);

PiecePattern voronoi_pattern(const PiecesSettings& settings, const std::vector<BodySample>& samples);
PiecePattern radial_pattern(const PiecesSettings& settings, const std::vector<BodySample>& samples);
PiecePattern slab_pattern(const PiecesSettings& settings, const std::vector<BodySample>& samples);
PiecePattern brick_pattern(const PiecesSettings& settings, const std::vector<BodySample>& samples);

// The bounding box of the samples, and unit vectors along its sides, the longest first.
struct SampleBox {
  Vec3 low, high;
  std::array<Vec3, 3> along;
  std::array<double, 3> length; // [m]
};
SampleBox box_of(const std::vector<BodySample>& samples);

// Keys below which given shares of all sizes lie, increasing.
struct SizedKey {
  double key, size;
};
std::vector<double> quantiles(std::vector<SizedKey> keys, const std::vector<double>& shares);

// A draw between 0 and 1.
double drawn(std::uint64_t number, int seed);

} // namespace rend
