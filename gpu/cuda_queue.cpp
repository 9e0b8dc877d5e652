#include "gpu/cuda_queue.h"

#ifdef DMOSCOPE_HAVE_CUDA

#include <array>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

#include <cuda_runtime.h>
#include <fmt/format.h>

#include "core/quality/formulas.h"
#include "gpu/cuda_error.h"
#include "gpu/cuda_handles.h"
#include "gpu/cuda_launch.h"
#include "gpu/cuda_module.h"
#include "gpu/cuda_staging.h"
#include "gpu/defined/formula_source.h"
#include "gpu/gl_interop.h"
#include "gpu/nvrtc.h"
#include "gpu/task.h"

namespace dmoscope::gpu {

namespace {

/// Threads that a multiprocessor runs at once in the search's kernel, which takes nearly all registers a thread may have.
constexpr std::size_t kThreadsAtOnce = 256;
/// Size of each piece of a device's memory. Any thread may release a piece.
class Memory {
 public:
  void add(void* memory, std::size_t bytes) {
    const std::scoped_lock lock(mutex_);
    sizes_[memory] = bytes;
  }
  std::size_t take(void* memory) {
    const std::scoped_lock lock(mutex_);
    const auto found = sizes_.find(memory);
    const std::size_t bytes = found->second;
    sizes_.erase(found);
    return bytes;
  }

 private:
  std::mutex mutex_;
  std::unordered_map<void*, std::size_t> sizes_;
};

class CudaCompiledSearch final : public Queue::CompiledSearch {
 public:
  explicit CudaCompiledSearch(const std::string& ptx) : module_(ptx, kFormulaKernel) {}
  [[nodiscard]] const CudaModule& get() const noexcept { return module_; }

 private:
  CudaModule module_;
};

/// Cache of the last compiled searches and failed compilations, for a changed parameter starts a run by the same formula again. Any thread
/// may ask.
class CompiledSearches {
 public:
  /// Returns the search for the current device, compiled now unless it is cached.
  Queue::Compiled get(const Nvrtc& compiler, const std::string& source, int capability) {
    const std::scoped_lock lock(mutex_);
    if (const auto found = searches_.find(source); found != searches_.end()) return found->second;
    if (searches_.size() >= kMost) searches_.clear();
    return searches_[source] = compiled(compiler, source, capability);
  }

 private:
  static Queue::Compiled compiled(const Nvrtc& compiler, const std::string& source, int capability) {
    try {
      const std::string ptx = compiler.compile(source, formula_headers(), capability);
      return {std::make_shared<const CudaCompiledSearch>(ptx), compiler.description()};
    } catch (const DeviceError& error) {
      const std::string_view what = error.what();
      return {nullptr, std::string(what.substr(0, what.find('\n')))};
    }
  }

  static constexpr std::size_t kMost = 32;
  std::mutex mutex_;
  std::unordered_map<std::string, Queue::Compiled> searches_;
};

/// Properties and memory that all queues of a device share.
struct CudaDevice {
  int number = 0, capability = 0;  // 75 means 7.5
  std::size_t lanes_at_once = 0;
  std::string description;
  std::shared_ptr<Memory> memory = std::make_shared<Memory>();
  std::shared_ptr<CompiledSearches> searches = std::make_shared<CompiledSearches>();

  explicit CudaDevice(int device) : number(device) {
    cudaDeviceProp properties{};
    DMOSCOPE_CUDA_CHECK(cudaGetDeviceProperties(&properties, device));
    capability = 10 * properties.major + properties.minor;
    lanes_at_once = static_cast<std::size_t>(properties.multiProcessorCount) * kThreadsAtOnce;
    description = fmt::format("{}, compute capability {}.{}, {:.1f} GiB", properties.name, properties.major, properties.minor,
                              static_cast<double>(properties.totalGlobalMem) / 0x1p30);
  }
};

class CudaRecording final : public Queue::Recording {
 public:
  CudaRecording(cudaGraph_t graph, cudaStream_t stream) {
    const cudaError_t status = cudaGraphInstantiate(&executable_, graph, 0);
    (void)cudaGraphDestroy(graph);
    DMOSCOPE_CUDA_CHECK(status);
    const cudaError_t uploaded = cudaGraphUpload(executable_, stream);  // otherwise the first launch would upload it
    if (uploaded != cudaSuccess) (void)cudaGraphExecDestroy(executable_);
    DMOSCOPE_CUDA_CHECK(uploaded);
  }
  ~CudaRecording() override { (void)cudaGraphExecDestroy(executable_); }
  [[nodiscard]] cudaGraphExec_t get() const noexcept { return executable_; }

 private:
  cudaGraphExec_t executable_ = nullptr;
};

class CudaMark final : public Queue::Mark {
 public:
  explicit CudaMark(cudaStream_t stream) { event_.record(stream); }
  [[nodiscard]] const CudaEvent& event() const noexcept { return event_; }

