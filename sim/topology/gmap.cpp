#include "sim/topology/gmap.h"

#include "sim/base/archive.h"
#include "sim/base/check.h"

namespace rend {

GMap::GMap(int dimension) : dimension_(dimension) {
  CHECK(dimension == 2 || dimension == 3);
}

void GMap::store(Archive& archive) {
  archive.same(static_cast<std::uint64_t>(dimension_), "dimension");
  archive(links_, free_);
}

std::size_t GMap::bytes() const {
  return links_.capacity() * sizeof(Links) + free_.capacity() * sizeof(std::uint32_t);
}

} // namespace rend
