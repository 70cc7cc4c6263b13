// Words for error messages: the nearest valid name, lists, and quotes that are safe to print.
//
// Nearness is Damerau's edit distance in its restricted form (insert, delete, replace, swap two neighbours),
// with capitals counting as small letters. A third of the shorter name may differ, or one letter of two; a
// prefix or suffix of the other name is near as well ("thick" and "thickness", "stress" and "vertex-stress").
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace rend {

// The nearest of `names` to `name`, the first of those equally near, or empty if none is near.
std::string nearest(std::string_view name, std::span<const std::string> names);

// "a, b, c".
std::string listed(std::span<const std::string> names);

// "did you mean 'stretch'? " where a name is near, then "WHAT: stretch, shear, bend." with all of them, or only
// the first part where `what` is empty. Empty if there are no names.
std::string suggestion(std::string_view name, std::span<const std::string> names, std::string_view what = {});

// 'text', on one line, without control characters, and cut where it is longer than some 60 bytes. `text` may be
// any bytes.
std::string in_quotes(std::string_view text);

} // namespace rend