 private:
  CudaEvent event_;
};

/// Second stream of a queue, for work that is independent of the first stream's.
struct Side {
  explicit Side(int device, Urgency urgency) : stream(device, urgency) {}
  CudaStream stream;
  CudaEvent forked, joined;
};

class CudaQueue final : public Queue {
 public:
  CudaQueue(std::shared_ptr<const CudaDevice> device, std::shared_ptr<Counters> counters, Urgency urgency)
      : Queue(std::move(counters)), about_(std::move(device)), device_(about_->number), urgency_(urgency), stream_(device_, urgency) {}
  ~CudaQueue() override {
    (void)cudaSetDevice(device_);
    if (side_) (void)cudaStreamSynchronize(side_->stream.get());
    (void)cudaStreamSynchronize(stream_.get());
  }

  void* allocate(std::size_t bytes) override {
    use(device_);
    void* memory = nullptr;
    const cudaError_t status = cudaMalloc(&memory, bytes);
    if (status == cudaErrorMemoryAllocation) {
      (void)cudaGetLastError();  // this error is handled here
      std::size_t free = 0, total = 0;
      (void)cudaMemGetInfo(&free, &total);
      throw DeviceError(
          fmt::format("{} is out of memory: {} bytes were asked for, {} of {} are free", about_->description, bytes, free, total));
    }
    DMOSCOPE_CUDA_CHECK(status);
    try {
      about_->memory->add(memory, bytes);
    } catch (...) {
      (void)cudaFree(memory);
      throw;
    }
    counters().bytes_allocated += bytes;
    return memory;
  }
  void release(void* memory) noexcept override {
    (void)cudaSetDevice(device_);
    (void)cudaFree(memory);
    counters().bytes_allocated -= about_->memory->take(memory);
  }

  void upload(void* to, const void* from, std::size_t bytes, ThreadPool* pool) override {
    use(device_);
    if (bytes >= CudaStaging::kWorthIt) return staging().upload(stream_.get(), to, from, bytes, pool);
    DMOSCOPE_CUDA_CHECK(cudaMemcpyAsync(to, from, bytes, cudaMemcpyHostToDevice, stream_.get()));
    DMOSCOPE_CUDA_CHECK(cudaStreamSynchronize(stream_.get()));  // the only sign that the device has read ordinary memory
  }
  void download(void* to, const void* from, std::size_t bytes, ThreadPool* pool) override {
    use(device_);
    if (bytes >= CudaStaging::kWorthIt) return staging().download(stream_.get(), to, from, bytes, pool);
    fetch(to, from, bytes);
    // Waits before anything can fail, or the device could write memory that its owner has released meanwhile.
    DMOSCOPE_CUDA_CHECK(cudaStreamSynchronize(stream_.get()));
  }
  void* allocate_on_host(std::size_t bytes) override {
    use(device_);
    void* memory = nullptr;
    DMOSCOPE_CUDA_CHECK(cudaMallocHost(&memory, bytes));
    return memory;
  }
  void release_on_host(void* memory) noexcept override {
    (void)cudaSetDevice(device_);
    (void)cudaStreamSynchronize(stream_.get());  // after a failure the device may have yet to write it
    (void)cudaFreeHost(memory);
  }
  void fetch(void* to, const void* from, std::size_t bytes) override {
    use(device_);
    DMOSCOPE_CUDA_CHECK(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToHost, stream_.get()));
  }
  void clear(void* memory, std::size_t bytes) override {
    use(device_);
    DMOSCOPE_CUDA_CHECK(cudaMemsetAsync(memory, 0, bytes, stream_.get()));
  }
  void launch(Work work, Metric metric, const Task& task, std::size_t count) override {
    if (count == 0) return;
    use(device_);
    launcher(work, metric, task.defined)(task, count, (on_side_ ? side_->stream : stream_).get());
  }
  Compiled compile(const std::string& source) override {
    use(device_);
    int driver = 0;
    DMOSCOPE_CUDA_CHECK(cudaDriverGetVersion(&driver));
    const Nvrtc* compiler = Nvrtc::find(driver);
    if (compiler == nullptr) return {nullptr, "there is no NVRTC that the driver is for; CUDA's toolkit has it"};
    return about_->searches->get(*compiler, source, about_->capability);
  }
  void launch_search(const CompiledSearch& search, const StarSearchTask& task, std::size_t count) override {
    if (count == 0) return;
    use(device_);
    StarSearchTask of = task;
    void* arguments[] = {&of, &count};
    const std::size_t blocks = (count * kFormulaWarp + kFormulaBlock - 1) / kFormulaBlock;
    static_cast<const CudaCompiledSearch&>(search).get().launch(blocks, kFormulaBlock, arguments, stream_.get());
  }
  void wait() override {
    use(device_);
    DMOSCOPE_CUDA_CHECK(cudaStreamSynchronize(stream_.get()));
  }

  void replay(Recording& recording) override {
    use(device_);
    DMOSCOPE_CUDA_CHECK(cudaGraphLaunch(static_cast<CudaRecording&>(recording).get(), stream_.get()));
  }

