#include "sim/topology/isomorphism.h"

namespace rend {
namespace {

// Extends `image` from first -> second over the whole fragment of `first`; undoes it where that fails.
bool extend(const GMap& a, const GMap& b, Dart first, Dart second, const DartMatch& match,
            std::vector<Dart>& image, std::vector<char>& taken) {
  std::vector<Dart> queue;
  const auto assign = [&](Dart from, Dart to) {
    if (image[from.value]) return image[from.value] == to;
    if (taken[to.value] || (match && !match(from, to))) return false;
    image[from.value] = to;
    taken[to.value] = 1;
    queue.push_back(from);
    return true;
  };
  bool ok = assign(first, second);
  for (std::size_t at = 0; ok && at < queue.size(); ++at)
    for (int i = 0; ok && i < 4; ++i) ok = assign(a.alpha(i, queue[at]), b.alpha(i, image[queue[at].value]));
  if (ok) return true;
  for (Dart d : queue) {
    taken[image[d.value].value] = 0;
    image[d.value] = Dart{};
  }
  return false;
}

} // namespace

std::optional<std::vector<Dart>> isomorphism(const GMap& a, const GMap& b, const DartMatch& match) {
  if (a.dart_count() != b.dart_count() || a.dimension() != b.dimension()) return {};
  std::vector<Dart> image(a.capacity());
  std::vector<char> taken(b.capacity(), 0);
  bool ok = true;
  a.for_each_dart([&](Dart d) {
    if (!ok || image[d.value]) return;
    bool found = false;
    for (std::uint32_t i = 0; i < b.capacity() && !found; ++i)
      found = b.alive(Dart{i}) && !taken[i] && extend(a, b, d, Dart{i}, match, image, taken);
    ok = found;
  });
  if (!ok) return {};
  return image;
}

} // namespace rend
