#pragma once
// Discrete Mesh Optimization as a library. Everything is in namespace dmo.
//
// Versions are MAJOR.MINOR.PATCH (semver.org). Until 1.0 another MINOR may change what these headers say, and its shared library has
// another name; another PATCH never does.

#include "dmoscope/error.h"
#include "dmoscope/mesh.h"
#include "dmoscope/options.h"
#include "dmoscope/progress.h"
#include "dmoscope/quality.h"
#include "dmoscope/smooth.h"
#include "dmoscope/trace.h"

namespace dmo {

/// Returns the version of the library that is loaded: "0.2.0".
[[nodiscard]] DMO_API const char* version();

}  // namespace dmo
