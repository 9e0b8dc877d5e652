#pragma once
// Translation of the program's errors to the library's.

#include <string>

#include "core/base/error.h"
#include "library/include/dmoscope/error.h"

namespace dmo {

inline constexpr const char* kNoFile = "mesh";  // stands for the file of a mesh that has none

/// Returns work(); its errors become errors of the library.
template <class Work>
decltype(auto) translated(const Work& work) {
  try {
    return work();
  } catch (const dmoscope::InputError& error) {
    throw InputError(error.what(), error.file() == kNoFile ? std::string() : error.file(), error.line());
  } catch (const dmoscope::OutputError& error) {
    throw OutputError(error.what());
  } catch (const dmoscope::UsageError& error) {
    throw UsageError(error.what());
  } catch (const dmoscope::Cancelled& error) {
    throw Cancelled(error.what());
  } catch (const dmoscope::Error& error) {
    throw Error(error.what());
  }
}

}  // namespace dmo
