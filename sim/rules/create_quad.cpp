#include "sim/rules/rules.h"
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

// A face of four sides, free on all of them. Thesis fig. 3.46, with one side more.
//
//   ∅   →   a ─0─ b ─1─ c ─0─ d ─1─ e ─0─ f ─1─ g ─0─ h ─1─ a        all ↺2,3
// clang-format off
constexpr Rule create_quad{
    "create quad",
    left{},
    right{node('a'), node('b'), arc('a', 0, 'b'), arc('b', 1, 'c'), loop('a', 2, 3), loop('b', 2, 3),
          point('a', given(0)),
          node('c'), node('d'), arc('c', 0, 'd'), arc('d', 1, 'e'), loop('c', 2, 3), loop('d', 2, 3),
          point('c', given(1)),
          node('e'), node('f'), arc('e', 0, 'f'), arc('f', 1, 'g'), loop('e', 2, 3), loop('f', 2, 3),
          point('e', given(2)),
          node('g'), node('h'), arc('g', 0, 'h'), arc('h', 1, 'a'), loop('g', 2, 3), loop('h', 2, 3),
          point('g', given(3))},
};
// clang-format on
static_assert(well_formed(create_quad));

} // namespace rend
