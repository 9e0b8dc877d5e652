#include "tests/gpu/ptx/ptx_queue.h"

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <new>
#include <typeinfo>

#include <cxxabi.h>
#include <fmt/format.h>

#include "core/base/error.h"
#include "core/quality/formulas.h"
#include "gpu/bodies.h"
#include "gpu/composite_bodies.h"
#include "gpu/defined/bodies.h"
#include "gpu/defined/formula_source.h"
#include "gpu/defined/target_bodies.h"
#include "gpu/nvrtc.h"
#include "gpu/volume_bodies.h"

namespace dmoscope::gpu::ptx {

std::string demangled(const char* name) {
  int status = 0;
  const std::unique_ptr<char, void (*)(void*)> text(abi::__cxa_demangle(name, nullptr, nullptr, &status), std::free);
  if (status != 0) throw Fault(fmt::format("no mangled name: {}", name));
  return text.get();
}

std::filesystem::path kernels_folder() {
#ifdef DMOSCOPE_PTX_ROOT
  const char* const asked = std::getenv("DMOSCOPE_PTX");
  return std::filesystem::path(DMOSCOPE_PTX_ROOT) / (asked != nullptr && *asked != '\0' ? asked : DMOSCOPE_PTX_ARCHITECTURE);
#else
  return {};
#endif
}

namespace {

constexpr std::size_t kBlockSize = 128, kTeamSize = 8, kWarpSize = 32;
constexpr std::align_val_t kAlignment{256};  // a device's alignment

template <class Body>
Kernels::Name solo() {
  return {fmt::format("void dmoscope::gpu::kernel<{}, dmoscope::Solo>(dmoscope::gpu::Task, unsigned long)", demangled(typeid(Body).name())),
          1};
}
template <class Body>
Kernels::Name in_team() {
  return {fmt::format("void dmoscope::gpu::kernel<{}, dmoscope::gpu::CudaTeam>(dmoscope::gpu::Task, unsigned long)",
                      demangled(typeid(Body).name())),
          kTeamSize};
}

template <class Body>
Kernels::Name in_warp() {
  return {fmt::format("void dmoscope::gpu::kernel<{}, dmoscope::gpu::Warp>(dmoscope::gpu::Task, unsigned long)",
                      demangled(typeid(Body).name())),
          kWarpSize};
}

template <class Body>
Kernels::Name in_staging_team(std::size_t bytes) {
  return {fmt::format("void dmoscope::gpu::kernel<{}, dmoscope::gpu::StagingCudaTeam<{}u, {}ul> >(dmoscope::gpu::Task, unsigned long)",
                      demangled(typeid(Body).name()), kBlockSize, bytes),
          kTeamSize};
}

template <bool Crossed>
Kernels::Name target_name_for(Work work) {
  if (work == Work::VisitTargets) return solo<bodies::VisitTargets<Crossed>>();
  if (work == Work::VisitTargetsInTeam) return in_team<bodies::VisitTargets<Crossed>>();
  return in_staging_team<bodies::SearchTargets<Crossed>>(bodies::kTargetStageBytes);
}

template <class Frame>
Kernels::Name defined_name_for(Work work, bool in_double) {
  switch (work) {
    case Work::PrepareDefined:
      return solo<bodies::PrepareDefined<Frame>>();
    case Work::SearchDefined:
      return in_double ? in_warp<bodies::SearchDefined<Frame, double>>() : in_warp<bodies::SearchDefined<Frame, float>>();
    case Work::UntangleDefined:
      return in_team<bodies::UntangleDefined<Frame>>();
    case Work::SettleDefined:
      return solo<bodies::SettleDefined<Frame>>();
    default:
      return solo<bodies::JudgeDefined<Frame>>();
  }
}

template <Metric M>
Kernels::Name name_for(Work work) {
  switch (work) {
    case Work::VisitSmallFans:
      return solo<bodies::Visit<M, Stars::SmallFans>>();
    case Work::VisitLargeFans:
      return solo<bodies::Visit<M, Stars::LargeFans>>();
    case Work::VisitOthers:
      return solo<bodies::Visit<M, Stars::Others>>();
    case Work::VisitInTeam:
      return in_team<bodies::Visit<M, Stars::All, true>>();
    case Work::VisitComposite:
      return in_team<bodies::VisitComposite<M, dmoscope::Plane>>();
    case Work::Settle:
      return in_team<bodies::Settle<M>>();
    case Work::Judge:
      return solo<bodies::Judge<M, dmoscope::Plane>>();
    default:
      return {};
  }
}

Kernels::Name plain_name_for(Work work) {
  switch (work) {
    case Work::Sum:
      return solo<bodies::Sum>();
    case Work::Total:
      return in_team<bodies::Total>();
    case Work::Conclude:
      return solo<bodies::Conclude>();
    case Work::Load:
      return solo<bodies::Load>();
    case Work::Store:
      return solo<bodies::Store>();
    case Work::Shade:
      return solo<bodies::Shade>();
    case Work::Count:
      return {
          fmt::format("void dmoscope::gpu::count_kernel<{}>(dmoscope::gpu::Task, unsigned long)", demangled(typeid(bodies::Count).name())),
          1, bodies::Count::kEach};
    case Work::Project:
      return solo<bodies::Project>();
    case Work::CopyShades:
      return solo<bodies::CopyShades>();
    case Work::Pick:
      return solo<bodies::Pick>();
    default:
      return {};
  }
}

template <Metric M>
Kernels::Name volume_name_for(Work work) {
  if (work == Work::JudgeVolume) return solo<bodies::Judge<M, dmoscope::Space>>();
  if (work == Work::VisitVolumeComposite) return in_team<bodies::VisitComposite<M, dmoscope::Space>>();
  return in_staging_team<bodies::VisitVolume<M>>(kStageBytes);
}

/// A search that NVRTC compiled.
class PtxSearch final : public Queue::CompiledSearch {
 public:
  explicit PtxSearch(const std::string& ptx) : entry_(decode(find_entries(ptx).at(0))) {}
  [[nodiscard]] const Entry& entry() const noexcept { return entry_; }

