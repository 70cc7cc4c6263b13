// Forces by walking the map, interaction by interaction, unit by unit, as in the thesis (6.3): the slow
// reference without rows, for --kernels walk and for tests.
#pragma once

#include "sim/mechanics/interaction.h"

namespace rend {

// Position [m], velocity [m/s] and force [N]: one record per vertex slot. Corner [N]: one per slot of
// `corner_orbit`, the contribution of each element corner; may be null. Both outputs are overwritten.
void walk_forces(const EmbeddedMap& map, const std::vector<std::unique_ptr<Interaction>>& interactions,
                 Orbit corner_orbit, const Record* position, const Record* velocity, Record* corner,
                 Record* force);

} // namespace rend
