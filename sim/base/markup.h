// Text within XML and HTML.
#pragma once

#include <string>
#include <string_view>

namespace rend {

// Which quotes become entities besides & < and >. Attributes that rend writes stand in double quotes.
enum class MarkupQuotes { Double, Both };
std::string in_markup(std::string_view text, MarkupQuotes quotes);

} // namespace rend