 private:
  Entry entry_;
};

class Recorded final : public Queue::Recording {
 public:
  std::vector<std::function<void()>> steps;
};

class PtxQueue final : public Queue, public std::enable_shared_from_this<PtxQueue> {
 public:
  PtxQueue(std::shared_ptr<Kernels> kernels, const PtxDevice& device) : kernels_(std::move(kernels)), device_(device) {}

  void* allocate(std::size_t bytes) override {
    void* memory = ::operator new(bytes, kAlignment);
    std::memset(memory, 0xcd, bytes);
    global_.add(memory, bytes);
    counters().bytes_allocated += bytes;
    return memory;
  }
  void release(void* memory) noexcept override {
    counters().bytes_allocated -= global_.remove(memory);
    ::operator delete(memory, kAlignment);
  }
  void upload(void* to, const void* from, std::size_t bytes, ThreadPool* /*pool*/) override {
    check(to, bytes);
    std::memcpy(to, from, bytes);
  }
  void download(void* to, const void* from, std::size_t bytes, ThreadPool* /*pool*/) override {
    check(from, bytes);
    std::memcpy(to, from, bytes);
  }
  void* allocate_on_host(std::size_t bytes) override { return ::operator new(bytes); }
  void release_on_host(void* memory) noexcept override { ::operator delete(memory); }
  void fetch(void* to, const void* from, std::size_t bytes) override {
    check(from, bytes);
    enqueue([to, from, bytes] { std::memcpy(to, from, bytes); });
  }
  void clear(void* memory, std::size_t bytes) override {
    check(memory, bytes);
    enqueue([memory, bytes] { std::memset(memory, 0, bytes); });
  }
  void launch(Work work, Metric metric, const Task& task, std::size_t count) override {
    enqueue([this, work, metric, task, count] {
      try {
        run(work, metric, task, count);
      } catch (const Fault& fault) {
        throw DeviceError(fault.what());
      }
    });
  }
  Compiled compile(const std::string& source) override {
    const Nvrtc* compiler = device_.compiles ? Nvrtc::find() : nullptr;
    if (compiler == nullptr) return {nullptr, "nobody was asked to"};
    return {std::make_shared<const PtxSearch>(compiler->compile(source, formula_headers(), 75)), compiler->description()};
  }
  void launch_search(const CompiledSearch& search, const StarSearchTask& task, std::size_t count) override {
    enqueue([this, &search, task, count] {
      const Kernels::Name name{kFormulaKernel, kFormulaWarp};
      run(static_cast<const PtxSearch&>(search).entry(), name, Work::SearchDefined, task, count);
    });
  }
  void wait() override {}

  void replay(Recording& recording) override {
    for (const auto& step : static_cast<Recorded&>(recording).steps) step();
  }

  std::shared_ptr<Queue> sibling(Urgency /*urgency*/) const override { return std::const_pointer_cast<PtxQueue>(shared_from_this()); }
  std::unique_ptr<Mark> mark() override { return std::make_unique<Mark>(); }
  void wait_for(const Mark& /*mark*/) override {}
  std::unique_ptr<DeviceTarget> make_target(std::uint32_t /*point_buffer*/, std::uint32_t /*shade_buffer*/) override {
    throw DeviceError("PTX run on the host writes no OpenGL buffers");
  }
  void draw(DeviceTarget& /*target*/, const Task& /*task*/) override {}

