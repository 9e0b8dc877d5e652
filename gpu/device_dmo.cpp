#include "gpu/device_dmo.h"

#include <algorithm>
#include <array>
#include <span>

#include "core/smooth/visit/star_judge.h"
#include "gpu/bodies.h"
#include "gpu/defined/device_metric.h"
#include "gpu/device_mesh.h"
#include "gpu/device_picture.h"

namespace dmoscope::gpu {

namespace {

/// Teams among which a class's deferred visits are shared: enough for any device, and few, since there nearly always are none.
constexpr std::size_t kSettlers = 2048;
/// The kernels of a class's visits by lanes; without kernels for fans the last does all visits.
constexpr std::array kByStars{Work::VisitSmallFans, Work::VisitLargeFans, Work::VisitOthers};

class DeviceDmo final : public Smoother {
 public:
  DeviceDmo(std::shared_ptr<Queue> queue, const SmoothingTask& task)
      : queue_(std::move(queue)),
        colouring_(task.colouring),
        metric_(task.metric),
        combination_(task.combination),
        aim_(task.aim),
        aims_(aims_of({})),
        mesh_(queue_, *task.input, *colouring_, task.immovable, task.pool),
        counts_(queue_, colouring_->class_count() + std::size_t{1}),
        moved_(queue_),
        deferred_(queue_, mesh_.is_volume() || combination_ || !is_built_in(metric_) ? 0 : largest_class()),
        pictures_(std::make_shared<Pictures>(queue_)),
        task_(mesh_.task()) {
    task_.parameters = task.search;
    task_.deferred = deferred_.data();
    task_.moved = counts_.data();
    if (!is_built_in(metric_)) defined_.emplace(queue_, task, task_);
    warm_up(task.then_mean);
    load(task.input->mesh.positions, task.pool);
    queue_->wait();
    if (!colouring_->order.empty()) record_iteration();  // recorded here, so that no iteration pays for it
  }

  void begin(const Sweep& sweep) override {
    const std::optional<PlainComposite> aims = aims_of(sweep);
    const Untangling untangling = sweep.floor ? Untangling{} : sweep.untangling;  // raising the mean worsens nothing
    if (untangling == task_.untangling && aims == aims_) return;
    task_.untangling = untangling;
    set_aims(aims);
    iteration_.reset();  // recorded with the old rules
    if (stale_) return;  // loading will wake all vertices
    queue_->launch(Work::Store, kNoMetric, task_, task_.vertex_count);
    queue_->launch(Work::Load, kNoMetric, task_, task_.vertex_count);
  }

  std::uint64_t visit(std::uint64_t first, std::uint64_t count, std::span<Vec3> positions, ThreadPool* pool) override {
    if (stale_) load(positions, pool);
    stored_ = judged_ = false;
    visited_ = true;
    if (first == 0 && count == colouring_->order.size()) {
      if (iteration_ == nullptr) record_iteration();
      queue_->replay(*iteration_);
    } else {
      visit_classes(first, count);
    }
    queue_->wait();
    return moved_.value();
  }

  void store(std::span<Vec3> positions, ThreadPool* pool) override {
    if (stored_ || stale_ || !visited_) return;
    queue_->launch(Work::Store, kNoMetric, task_, positions.size());
    mesh_.positions().download(positions, pool);
    queue_->counters().bytes_to_host += positions.size_bytes();
    stored_ = true;
  }

  void positions_replaced() override {
    stale_ = true;
    visited_ = false;
  }
  bool positions_on_device() const noexcept override { return true; }
  std::string description() const override { return defined_ ? defined_->description() : std::string(); }

  std::optional<Statistics> statistics() override {
    if (stale_ || !visited_) return std::nullopt;
    if (!judged_) {
      judge();
      judged_ = true;
    }
    return mesh_.statistics();
  }

  std::shared_ptr<const DevicePicture> picture(Metric shown) override {
    if (stale_ || !visited_ || mesh_.is_volume()) return nullptr;  // the visible faces of a volume are found by the host
    if (!is_built_in(shown)) return nullptr;                       // formulas are shown by the host
    judged_ = false;
    auto picture = pictures_->make(mesh_, shown);
    judged_ = shown == metric_;
    return picture;
  }

 private:
  void judge() {
    if (!defined_) return mesh_.judge(metric_);
    defined_->judge(task_);
    mesh_.add_up();
  }
  /// The aims of a sweep's visits besides the metric.
  [[nodiscard]] std::optional<PlainComposite> aims_of(const Sweep& sweep) const {
    const auto composite = composite_objective_of_visit(metric_, combination_, aim_, sweep);
    return composite ? plain_composite(*composite) : std::nullopt;
  }
  void set_aims(const std::optional<PlainComposite>& aims) {
    aims_ = aims;
    task_.aims = aims.value_or(PlainComposite{});
  }
  [[nodiscard]] Work two_aims() const { return mesh_.is_volume() ? Work::VisitVolumeComposite : Work::VisitComposite; }

  [[nodiscard]] std::size_t largest_class() const {
    std::size_t largest = 0;
    for (Index c = 0; c < colouring_->class_count(); ++c) largest = std::max(largest, colouring_->members(c).size());
    return largest;
  }

  void record_iteration() {
    iteration_ = queue_->record([this] { visit_classes(0, colouring_->order.size()); });
  }

