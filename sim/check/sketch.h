// Presets of cases, composed as text.
#pragma once

#include <string>
#include <vector>

namespace rend {

// A scene with one body, or more with `others`.
struct Sketch {
  std::string name = "case", body, others; // elements in <body>; whole <body> elements besides it
  std::string gravity = "0 0 0", world;    // elements in <world>
  std::string time;                        // attributes of <time>
  std::string text() const;
};

// The attributes of <time>: the scheme's name, and `step` [s] as text; "auto" if the scheme has an automatic
// step.
std::string time_of(const std::string& integrator, const std::string& step, double duration);

std::string in_short(double value); // the shortest text that parses to it: "0.1", "1e+12"
std::string decade(int exponent);   // "1e12", "1e-6"; 1 and 10 in full

// The material of a body, for the families that vary it.
struct Matter {
  std::string name;  // "corotational tetrahedra"
  std::string shape; // <bar .../>, of 2 × 2 × 2 boxes unless stated otherwise
  std::string model; // "springs", "linear", "corotational", "corotational-qr", "mass-tensor"
  int dimension = 3;
  // <elasticity .../> or <springs>; `more`: further attributes of elasticity, such as damping-mass.
  std::string matter(double young, double poisson, const std::string& more = {}) const;
  bool small_strain() const { return model == "linear" || model == "mass-tensor"; }
};

// Every model on every kind of element that it supports, on a bar or sheet with so many cells and such a size.
std::vector<Matter> all_matters(const std::string& bar_cells, const std::string& bar_size,
                                const std::string& sheet_cells, const std::string& sheet_size);

} // namespace rend