  std::size_t lanes_at_once() const noexcept override { return device_.lanes_at_once; }
  std::string description() const override { return "PTX run on the host"; }

 private:
  void start_recording() override { recording_ = std::make_unique<Recorded>(); }
  std::unique_ptr<Recording> stop_recording() override { return std::move(recording_); }
  void drop_recording() noexcept override { recording_.reset(); }
  void begin_side() override {
    enqueue([this] {
      if (device_.schedule.races != nullptr) device_.schedule.races->forget();
      at_once_ = true;
    });
  }
  void join_side() override {
    enqueue([this] { at_once_ = false; });
  }

  void check(const void* memory, std::size_t bytes) const {
    if (!global_.holds(reinterpret_cast<std::uintptr_t>(memory), bytes)) throw DeviceError("a copy beyond what was allocated");
  }
  template <class Step>
  void enqueue(Step step) {
    if (recording_ != nullptr)
      recording_->steps.emplace_back(std::move(step));
    else
      step();
  }
  void run(Work work, Metric metric, const Task& task, std::size_t count) {
    run(kernels_->find(work, metric, task.defined), Kernels::name_of(work, metric, task.defined), work, task, count);
  }
  /// Calls f.template operator()<T>() with the type of the kernel's first parameter; the second is the count.
  template <class T>
  void run(const Entry& entry, const Kernels::Name& name, Work work, const T& task, std::size_t count) {
    try {
      std::vector<std::byte> parameters(sizeof(T) + sizeof(std::uint64_t));
      std::memcpy(parameters.data(), &task, sizeof(T));
      std::memcpy(parameters.data() + sizeof(T), &count, sizeof(std::uint64_t));
      const std::size_t lanes = (count + name.each - 1) / name.each * name.team;
      if (device_.schedule.races != nullptr && !at_once_) device_.schedule.races->forget();
      const std::uint64_t instructions = run_blocks(entry, global_, parameters, (lanes + kBlockSize - 1) / kBlockSize, device_.schedule);
      if (device_.instructions != nullptr) (*device_.instructions)[work] += instructions;
    } catch (const Fault& fault) {
      throw DeviceError(fault.what());
    }
  }

  std::shared_ptr<Kernels> kernels_;
  PtxDevice device_;
  GlobalMemory global_;
  std::unique_ptr<Recorded> recording_;
  bool at_once_ = false;  // whether launches may be done at once
};

}  // namespace

Kernels::Kernels(const std::filesystem::path& folder) {
  for (const auto& file : std::filesystem::directory_iterator(folder)) {
    if (file.path().extension() != ".ptx") continue;
    std::ifstream in(file.path(), std::ios::binary);
    for (EntryText& entry : find_entries(std::string(std::istreambuf_iterator<char>(in), {}))) texts_.push_back(std::move(entry));
  }
  if (texts_.empty()) throw Fault(fmt::format("no kernels in {}", folder.string()));
  for (std::size_t i = 0; i < texts_.size(); ++i)
    if (!by_name_.emplace(demangled(texts_[i].name.c_str()), i).second) throw Fault(fmt::format("two kernels {}", texts_[i].name));
}

const Entry& Kernels::find(Work work, Metric metric, const DefinedTask& defined) { return find(name_of(work, metric, defined).text); }

const Entry& Kernels::find(const std::string& name) {
  if (const auto found = decoded_.find(name); found != decoded_.end()) return found->second;
  const auto text = by_name_.find(name);
  if (text == by_name_.end()) throw Fault(fmt::format("no kernel {}", name));
  return decoded_.emplace(name, decode(texts_[text->second])).first->second;
}

Kernels::Name Kernels::name_of(Work work, Metric metric, const DefinedTask& defined) {
  if (is_by_targets(work)) return defined.crossed ? target_name_for<true>(work) : target_name_for<false>(work);
  if (is_by_defined(work))
    return defined.is_volume ? defined_name_for<dmoscope::Space>(work, defined.in_double)
                             : defined_name_for<dmoscope::Plane>(work, defined.in_double);
  if (!is_by_metric(work)) return plain_name_for(work);
  if (is_of_solids(work)) return formulas::with_volume_metric(metric, [work]<Metric M>() { return volume_name_for<M>(work); });
  return formulas::with_planar_metric(metric, [work]<Metric M>() { return name_for<M>(work); });
}

std::shared_ptr<Queue> make_ptx_queue(std::shared_ptr<Kernels> kernels, const PtxDevice& device) {
  return std::make_shared<PtxQueue>(std::move(kernels), device);
}

}  // namespace dmoscope::gpu::ptx
