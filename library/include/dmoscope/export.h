#pragma once
// What the library shows of itself.

#if defined(__GNUC__)
#define DMO_API __attribute__((visibility("default")))
#else
#define DMO_API
#endif
