#pragma once
// Snapshots of a run on a device, to be drawn by another thread.

#include <memory>
#include <mutex>
#include <vector>

#include "core/run/device_picture.h"
#include "gpu/device_mesh.h"

namespace dmoscope::gpu {

/// Makes pictures of one mesh and reuses their memory.
class Pictures : public std::enable_shared_from_this<Pictures> {
 public:
  explicit Pictures(std::shared_ptr<Queue> maker) : maker_(std::move(maker)), reader_(maker_->sibling(Urgency::First)) {}

  /// Makes a picture of the mesh as it is now, judged by `shown`. To be called on the thread that steps. Throws DeviceError.
  [[nodiscard]] std::shared_ptr<const DevicePicture> make(DeviceMesh& mesh, Metric shown);

 private:
  friend class Picture;
  /// Memory of a picture on the device.
  struct Memory {
    Buffer<Vec3> positions;
    Buffer<float> shades;
    Buffer<std::uint32_t> counts;
    std::unique_ptr<Queue::Mark> last_read;  // the reader's last access; null: none
  };
  [[nodiscard]] std::unique_ptr<Memory> take(const Task& task);
  void give_back(std::unique_ptr<Memory> memory) noexcept;

  /// Memory that is reused, and grows.
  template <class T>
  class Scratch {
   public:
    explicit Scratch(std::shared_ptr<Queue> queue) : queue_(std::move(queue)) {}
    [[nodiscard]] T* with_room_for(std::size_t size) {
      if (size > buffer_.size()) buffer_ = Buffer<T>(queue_, size);
      return buffer_.data();
    }

   private:
    std::shared_ptr<Queue> queue_;
    Buffer<T> buffer_;
  };

  std::shared_ptr<Queue> maker_, reader_;
  std::mutex reading_;  // guards the reader and the members below
  Scratch<Vec2<float>> projected_{reader_};
  Scratch<Index> wanted_{reader_};
  Scratch<Vec3> picked_{reader_};
  std::mutex mutex_;  // guards free_
  std::vector<std::unique_ptr<Memory>> free_;
};

}  // namespace dmoscope::gpu
