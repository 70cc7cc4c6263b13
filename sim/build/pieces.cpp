#include "sim/build/pieces.h"

#include "sim/base/reach.h"
#include "sim/base/stop_request.h"
#include "sim/build/piece_parts.h"
#include "sim/mechanics/element.h"
#include "sim/mechanics/element_quality.h"

#include <fmt/format.h>

namespace rend {
namespace {

constexpr int most_pieces = 2000;
constexpr std::size_t samples_of_a_cell = 200;
constexpr int times_straightened = 4;

void check_elements(const EmbeddedMap& map, const SettingsSource& source) {
  bool fits = true;
  map.map().for_each_dart([&](Dart d) {
    const auto at = element_at(map.map(), d);
    fits = fits && at && (at->kind == ElementKind::Triangle || at->kind == ElementKind::Tetrahedron);
  });
  if (!fits)
    source.fail("", "pieces are cut out of triangles and tetrahedra, and this body has other elements",
                "pattern=\"triangles\" or \"crossed\" of <sheet>, \"tetrahedra\" of <bar>");
}

} // namespace

template <> const Fields<PiecesSettings>& fields_of() {
  using S = PiecesSettings;
  static const Fields<S> fields{
      field(&S::count, integer("count", "how many there are").at_least(2).at_most(most_pieces).is_required()),
      field(&S::pattern,
            word("pattern", {"voronoi", "radial", "slabs", "bricks"},
                 "voronoi: cells of seeds that are drawn; radial: wedges around an axis through at, along the "
                 "shortest side of the body, with chords across; slabs: planes across its longest side; "
                 "bricks: staggered courses")),
      field(&S::seed, integer("seed", "of voronoi and radial: another one gives other pieces").at_least(0)),
      field(&S::at,
            position("at", "of radial: where its rays meet, a point of the shape, before it is placed")),
      field(&S::strength,
            number("strength", "", "what the thresholds of laws are multiplied by on the walls between pieces")
                .above(1e-6)
                .at_most(1))};
  return fields;
}

void make_pieces(EmbeddedMap& map, const PiecesSettings& settings) {
  check_settings(settings);
  const SettingsSource& source = settings.source;
  check_elements(map, source);
  const auto count = static_cast<std::size_t>(settings.count);
  const std::size_t elements = map.use(element_orbit(map.dimension())).count();
  const std::string refusal = fmt::format("the {} elements of this body make no {} pieces", elements, count);
  if (count > elements) source.fail("count", refusal, "take smaller cells, or fewer pieces");
  const PiecePattern pattern = pattern_of(settings, samples_of(map, samples_of_a_cell * count));
  WallCutter cutter(map);
  for (const Wall& wall : pattern.walls) {
    throw_if_stop_is_due();
    cutter.cut(wall);
  }
  for (int n = 0; n < times_straightened; ++n) cutter.straighten();
  PieceColumn& pieces = map.add(PieceOfElement{}.on(map));
  const CellIndex& all = map.cells(pieces.orbit());
  for (Slot e = 0; e < all.slots(); ++e)
    if (all.alive(e)) pieces[e] = pattern.cell(element_centre(map, all.first_dart(e)));
  PieceParts parts(map, cutter, pieces);
  if (parts.settle(count)) return;
  if (parts.count() > count)
    source.fail("count", fmt::format("the body consists of {} parts that are not connected", parts.count()),
                "there are as many pieces at least");
  source.fail("count", refusal, "take smaller cells, or fewer pieces");
}

} // namespace rend
