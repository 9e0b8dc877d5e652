#include "render/egl_order.h"

#include <charconv>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/error.h"

namespace dmoscope::render {
namespace {

EglWay way_to(std::span<const EglDevice> devices, std::size_t k) {
  std::string description = fmt::format("EGL device {}", k);
  if (devices[k].cuda) description += fmt::format(" (CUDA device {})", *devices[k].cuda);
  if (devices[k].software) description += " (software)";
  return {k, std::move(description)};
}

/// The number after `prefix`; none when the word does not begin with it or goes on with anything else.
std::optional<std::size_t> number_after(std::string_view prefix, std::string_view word) {
  if (!word.starts_with(prefix)) return std::nullopt;
  word.remove_prefix(prefix.size());
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  return error == std::errc() && end == word.data() + word.size() ? std::optional(number) : std::nullopt;
}

std::optional<std::size_t> device_of_cuda(std::span<const EglDevice> devices, std::size_t cuda) {
  for (std::size_t k = 0; k < devices.size(); ++k) {
    if (devices[k].cuda && static_cast<std::size_t>(*devices[k].cuda) == cuda) return k;
  }
  return std::nullopt;
}

EglWay forced_way(std::span<const EglDevice> devices, const EglWay& surfaceless, std::string_view forced) {
  if (forced == "surfaceless") return surfaceless;
  if (const auto k = number_after("device:", forced); k && *k < devices.size()) return way_to(devices, *k);
  if (const auto cuda = number_after("cuda:", forced)) {
    if (const auto k = device_of_cuda(devices, *cuda)) return way_to(devices, *k);
  }
  std::vector<std::string> known{"surfaceless"};
  for (std::size_t k = 0; k < devices.size(); ++k) {
    known.push_back(fmt::format("device:{}", k));
    if (devices[k].cuda) known.push_back(fmt::format("cuda:{}", *devices[k].cuda));
  }
  throw UsageError(fmt::format("DMOSCOPE_EGL is '{}'; here it may be {}", forced, fmt::join(known, ", ")));
}

}  // namespace

std::vector<EglWay> egl_order(std::span<const EglDevice> devices, std::string_view forced, std::optional<int> cuda_device) {
  const EglWay surfaceless{std::nullopt, "surfaceless EGL"};
  if (!forced.empty()) return {forced_way(devices, surfaceless, forced)};
  std::vector<EglWay> order;
  const auto smoothing = cuda_device ? device_of_cuda(devices, static_cast<std::size_t>(*cuda_device)) : std::nullopt;
  if (smoothing) order.push_back(way_to(devices, *smoothing));
  order.push_back(surfaceless);
  for (std::size_t k = 0; k < devices.size(); ++k) {
    if (smoothing != k) order.push_back(way_to(devices, k));
  }
  return order;
}

}  // namespace dmoscope::render
