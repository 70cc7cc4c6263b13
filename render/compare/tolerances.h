// The tolerance file of rend diff: what pictures may differ by, for all of them and by name.
//
//   <tolerances>
//     <default threshold="4" share="0.001" window="0.1"/>
//     <case name="tear/moebius*" flip="0.002"/>                  <!-- adds a limit to those of the default -->
//     <case name="contact/*" share="any" mask="masks/floor.png"/> <!-- takes one away -->
//   </tolerances>
//
// It is read as presets are: misspelt names and values out of range are refused with their place. `name` is a
// shell pattern (* and ? also match /). Every case that matches applies, in the order of the file; later values
// replace earlier ones, and "any" removes a limit: if no other is left, anything of the right size matches. The
// attributes are the names of all_limits(), and threshold, window-size, mask.
#pragma once

#include "render/compare/compare.h"
#include "sim/base/parameters.h"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace rend {

const ElementType& tolerances_type();

class Tolerances {
public:
  Tolerances() = default; // pictures must be equal
  // Throws UserError: NoInput, BadInput. Masks lie in the file's folder or below, as stays_below() says
  // (sim/preset/paths.h), unless `allow_path`.
  explicit Tolerances(const std::filesystem::path& file, bool allow_path = false);

  // Adds a setting of the command line, which overrides the file: "share=0.01", "share=any", "threshold=2".
  // Throws UserError (Usage).
  void add(const std::string& setting);
  void mask_all(const std::filesystem::path& mask) { mask_ = mask; }

  // The options for the picture of that name; `heat` and `threads` keep their defaults.
  CompareOptions of(const std::string& name) const;
  // Likely mistakes, as sentences: patterns of the file that match none of `names`, a threshold or window-size
  // without a limit that uses it.
  std::vector<std::string> remarks(const std::vector<std::string>& names) const;

private:
  std::vector<std::string> unused(const std::vector<std::string>& names) const;

  std::shared_ptr<const PresetNode> file_;
  std::filesystem::path folder_; // of the file: paths of masks are relative to it
  std::vector<std::pair<std::string, std::string>> settings_;
  std::filesystem::path mask_;
};

} // namespace rend
