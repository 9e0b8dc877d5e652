#include "ui/analysis/colour_worker.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace dmoscope::ui {
namespace {

constexpr Index kBigMesh = 100'000;   // elements; the colours of larger meshes take long enough to be felt
constexpr Index kBigSurface = 1'000;  // elements, for colours that take long

/// Whether both meshes have the same elements with the same corners, wherever their vertices are.
bool same_elements(const InputMesh& a, const InputMesh& b) {
  if (&a == &b) return true;
  return a.mesh.vertex_count() == b.mesh.vertex_count() && std::ranges::equal(a.mesh.elements.kinds(), b.mesh.elements.kinds()) &&
         std::ranges::equal(a.mesh.elements.all_corners(), b.mesh.elements.all_corners());
}

}  // namespace

void ColourWorker::take() {
  if (pending_.valid() && pending_.wait_for(std::chrono::seconds(0)) == std::future_status::ready) colours_ = pending_.get();
}

void ColourWorker::update(const ViewState& state, const SessionView& session, std::shared_ptr<const Frame> reference) {
  take();
  const ColourBy by = state.colouring.by;
  const Frame* frame = session.frame.get();
  const bool has_reference = frame != nullptr && reference && !reference->device;
  const bool possible = frame != nullptr && by != ColourBy::Quality && !(frame->device && needs_positions(by)) &&
                        (by != ColourBy::Difference || has_reference);
  if (!possible) {
    colours_.reset();  // pending work ends soon, and is dropped here
    key_.reset();
    return;
  }
  const bool by_class = by == ColourBy::Class, ordered = by == ColourBy::Valence || by == ColourBy::Freedom;
  const bool by_domain = takes_long(by) || by == ColourBy::Freedom;
  const RunView& run = session.runs[session.active];
  ColourRequest request{by,
                        session.frame,
                        by_class ? run.colouring : nullptr,
                        state.colour_map,
                        state.colouring.reversed,
                        by == ColourBy::SizeOverTarget ? run.size : nullptr,
                        by == ColourBy::Difference ? std::move(reference) : nullptr};
  if (request.reference) request.comparable = comparable_(frame->input, request.reference->input);
  if (by_domain) request.domain = run.domain;
  if (by == ColourBy::Freedom) request.fixed = run.fixed;
  if (by == ColourBy::Multiplier) request.hold = run.hold();
  const void* depends = by == ColourBy::Multiplier ? static_cast<const void*>(request.hold.get()) : request.size.get();
  if (by_class) depends = request.classes.get();
  if (by_domain) depends = by == ColourBy::Freedom ? static_cast<const void*>(request.fixed.data()) : request.domain.get();
  const Key key{by,
                frame->input_serial,
                needs_positions(by) ? frame->serial : 0,
                request.reference ? request.reference->serial : 0,
                depends,
                ordered ? static_cast<int>(request.map) : 0,
                ordered && request.reversed};
  if (colours_ && (colours_->by != by || colours_->input_serial != frame->input_serial)) colours_.reset();
  if (key_ == key || pending_.valid()) return;
  key_ = key;
  classes_ = request.classes;
  domain_ = request.domain;
  fixed_ = request.fixed;
  hold_ = request.hold;
  const auto work = [request = std::move(request)] { return std::make_shared<const ElementColours>(colour_elements(request)); };
  if (frame->element_count() < (takes_long(by) ? kBigSurface : kBigMesh)) {
    colours_ = work();
  } else {
    pending_ = std::async(std::launch::async, work);
  }
}

bool Comparable::operator()(const std::shared_ptr<const InputMesh>& a, const std::shared_ptr<const InputMesh>& b) {
  if (a == b) return true;
  if (a_.lock() == a && b_.lock() == b) return same_;
  a_ = a;
  b_ = b;
  return same_ = same_elements(*a, *b);
}

}  // namespace dmoscope::ui
