#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// Sews two volumes along a face; at run time the faces must have as many sides.
//
//   a <0,1> ↺3    b <0,1> ↺3   →   a <0,1> ─3─ b <0,1>
constexpr Rule sew_faces{
    "sew faces",
    left{hook('a', {0, 1}), hook('b', {0, 1}), loop('a', 3), loop('b', 3)},
    right{node('a', {0, 1}), node('b', {0, 1}), arc('a', 3, 'b')},
};
static_assert(well_formed(sew_faces));

} // namespace rend
