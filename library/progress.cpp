#include "library/include/dmoscope/progress.h"

#include "library/mesh_data.h"

namespace dmo {

Progress::Progress() : state_(std::make_shared<State>()) {}
Progress::~Progress() = default;
Progress::Progress(const Progress&) = default;
Progress& Progress::operator=(const Progress&) = default;
double Progress::fraction() const { return state_->progress.fraction(); }
std::string Progress::label() const { return state_->progress.label(); }
void Progress::request_cancel() { state_->progress.request_cancel(); }

}  // namespace dmo
