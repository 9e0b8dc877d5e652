#pragma once
// Whether this is a sanitizer's build. Sanitizers find errors of memory, of arithmetic and of threads on a part of the vertices as well as
// on all: the longest tests of results, which the other builds do in full, may use less there.

namespace dmoscope::testing {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace dmoscope::testing
