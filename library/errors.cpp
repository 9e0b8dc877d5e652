#include <utility>

#include "library/include/dmoscope/dmoscope.h"
#include "library/include/dmoscope/error.h"
#include "library/include/dmoscope/progress.h"
#include "library/mesh_data.h"

namespace dmo {

// Defined out of line, so that every program that catches these errors has the same type information.
Error::~Error() = default;
InputError::InputError(const std::string& what, std::string file, std::size_t line) : Error(what), file_(std::move(file)), line_(line) {}
InputError::~InputError() = default;
OutputError::~OutputError() = default;
UsageError::~UsageError() = default;
Cancelled::~Cancelled() = default;

const char* version() { return DMOSCOPE_VERSION; }

Progress::Progress() : state_(std::make_shared<State>()) {}
Progress::~Progress() = default;
Progress::Progress(const Progress&) = default;
Progress& Progress::operator=(const Progress&) = default;
double Progress::fraction() const { return state_->progress.fraction(); }
std::string Progress::label() const { return state_->progress.label(); }
void Progress::request_cancel() { state_->progress.request_cancel(); }
void Progress::reset() { state_->progress.clear_cancel(); }

}  // namespace dmo
