// Forces by walking the map, interaction after interaction, unit after unit, as the thesis did (thesis 6.3):
// the slow reference that needs no rows, for --kernels walk and for tests.
#pragma once

#include "sim/mechanics/interaction.h"

namespace rend {

// Position [m], velocity [m/s] and force [N]: one record per vertex slot. Corner [N]: one per slot of
// `corner_orbit`, each element corner's own share; may be null. Both outputs are overwritten.
void walk_forces(const EmbeddedMap& map, const std::vector<std::unique_ptr<Interaction>>& interactions,
                 Orbit corner_orbit, const Record* position, const Record* velocity, Record* corner,
                 Record* force);

} // namespace rend