  /// Visits the part of [first, first + count) that lies in each class, class after class: a class sees the new positions of the classes
  /// before it, and no two of its vertices share an element.
  void visit_classes(std::uint64_t first, std::uint64_t count) {
    counts_.clear();
    const std::uint64_t last = first + count;
    for (Index c = 0; c < colouring_->class_count(); ++c) {
      const std::uint64_t begin = std::max<std::uint64_t>(first, colouring_->class_offsets[c]);
      const std::uint64_t end = std::min<std::uint64_t>(last, colouring_->class_offsets[c + 1]);
      if (begin >= end) continue;
      task_.first = begin;
      task_.deferred_count = counts_.data() + 1 + c;
      if (in_fans() && end - begin == colouring_->members(c).size())
        launch_visits(mesh_.stars_of_class(c));
      else
        launch_visits(end - begin);
    }
    moved_.fetch(counts_.data());
  }

  /// Launches the visits of `count` ranks from task_.first on, which no list orders: those of a part of a class, or of a class without
  /// kernels for fans.
  void launch_visits(std::size_t count) {
    if (defined_) return defined_->visit(task_, task_.first, task_.first + count);
    if (aims_ || mesh_.is_volume()) {
      queue_->launch(aims_ ? two_aims() : Work::VisitVolume, metric_, task_, count);
      return;
    }
    if (count * kTeamShare <= queue_->lanes_at_once()) {
      queue_->launch(Work::VisitInTeam, metric_, task_, count);
      return;
    }
    for (const Work work : std::span(kByStars).last(in_fans() ? kByStars.size() : 1)) queue_->launch(work, metric_, task_, count);
    queue_->launch(Work::Settle, metric_, task_, std::min(count, kSettlers));
  }

  /// Launches the visits of a whole class by the kernels for its stars.
  void launch_visits(const DeviceMesh::ClassStars& stars) {
    const std::size_t count = stars.small_fans + stars.large_fans + stars.others;
    if (count * kTeamShare <= queue_->lanes_at_once()) return launch_visits(count);
    task_.listed = stars.ranks;
    // No two vertices of a class see each other.
    queue_->both([&] { queue_->launch(Work::VisitSmallFans, metric_, task_, stars.small_fans); },
                 [&] {
                   task_.listed = stars.ranks + stars.small_fans;
                   queue_->launch(Work::VisitLargeFans, metric_, task_, stars.large_fans);
                   task_.listed += stars.large_fans;
                   queue_->launch(Work::VisitOthers, metric_, task_, stars.others);
                   task_.listed = stars.ranks;
                 });
    task_.listed = nullptr;
    queue_->launch(Work::Settle, metric_, task_, std::min(count, kSettlers));
  }

  /// Whether there are kernels for fans.
  [[nodiscard]] bool in_fans() const {
    return !aims_ && !defined_ && !mesh_.is_volume() && task_.parameters.grid_points == 8 &&
           formulas::with_planar_metric(metric_, []<Metric M>() { return kIsRatio<M>; });
  }

  /// Runs every kernel once, for one vertex that needs no visit, since loading it and reserving the memory of its lanes takes long the
  /// first time.
  void warm_up(bool then_mean) {
    set_aims(aims_);
    mesh_.put_to_sleep();
    counts_.clear();
    task_.deferred_count = counts_.data() + 1;
    if (colouring_->order.empty()) return;
    if (defined_) return defined_->warm_up(task_);
    if (aims_ || then_mean) queue_->launch(two_aims(), metric_, task_, 1);
    if (aims_) return;
    if (mesh_.is_volume()) {
      queue_->launch(Work::VisitVolume, metric_, task_, 1);
      return;
    }
    for (const Work work : {Work::VisitInTeam, Work::VisitOthers, Work::Settle}) queue_->launch(work, metric_, task_, 1);
    if (in_fans())
      for (const Work work : {Work::VisitSmallFans, Work::VisitLargeFans}) queue_->launch(work, metric_, task_, 1);
    queue_->both([] {}, [] {});  // the side stream cannot be made in a recording
  }

  void load(std::span<const Vec3> positions, ThreadPool* pool) {
    mesh_.positions().upload(positions, pool);
    queue_->launch(Work::Load, kNoMetric, task_, positions.size());
    stale_ = false;
  }

  std::shared_ptr<Queue> queue_;
  std::shared_ptr<const Colouring> colouring_;
  Metric metric_;
  std::optional<CompositeTerms> combination_;
  std::shared_ptr<const PlaceAim> aim_;
  std::optional<PlainComposite> aims_;  // the present visits' second aim; none: the metric alone
  DeviceMesh mesh_;
  std::optional<DeviceMetric> defined_;  // a metric that is not built in
  Buffer<std::uint32_t> counts_;         // moved, then the deferred visits of each class
  Fetched<std::uint32_t> moved_;
  Buffer<Deferred> deferred_;
  std::shared_ptr<Pictures> pictures_;
  Task task_;
  std::unique_ptr<Queue::Recording> iteration_;
  bool stale_ = true;     // the device's positions are older than the run's
  bool visited_ = false;  // whether vertices were visited since the last load
  bool stored_ = false;   // the run's positions are as new as the device's
  bool judged_ = false;   // the statistics are as new as the device's positions
};

}  // namespace

std::unique_ptr<Smoother> make_device_dmo(std::shared_ptr<Queue> queue, const SmoothingTask& task) {
  return std::make_unique<DeviceDmo>(std::move(queue), task);
}

}  // namespace dmoscope::gpu
