// fault: there_is_no_such_link
// α4 is for maps of another dimension.
#include "sim/topology/rule_check.h"

namespace rend {
using namespace grammar;

constexpr Rule rule{
    "fifth link",
    left{hook('a', {0, 4})},
    right{node('a', {0, 4})},
};
static_assert(well_formed(rule));

} // namespace rend
