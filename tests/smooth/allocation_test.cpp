// Stepping allocates nothing: this file replaces the program's operator new by one that counts.

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <new>
#include <vector>

#include <gtest/gtest.h>

#include "core/mesh/colouring.h"
#include "core/smooth/execution/method_table.h"
#include "core/smooth/smoother.h"
#include "tests/support/meshes.h"

namespace {
std::atomic<std::uint64_t> allocations{0};

void* allocate_if_possible(std::size_t size, std::size_t alignment) noexcept {
  ++allocations;
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}
void* allocate(std::size_t size, std::size_t alignment) {
  void* const block = allocate_if_possible(size, alignment);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
/// Not inlined: g++ 12 would report free() as a mismatch if it saw operator new.
[[gnu::noinline]] void release(void* block) noexcept { std::free(block); }
}  // namespace

void* operator new(std::size_t size) { return allocate(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
// For std::stable_sort's buffer: this file could not free one of AddressSanitizer's.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return allocate_if_possible(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__);
}
void* operator new(std::size_t size, std::align_val_t alignment) { return allocate(size, static_cast<std::size_t>(alignment)); }
void operator delete(void* block) noexcept { release(block); }
void operator delete(void* block, std::size_t) noexcept { release(block); }
void operator delete(void* block, std::align_val_t) noexcept { release(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { release(block); }

namespace dmoscope {
namespace {

TEST(Allocation, NoneWhileStepping) {
  const auto mesh = testing::input(testing::lattice(40, 0.3, 61));
  std::vector<Index> free;
  for (Index v = 0; v < mesh->mesh.vertex_count(); ++v)
    if (mesh->topology.boundary()[v] == 0) free.push_back(v);
  const auto colouring = std::make_shared<const Colouring>(colour_vertices(mesh->mesh, mesh->topology, free));
  for (const MetricInfo& entry : metric_table()) {
    if (!entry.defined_for(ElementKind::Triangle)) continue;
    for (const SimdLevel level : supported_simd_levels()) {
      const auto smoother = make_smoother({.input = mesh, .colouring = colouring, .metric = entry.metric, .search = {.simd = level}});
      std::vector<Vec3> positions = mesh->mesh.positions;
      std::uint64_t moved = 0;
      const auto iterate = [&] {
        for (Index c = 0; c < colouring->class_count(); ++c)
          moved += smoother->visit(colouring->class_offsets[c], colouring->members(c).size(), positions, nullptr);
        smoother->store(positions, nullptr);
      };
      iterate();
      const std::uint64_t before = allocations, moved_before = moved;
      iterate();
      EXPECT_EQ(allocations - before, 0U) << entry.name << ", " << name(level);
      EXPECT_GT(moved, moved_before);
    }
  }
}

}  // namespace
}  // namespace dmoscope
