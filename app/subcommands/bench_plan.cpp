#include "app/subcommands/bench_plan.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "app/common/acceleration.h"
#include "app/common/machine.h"
#include "app/common/run_options.h"
#include "app/common/text.h"
#include "core/base/error.h"
#include "core/base/unknown_value.h"

namespace dmoscope::app {
namespace {

constexpr std::size_t kSmallest = 100;
constexpr std::size_t kFullSize = 10'000'000;

/// Peak memory of the whole process, bytes per vertex of the largest mesh, with a reserve: 220 measured with each kind of planar elements,
/// 600 with tetrahedra.
constexpr std::uint64_t kBytesPerVertex = 400, kBytesPerVolumeVertex = 1000;

constexpr KindSet kTriangles = kind_set(ElementKind::Triangle), kQuadrilaterals = kind_set(ElementKind::Quadrilateral),
                  kTetrahedra = kind_set(ElementKind::Tetrahedron), kHexahedra = kind_set(ElementKind::Hexahedron),
                  kVolumes = static_cast<KindSet>(kTetrahedra | kHexahedra | kind_set(ElementKind::Wedge) | kind_set(ElementKind::Pyramid)),
                  kPlanar = kTriangles | kQuadrilaterals;
constexpr std::array<BenchElements, 6> kElements{{{"triangles", "grid", kFullSize, kTriangles},
                                                  {"quadrilaterals", "quads", 5'000'000, kQuadrilaterals},
                                                  {"mixed", "mixed", 5'000'000, kPlanar},
                                                  {"tetrahedra", "tetrahedra", 5'000'000, kTetrahedra},
                                                  {"hexahedra", "hexahedra", 5'000'000, kHexahedra},
                                                  {"solids", "solids", 5'000'000, kVolumes}}};

std::vector<std::string_view> words_of(std::string_view list) {
  std::vector<std::string_view> words;
  while (true) {
    const auto comma = list.find(',');
    words.push_back(list.substr(0, comma));
    if (comma == std::string_view::npos) return words;
    list.remove_prefix(comma + 1);
  }
}

/// Parses a list: one entry per word, each once.
template <class Parse>
auto parse_list(std::string_view list, Parse parse) {
  std::vector<decltype(parse(list))> entries;
  for (const std::string_view word : words_of(list)) {
    auto entry = parse(word);
    if (std::find(entries.begin(), entries.end(), entry) == entries.end()) entries.push_back(std::move(entry));
  }
  return entries;
}

std::size_t parse_size(std::string_view word) {
  double value = 0.0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc{} || stop != end || value != std::floor(value) || !(value >= kSmallest && value <= kFullSize)) {
    throw UsageError(
        fmt::format("--sizes: expected whole numbers from {} to {}, such as 10000 or 1e4, not '{}'", kSmallest, kFullSize, word));
  }
  return static_cast<std::size_t>(value);
}

unsigned parse_threads(std::string_view word) {
  unsigned value = 0;
  const char* end = word.data() + word.size();
  const auto [stop, error] = std::from_chars(word.data(), end, value);
  if (error != std::errc{} || stop != end || value > kMostThreads) {
    throw UsageError(fmt::format("--threads: expected whole numbers from 0 to {}, not '{}'", kMostThreads, word));
  }
  return value == 0 ? std::max(1U, std::thread::hardware_concurrency()) : value;
}

std::vector<Metric> parse_metrics(const std::string& list) {
  if (list != "all") return parse_list(list, [](std::string_view word) { return parse_metric(word); });
  std::vector<Metric> metrics;
  for (const MetricInfo& metric : metric_table()) metrics.push_back(metric.metric);
  return metrics;
}

std::vector<SimdLevel> parse_levels(const std::string& list) {
  if (list == "all") return {supported_simd_levels().begin(), supported_simd_levels().end()};
  return parse_list(list, [](std::string_view word) { return word == "auto" ? best_simd_level() : parse_simd_level(word); });
}

std::vector<BenchElements> parse_elements(const std::string& list) {
  if (list == "all") return {kElements.begin(), kElements.end()};
  const auto place = [](std::string_view word) {
    const auto found = std::ranges::find(kElements, word, &BenchElements::name);
    if (found == kElements.end()) throw UsageError("--elements: " + unknown_row("name", word, kElements));
    return static_cast<std::size_t>(found - kElements.begin());
  };
  std::vector<BenchElements> elements;
  for (const std::size_t i : parse_list(list, place)) elements.push_back(kElements[i]);
  return elements;
}

/// Chooses the backends to measure. "auto" is the CPU, and a device if there is one.
void choose_backends(BenchPlan& plan, const std::string& list) {
  const auto wanted = parse_list(list, parse_backend);
  const auto has = [&](Backend backend) { return std::ranges::find(wanted, backend) != wanted.end(); };
  plan.cpu = has(Backend::Cpu) || has(Backend::Auto);
  plan.acceleration = acceleration_for(has(Backend::Cuda) ? Backend::Cuda : has(Backend::Auto) ? Backend::Auto : Backend::Cpu);
}

/// Sets one metric with a second aim, instead of the list of metrics; a density aim has a constant size.
void combine(BenchPlan& plan, const std::string& text) {
  const auto [first, combination] = parse_composite(text);
  plan.metrics = {first};
  plan.combination = combination;
}

/// Throws UsageError for a metric or elements without a partner, which would be dropped silently: each has to fit one of the others.
void require_partners(const BenchPlan& plan, bool all_elements) {
  const Metric* second = plan.combination ? std::get_if<Metric>(&plan.combination->second) : nullptr;
  const auto fit = [second](const BenchElements& elements, Metric metric) {
    return elements.suits(info(metric)) && (second == nullptr || elements.suits(info(*second)));
  };
  for (const Metric metric : plan.metrics) {
    if (plan.all_metrics || std::ranges::any_of(plan.elements, [&](const BenchElements& e) { return fit(e, metric); })) continue;
    throw UsageError(fmt::format("{} is not defined for {}", info(metric).name, names_of(plan.elements)));
  }
  for (const BenchElements& elements : plan.elements) {
    if (all_elements || std::ranges::any_of(plan.metrics, [&](Metric m) { return fit(elements, m); })) continue;
    throw UsageError(fmt::format("none of the metrics is defined for {}", elements.name));
  }
}

void require_sizes(const BenchPlan& plan) {
  const std::size_t largest = std::ranges::max(plan.sizes);
  for (const BenchElements& elements : plan.elements) {
    if (largest <= elements.largest) continue;
    throw UsageError(fmt::format("meshes of {} are made with up to {} vertices, not {}", elements.name, elements.largest, largest));
  }
  const bool volume = std::ranges::any_of(plan.elements, &BenchElements::volume);
  const std::uint64_t needed = (volume ? kBytesPerVolumeVertex : kBytesPerVertex) * largest;
  const std::optional<std::uint64_t> available = available_memory();
  if (!available || needed <= *available) return;
  throw UsageError(fmt::format("a mesh of {} vertices takes about {:.1f} GB of memory and {:.1f} GB are free: choose smaller --sizes",
                               largest, static_cast<double>(needed) / 1e9, static_cast<double>(*available) / 1e9));
}

}  // namespace

std::span<const BenchElements> bench_elements() { return kElements; }

BenchPlan plan_of(const BenchOptions& options) {
  BenchPlan plan{.sizes = {},
                 .elements = {},
                 .metrics = parse_metrics(options.metric),
                 .all_metrics = options.metric == "all",
                 .levels = parse_levels(options.simd),
                 .threads = parse_list(options.threads, parse_threads),
                 .repeats = options.repeats,
                 .iterations = options.iterations,
                 .active = options.active,
                 .end_to_end = options.end_to_end};
  choose_backends(plan, options.backend);
  if (!options.combine.empty()) combine(plan, options.combine);
  if (!options.file.empty()) return plan;
  plan.sizes = parse_list(options.sizes, parse_size);
  if (options.full && std::ranges::find(plan.sizes, kFullSize) == plan.sizes.end()) plan.sizes.push_back(kFullSize);
  plan.elements = parse_elements(options.elements);
  require_partners(plan, options.elements == "all");
  require_sizes(plan);
  return plan;
}

}  // namespace dmoscope::app
