// Whether an expression has one value at all darts of a vertex, decided from the graphs alone.
//
// The vertex of a node stretches over several instances where a label leads to it. There the value must be the
// same. It is asked with numbers: each call of the expression gets a number that hangs on what its value hangs
// on, the dart and the orbit that it is taken over, and the value of the whole is compared at both ends of the
// label. A dart is known by its node and a word of links; of two words that the relations of a map make equal,
// αiαi = 1 and αiαj = αjαi for j >= i + 2, one normal form stands for both. So mean(a, face) + mean(alpha(a,
// 2), face) is the same on both sides of an edge, as its two parts change places.
#pragma once

#include "sim/rules/rule.h"

namespace rend {

// Whether it has one value at an instance and at the one that position `p` of the labels leads to. Its lets are
// those of the rule, which may be in the making.
bool is_symmetric(const Rule& rule, const Expression& expression, int p);

// The normal form of a word of links that lead from a dart to an orbit: of those that lead to the same orbit of
// it in every map, the same one.
std::string normal_word(const std::string& word, Orbit orbit);

} // namespace rend
