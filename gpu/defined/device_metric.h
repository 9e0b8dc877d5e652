#pragma once
// A metric that is defined by a formula or a target, on a device: its programs, its targets, and room for the visits' stars.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/quality/defined_judge.h"
#include "core/smooth/task.h"
#include "gpu/queue.h"
#include "gpu/task.h"

namespace dmoscope::gpu {

class ProgramTable;

class DeviceMetric {
 public:
  /// Copies the metric of `task` to the device. `mesh`: the kernels' view of the mesh. Throws DeviceError.
  DeviceMetric(std::shared_ptr<Queue> queue, const SmoothingTask& task, const Task& mesh);

  /// Visits ranks [first, last), all of one class, by this metric and the rules of `task`.
  void visit(Task task, std::size_t first, std::size_t last) const;
  /// Finds every element's quality.
  void judge(Task task) const;
  /// Runs every kernel once, for the vertex of rank 0, which needs no visit.
  void warm_up(const Task& task) const;

  /// Tells how the programs are run: "the metric compiled by NVRTC 13.0".
  [[nodiscard]] std::string description() const;

 private:
  void upload_programs(const ProgramTable& table);
  void upload_targets(const SmoothingTask& task);
  void lay_out(const InputMesh& input, const Colouring& colouring, const ProgramTable& table);
  void launch_visits(const Task& task) const;
  void launch_targets(const Task& task) const;

  std::shared_ptr<Queue> queue_;
  std::shared_ptr<const DefinedJudge> judge_;
  Buffer<ProgramCode> programs_;
  Buffer<FormulaStep> steps_;
  Buffer<FormulaProgram::Given> given_;
  Buffer<FormulaProgram::Constant> constants_;
  Buffer<double> prepared_, matrices_, steepness_, fields_, registers_;
  Buffer<std::uint16_t> groups_;
  Buffer<std::uint32_t> first_matrix_, numbers_at_;
  Buffer<std::byte> numbers_;
  Buffer<double> star_targets_;
  Buffer<std::uint32_t> first_target_;
  Buffer<std::uint8_t> fits_;
  Buffer<SoughtStar> stars_;
  Buffer<StarState> before_;
  Queue::Compiled compiled_;            // without a search the programs are run step by step
  std::vector<std::size_t> stretches_;  // their first ranks, then the number of visits
  std::size_t registers_of_lane_ = 1;
  DefinedTask task_;
};

}  // namespace dmoscope::gpu
