// Keys of something that changes with time: they stand in the order of time.
#pragma once

#include "sim/base/settings.h"

namespace rend {

// Times of a key and of the one before it [s]. UserError, at the `at` of `key`: it comes no later.
void check_key_times(double before, double time, const SettingsSource& key);

} // namespace rend
