#pragma once

namespace sensory_growth::support {

/// A sanitizer slows down and keeps what is freed, so that rates and memory in use say nothing.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kHasSanitizer = true;
#else
inline constexpr bool kHasSanitizer = false;
#endif

}  // namespace sensory_growth::support
