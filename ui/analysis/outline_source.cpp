#include "ui/analysis/outline_source.h"

#include <chrono>

namespace dmoscope::ui {

const Outline* OutlineSource::of(const std::shared_ptr<const InputMesh>& input) {
  constexpr Index kBig = 50'000;  // elements; half-edges of larger meshes take long enough to be felt
  if (pending_.valid()) {
    if (pending_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return nullptr;
    outline_ = pending_.get();
  }
  if (input_ != input) {
    input_ = input;
    outline_.reset();
    const auto work = [input] { return std::make_shared<const Outline>(outline_of(input->mesh)); };
    if (input->mesh.elements.size() < kBig) {
      outline_ = work();
    } else {
      pending_ = std::async(std::launch::async, work);
    }
  }
  return outline_.get();
}

}  // namespace dmoscope::ui