  std::shared_ptr<Queue> sibling(Urgency urgency) const override { return std::make_shared<CudaQueue>(about_, shared_counters(), urgency); }
  std::unique_ptr<Mark> mark() override {
    use(device_);
    return std::make_unique<CudaMark>(stream_.get());
  }
  void wait_for(const Mark& mark) override {
    use(device_);
    DMOSCOPE_CUDA_CHECK(cudaStreamWaitEvent(stream_.get(), static_cast<const CudaMark&>(mark).event().get(), 0));
  }

  std::unique_ptr<DeviceTarget> make_target(std::uint32_t point_buffer, std::uint32_t shade_buffer) override {
    return std::make_unique<GlTarget>(device_, point_buffer, shade_buffer);
  }
  void draw(DeviceTarget& target, const Task& task) override {
    use(device_);
    static_cast<GlTarget&>(target).fill(stream_.get(), nullptr, [&](const GlTarget::Mapped& mapped) {
      if (mapped.point_bytes < task.vertex_count * sizeof(Vec2<float>) || mapped.shade_bytes < task.element_count * sizeof(float))
        throw DeviceError("OpenGL's buffers are too small for the mesh");
      Task into = task;
      into.points = reinterpret_cast<Vec2<float>*>(mapped.points);
      into.drawn_shades = mapped.shades;
      launch(Work::Project, kNoMetric, into, task.vertex_count);
      launch(Work::CopyShades, kNoMetric, into, task.element_count);
    });
  }

  std::size_t lanes_at_once() const noexcept override { return about_->lanes_at_once; }
  std::string description() const override { return about_->description; }

 private:
  void start_recording() override {
    use(device_);
    DMOSCOPE_CUDA_CHECK(cudaStreamBeginCapture(stream_.get(), cudaStreamCaptureModeThreadLocal));
  }
  std::unique_ptr<Recording> stop_recording() override {
    cudaGraph_t graph = nullptr;
    DMOSCOPE_CUDA_CHECK(cudaStreamEndCapture(stream_.get(), &graph));
    return std::make_unique<CudaRecording>(graph, stream_.get());
  }
  void drop_recording() noexcept override {
    cudaGraph_t graph = nullptr;
    (void)cudaStreamEndCapture(stream_.get(), &graph);
    if (graph != nullptr) (void)cudaGraphDestroy(graph);
    (void)cudaGetLastError();
  }

  void begin_side() override {
    use(device_);
    if (!side_) side_.emplace(device_, urgency_);
    side_->forked.record(stream_.get());
    DMOSCOPE_CUDA_CHECK(cudaStreamWaitEvent(side_->stream.get(), side_->forked.get(), 0));
    on_side_ = true;
  }
  void end_side() noexcept override { on_side_ = false; }
  void join_side() override {
    use(device_);
    side_->joined.record(side_->stream.get());
    DMOSCOPE_CUDA_CHECK(cudaStreamWaitEvent(stream_.get(), side_->joined.get(), 0));
  }

  CudaStaging& staging() {
    if (!staging_) staging_.emplace();
    return *staging_;
  }

  template <std::size_t... Part>
  static Launcher metric_launcher(Metric metric, Work work, std::index_sequence<Part...> /*parts*/) {
    static constexpr std::array<Launcher (*)(Metric, Work), kMetricParts> kParts{&part_launcher<Part>...};
    return kParts[static_cast<std::size_t>(metric) % kMetricParts](metric, work);
  }
  static Launcher launcher(Work work, Metric metric, const DefinedTask& defined) {
    if (is_by_targets(work)) return target_launcher(work, defined.crossed);
    if (is_by_defined(work))
      return defined.is_volume ? defined_launcher<Space>(work, defined.in_double) : defined_launcher<Plane>(work, defined.in_double);
    if (!is_by_metric(work)) return plain_launcher(work);
    const Metric own = is_of_solids(work) ? formulas::with_volume_metric(metric, []<Metric M>() { return M; })
                                          : formulas::with_planar_metric(metric, []<Metric M>() { return M; });
    return metric_launcher(own, work, std::make_index_sequence<kMetricParts>{});
  }

  std::shared_ptr<const CudaDevice> about_;
  int device_;
  Urgency urgency_;
  CudaStream stream_;
  std::optional<Side> side_;
  bool on_side_ = false;  // whether work is put on the second stream now
  std::optional<CudaStaging> staging_;
};

}  // namespace

std::shared_ptr<Queue> make_cuda_queue(int device) {
  return std::make_shared<CudaQueue>(std::make_shared<const CudaDevice>(device), std::make_shared<Counters>(), Urgency::Last);
}

}  // namespace dmoscope::gpu

#else

#include "core/base/error.h"

namespace dmoscope::gpu {

std::shared_ptr<Queue> make_cuda_queue(int /*device*/) { throw DeviceError("built without a CUDA toolkit"); }

}  // namespace dmoscope::gpu

#endif
