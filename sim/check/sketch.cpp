#include "sim/check/sketch.h"

#include <fmt/format.h>

namespace rend {

std::string Sketch::text() const {
  return fmt::format(
      "<scene name=\"{}\">\n  <body name=\"body\">\n{}  </body>\n{}  <world gravity=\"{}\">{}</world>\n"
      "  <time {}/>\n</scene>\n",
      name, body, others, gravity, world, time);
}

std::string in_short(double value) {
  return fmt::format("{}", value);
}

std::string decade(int exponent) {
  return exponent == 0 ? "1" : exponent == 1 ? "10" : fmt::format("1e{}", exponent);
}

std::string time_of(const std::string& integrator, const std::string& step, double duration) {
  return fmt::format("integrator=\"{}\" step=\"{}\" duration=\"{}\"", integrator, step, in_short(duration));
}

std::string Matter::matter(double young, double poisson, const std::string& more) const {
  if (model == "springs") {
    // about the stiffness of a material of 1 m: k = E L
    const std::string k = in_short(young);
    if (dimension == 2)
      return fmt::format(
          "    <springs><stretch k=\"{0}\"/><shear k=\"{0}\"/><bend kind=\"provot\" k=\"{0}\"/></springs>\n",
          k);
    return fmt::format(
        "    <springs><stretch k=\"{0}\"/><shear k=\"{0}\"/><shear where=\"volume\" k=\"{0}\"/></springs>\n",
        k);
  }
  const bool qr = model == "corotational-qr";
  return fmt::format("    <elasticity model=\"{}\" young=\"{}\" poisson=\"{}\"{}{}{}/>\n",
                     qr ? "corotational" : model, in_short(young), in_short(poisson),
                     qr ? " rotation=\"qr\"" : "", dimension == 2 ? " thickness=\"0.1\"" : "",
                     more.empty() ? "" : " " + more);
}

std::vector<Matter> all_matters(const std::string& bar_cells, const std::string& bar_size,
                                const std::string& sheet_cells, const std::string& sheet_size) {
  std::vector<Matter> all;
  const auto add = [&](const char* model, const char* pattern, int dimension) {
    const std::string shape =
        dimension == 3
            ? fmt::format("    <bar pattern=\"{}\" cells=\"{}\" size=\"{}\"/>\n", pattern, bar_cells, bar_size)
            : fmt::format("    <sheet pattern=\"{}\" cells=\"{}\" size=\"{}\"/>\n", pattern, sheet_cells,
                          sheet_size);
    all.push_back({fmt::format("{} {}", model, pattern), shape, model, dimension});
  };
  for (const char* model : {"springs", "linear", "corotational", "corotational-qr"}) {
    for (const char* pattern : {"tetrahedra", "hexahedra", "prisms", "mixed"}) add(model, pattern, 3);
    for (const char* pattern : {"triangles", "quads"}) add(model, pattern, 2);
  }
  for (const char* pattern : {"tetrahedra", "hexahedra"}) add("mass-tensor", pattern, 3);
  return all;
}

} // namespace rend
