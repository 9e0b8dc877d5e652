#pragma once
// Quality of many elements at once: the same bits as element_quality() and smallest_jacobian(), at the speed of memory.

#include <array>
#include <memory>
#include <span>

#include "core/quality/quality.h"

namespace dmoscope {

/// Consecutive elements and what is known of each.
struct ElementBlock {
  static constexpr std::size_t kSize = 256;

  Index first = 0;
  std::size_t count = 0;
  alignas(64) std::array<double, kSize> quality;   // NaN where the metric is not defined for the kind
  alignas(64) std::array<double, kSize> jacobian;  // smallest_jacobian()

  [[nodiscard]] std::span<const double> qualities() const noexcept { return {quality.data(), count}; }
  [[nodiscard]] std::span<const double> jacobians() const noexcept { return {jacobian.data(), count}; }
};

/// Judges the elements block.first .. block.first + block.count of a mesh by one metric.
class BlockJudge {
 public:
  BlockJudge(const QualityContext& context, Metric metric);
  void operator()(const QualityContext& context, std::span<const Vec3> positions, ElementBlock& block) const;

 private:
  using BuiltIn = void (*)(const QualityContext& context, std::span<const Vec3> positions, ElementBlock& block);
  BuiltIn built_in_ = nullptr;
  std::shared_ptr<const DefinedJudge> defined_;  // of any other metric; null: it is not defined for the mesh
};

/// Calls take(block) for blocks that together cover the elements [first, last), in their order.
template <class Take>
void for_blocks(const QualityContext& context, std::span<const Vec3> positions, Metric metric, std::size_t first, std::size_t last,
                Take take) {
  const BlockJudge judge(context, metric);
  ElementBlock block;
  for (std::size_t e = first; e < last; e += ElementBlock::kSize) {
    block.first = static_cast<Index>(e);
    block.count = last - e < ElementBlock::kSize ? last - e : ElementBlock::kSize;
    judge(context, positions, block);
    take(static_cast<const ElementBlock&>(block));
  }
}

}  // namespace dmoscope
