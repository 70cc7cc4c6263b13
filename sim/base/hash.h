// A 64-bit hash of bytes (XXH3), for state hashes: equal in two runs that are identical.
#pragma once

#include <cstddef>
#include <cstdint>

namespace rend {

std::uint64_t hash_bytes(const void* data, std::size_t bytes, std::uint64_t seed = 0);

} // namespace rend
