// The shapes of SVG as closed curves, and transforms. What is wrong is a PathFault, whose character counts in
// the attribute that was read last.
#pragma once

#include "sim/mesh/svg_path.h"

#include <Eigen/Geometry>

#include <string_view>
#include <vector>

namespace rend {

// Of an element, as expat hands them over: name, value, name, value ... null. They must outlive this.
class SvgAttributes {
public:
  explicit SvgAttributes(const char** given) : given_(given) {}
  std::string_view text(std::string_view name) const; // empty: it is not given

private:
  const char** given_;
};

bool is_svg_shape(std::string_view element);

// Of <path>, <rect>, <circle>, <ellipse>, <polygon> or <polyline>, in the units of the drawing, y down. A shape
// without area has none. `attribute`: which was read last.
std::vector<Curve> curves_of_shape(std::string_view element, const SvgAttributes& given,
                                   std::string_view& attribute);

// "translate(3 4) scale(2)": the last one is applied first.
Eigen::Affine2d transform_of(std::string_view text);

} // namespace rend
