#include "sim/base/key_times.h"

#include <fmt/format.h>

namespace rend {

void check_key_times(double before, double time, const SettingsSource& key) {
  if (time > before) return;
  if (time == before)
    key.fail("at", fmt::format("this key and the one before it both come at {} s", time),
             "give each key a time of its own; a jump takes two keys, shortly after one another");
  key.fail("at", fmt::format("this key comes at {} s, and the one before it at {} s", time, before),
           "put them in the order of time");
}

} // namespace rend
