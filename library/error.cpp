#include "library/include/dmoscope/error.h"

#include <utility>

#include "library/include/dmoscope/dmoscope.h"

namespace dmo {

// Defined out of line, so that every program that catches these errors has the same type information.
Error::~Error() = default;
InputError::InputError(const std::string& what, std::string file, std::size_t line) : Error(what), file_(std::move(file)), line_(line) {}
InputError::~InputError() = default;
OutputError::~OutputError() = default;
UsageError::~UsageError() = default;
Cancelled::~Cancelled() = default;

const char* version() { return DMOSCOPE_VERSION; }

}  // namespace dmo
