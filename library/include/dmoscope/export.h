#pragma once
// Marks of the symbols that the library exports.

#if defined(__GNUC__)
#define DMO_API __attribute__((visibility("default")))
#else
#define DMO_API
#endif
