#pragma once

/// How the numbers of a rod lie in memory while it relaxes: eight neighbouring elements side by side, so that one
/// instruction can work on several. Plain types, the same for every instruction set.

#include <cstddef>

namespace sensory_growth::mechanics::kernels {

constexpr std::size_t kPacket = 8;

struct alignas(64) Packet {
  double lane[kPacket];
};

namespace {

/// Internal, because files for different instruction sets include it.
constexpr std::size_t packetCount(std::size_t elements) { return (elements + kPacket - 1) / kPacket; }

}  // namespace

}  // namespace sensory_growth::mechanics::kernels
