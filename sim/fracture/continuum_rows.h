// The continuum elements of a body with their rows: those of its program; for mass-tensors, whose elements the
// program has no rows for, rows of their own.
#pragma once

#include "sim/fracture/criterion.h"
#include "sim/rows/continuum.h"

#include <optional>

namespace rend {

class ContinuumRows {
public:
  explicit ContinuumRows(const CriterionRequest& request);

  const Continuum& continuum() const { return continuum_; }
  const std::vector<Continuum::Part>& parts() const { return continuum_.parts(); }
  const Binder& of(const ForceView& view, std::size_t part) const {
    const std::size_t index = parts()[part].index;
    return index == Continuum::recreated ? *recreated_[part] : view.program.rows()[index];
  }

  void rebind(const Changes& changes);
  void reserve_for_separations();
  std::size_t bytes() const;

private:
  Continuum continuum_;
  std::vector<std::optional<Binder>> recreated_; // one per part; none: the program has rows
};

} // namespace rend
