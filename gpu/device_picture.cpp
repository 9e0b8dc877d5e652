#include "gpu/device_picture.h"

#include <array>
#include <utility>

#include "core/base/error.h"
#include "gpu/task.h"

namespace dmoscope::gpu {

namespace {
constexpr std::size_t kSlots = kSlotNowhere + 1;
}

class Picture final : public DevicePicture {
 public:
  Picture(std::shared_ptr<Pictures> pictures, std::unique_ptr<Pictures::Memory> memory, const Task& task, ElementSummary summary)
      : pictures_(std::move(pictures)), memory_(std::move(memory)), task_(task), summary_(std::move(summary)) {}
  ~Picture() override { pictures_->give_back(std::move(memory_)); }

  const ElementSummary& summary() const noexcept override { return summary_; }

  std::unique_ptr<DeviceTarget> make_target(std::uint32_t point_buffer, std::uint32_t shade_buffer) const override {
    return reader().make_target(point_buffer, shade_buffer);
  }
  void write(DeviceTarget& target, Vec2<double> origin) const override {
    const std::scoped_lock lock(pictures_->reading_);
    Task task = task_;
    task.origin = origin;
    reader().draw(target, task);
  }

  void download(std::span<Vec2<float>> points, std::span<float> shades, Vec2<double> origin) const override {
    const std::scoped_lock lock(pictures_->reading_);
    Task task = task_;
    task.origin = origin;
    task.points = pictures_->projected_.with_room_for(points.size());
    reader().launch(Work::Project, Metric::MeanRatio, task, points.size());
    reader().download(points.data(), task.points, points.size_bytes(), nullptr);
    reader().download(shades.data(), memory_->shades.data(), shades.size_bytes(), nullptr);
    reader().counters().bytes_to_host += points.size_bytes() + shades.size_bytes();
  }

  std::vector<Vec3> positions(std::span<const Index> vertices) const override {
    const std::scoped_lock lock(pictures_->reading_);
    std::vector<Vec3> found(vertices.size());
    if (found.empty()) return found;
    Task task = task_;
    Index* wanted = pictures_->wanted_.with_room_for(found.size());
    reader().upload(wanted, vertices.data(), vertices.size_bytes(), nullptr);
    task.wanted = wanted;
    task.picked = pictures_->picked_.with_room_for(found.size());
    reader().launch(Work::Pick, Metric::MeanRatio, task, found.size());
    reader().download(found.data(), task.picked, found.size() * sizeof(Vec3), nullptr);
    reader().counters().bytes_to_host += found.size() * sizeof(Vec3);
    return found;
  }

  std::uint64_t bytes_to_host() const noexcept override { return reader().counters().bytes_to_host; }

 private:
  [[nodiscard]] Queue& reader() const { return *pictures_->reader_; }

  std::shared_ptr<Pictures> pictures_;
  std::unique_ptr<Pictures::Memory> memory_;
  Task task_;
  ElementSummary summary_;
};

std::shared_ptr<const DevicePicture> Pictures::make(DeviceMesh& mesh, Metric shown) {
  Task task = mesh.task();
  auto memory = take(task);
  task.positions = memory->positions.data();
  task.shades = memory->shades.data();
  task.counts = memory->counts.data();
  mesh.judge(shown);
  maker_->launch(Work::Store, shown, task, task.vertex_count);
  maker_->launch(Work::Shade, shown, task, task.element_count);
  memory->counts.clear();
  maker_->launch(Work::Count, shown, task, task.element_count);

  ElementSummary summary;
  std::array<std::uint32_t, kSlots> counts{};
  memory->counts.download(counts);  // this ends when all of the picture is made
  summary.statistics = mesh.statistics();
  for (std::size_t bin = 0; bin < Histogram::kBins; ++bin) summary.histogram.counts[bin] = counts[bin];
  summary.histogram.below = counts[kSlotBelow];
  summary.histogram.above = counts[kSlotAbove];
  if (summary.statistics.worst_element != kNoIndex) summary.worst.push_back({summary.statistics.worst_element, summary.statistics.minimum});
  return std::make_shared<Picture>(shared_from_this(), std::move(memory), task, std::move(summary));
}

std::unique_ptr<Pictures::Memory> Pictures::take(const Task& task) {
  std::unique_ptr<Memory> memory;
  {
    const std::scoped_lock lock(mutex_);
    if (!free_.empty()) {
      memory = std::move(free_.back());
      free_.pop_back();
    }
  }
  if (memory == nullptr)
    return std::make_unique<Memory>(Memory{Buffer<Vec3>(maker_, task.vertex_count), Buffer<float>(maker_, task.element_count),
                                           Buffer<std::uint32_t>(maker_, kSlots), nullptr});
  if (memory->last_read != nullptr) maker_->wait_for(*memory->last_read);
  return memory;
}

void Pictures::give_back(std::unique_ptr<Memory> memory) noexcept {
  try {
    const std::scoped_lock lock(reading_);
    memory->last_read = reader_->mark();
    const std::scoped_lock free_lock(mutex_);
    free_.push_back(std::move(memory));
  } catch (...) {
    return;  // a lost device's memory is not used again
  }
}

}  // namespace dmoscope::gpu
