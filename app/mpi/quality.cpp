// mpirun -n N dmoscope quality: the verb quality by many processes.

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/option_checks.h"
#include "app/common/quality_report.h"
#include "app/mpi/verbs.h"
#include "core/base/error.h"
#include "core/base/thread_pool.h"
#include "mpi/smooth/shared_mesh.h"
#include "mpi/smooth/shared_statistics.h"

namespace dmoscope::app {
namespace {

struct SharedQualityOptions {
  std::filesystem::path input;
  std::string metric = "all", partition = "hilbert";
  std::uint64_t worst = 0;
  unsigned threads = 0;
  bool json = false;
};

/// One metric over the elements that this rank counts.
class SharedColumn {
 public:
  SharedColumn(const SharedMesh& mesh, Metric metric, ThreadPool& pool)
      : mesh_(mesh), metric_(metric), values_(mesh.input->mesh.elements.size()) {
    element_qualities(mesh.input->quality_context(), mesh.input->mesh.positions, metric, &pool, values_);
    for (Index e = 0; e < values_.size(); ++e)
      if (mesh.share->share().home[e] != 0 && !std::isnan(values_[e])) ascending_.push_back(e);
    std::stable_sort(ascending_.begin(), ascending_.end(), [this](Index a, Index b) { return values_[a] < values_[b]; });
  }

  /// Computes the summary, all ranks together; `worst` elements on rank 0.
  [[nodiscard]] MetricSummary summary(std::uint64_t worst) const {
    const World& world = mesh_.share->world();
    const SharedStatistics::Sum sum = mesh_.share->sums().sum(values_);
    MetricSummary summary{.metric = metric_, .elements = sum.count};
    if (sum.count == 0) return summary;
    std::vector<double> sorted;
    std::uint64_t unacceptable = 0;
    for (const Index e : ascending_) {
      sorted.push_back(values_[e]);
      unacceptable += values_[e] < info(metric_).acceptable ? 1U : 0U;
    }
    std::vector<std::uint64_t> ranks;
    for (const double percent : {0.0, 1.0, 5.0, 50.0}) {  // nearest rank
      const auto rank = static_cast<std::uint64_t>(std::ceil(percent / 100.0 * static_cast<double>(sum.count)));
      ranks.push_back(std::max<std::uint64_t>(rank, 1) - 1);
    }
    const std::vector<double> found = values_of_ranks(world, sorted, ranks);
    summary.minimum = found[0];
    summary.percentile_1 = found[1];
    summary.percentile_5 = found[2];
    summary.percentile_50 = found[3];
    summary.mean = sum.sum / static_cast<double>(sum.count);
    summary.unacceptable = world.sum(unacceptable);
    summary.worst = worst_of_all(worst);
    return summary;
  }

 private:
  [[nodiscard]] std::vector<MetricSummary::Worst> worst_of_all(std::uint64_t count) const {
    const Mesh& mesh = mesh_.input->mesh;
    std::vector<MetricSummary::Worst> here;
    for (std::size_t i = 0; i < ascending_.size() && i < count; ++i) {
      const Index e = ascending_[i];
      const auto corners = mesh.elements.corners(e);
      Vec3 sum;
      for (const Index corner : corners) sum = sum + mesh.positions[corner];
      here.push_back(
          {mesh_.share->share().elements[e], mesh.elements.kind(e), values_[e], (1.0 / static_cast<double>(corners.size())) * sum});
    }
    std::vector<MetricSummary::Worst> all = mesh_.share->world().gather(here);
    std::ranges::sort(
        all, [](const auto& a, const auto& b) { return a.quality < b.quality || (a.quality == b.quality && a.element < b.element); });
    all.resize(std::min<std::size_t>(all.size(), count));
    return all;
  }

  const SharedMesh& mesh_;
  Metric metric_;
  std::vector<double> values_;    // values of all elements of the share
  std::vector<Index> ascending_;  // elements that are counted here
};

int quality(const World& world, const SharedQualityOptions& options) {
  std::vector<Metric> metrics;
  if (options.metric != "all") metrics = {parse_metric(options.metric)};
  if (!metrics.empty() && !is_built_in(metrics.front()))
    throw UsageError(fmt::format("{}: formulas and targets are of one process alone", options.metric));
  for (const MetricInfo& one : metric_table())
    if (options.metric == "all") metrics.push_back(one.metric);
  const auto file = open_shared(world, options.input);
  const SharedMesh mesh =
      load_shared(world, *file, options.input, parse_partition(options.partition), SharedVertexWords({}), Need::QualityOnly);
  const std::string& name = mesh.input->mesh.name;
  const std::vector<std::string> warnings = mesh.findings.sentences();
  if (world.is_first())
    for (const std::string& sentence : warnings) complain(fmt::format("{}: {}", name, sentence));
  ThreadPool pool(threads_of_rank(world, options.threads));
  std::vector<MetricSummary> summaries;
  for (const Metric metric : metrics) summaries.push_back(SharedColumn(mesh, metric, pool).summary(options.worst));
  if (options.metric != "all" && summaries.front().elements == 0)
    throw UsageError(fmt::format("{} is defined for no element of {}", options.metric, name));
  const InvertedCount inverted = count_inverted(mesh.input->quality_context(), mesh.input->mesh.positions, *mesh.share);
  if (!world.is_first()) return 0;
  if (options.json) {
    Json list = Json::array();
    for (const MetricSummary& summary : summaries) list.push_back(json_of(summary, options.worst > 0));
    print_json({{"input", options.input.string()},
                {"ranks", world.size()},
                {"vertices", mesh.share->vertex_count()},
                {"elements", mesh.share->element_count()},
                {"inverted", inverted.all},
                {"inverted_inside_alone", inverted.inside_alone},
                {"inverted_elements", json_of_inverted(inverted)},
                {"metrics", std::move(list)},
                {"warnings", warnings}});
    return 0;
  }
  print_counts(name, mesh.share->vertex_count(), mesh.share->element_count(), inverted);
  print_summaries(summaries, mesh.input->geometry);
  return 0;
}

}  // namespace

void add_shared_quality(CLI::App& app, SharedAction& action) {
  auto options = std::make_shared<SharedQualityOptions>();
  CLI::App* subcommand = app.add_subcommand("quality", "Judge the elements of a mesh");
  subcommand->add_option("FILE", options->input, "Mesh to read: .vtu (raw appended data), .pvtu, .obj, .off, .14 or .grd")->required();
  subcommand->add_option("--metric", options->metric, "all, or one of " + names_of(metric_table()))
      ->type_name("NAME|all")
      ->capture_default_str();
  subcommand->add_option("--worst", options->worst, "List the N worst elements of each metric")
      ->transform(whole_number(0, kNoIndex))
      ->type_name("N");
  subcommand->add_option("--partition", options->partition, "Which rank has which vertices, see smooth")
      ->type_name("NAME")
      ->capture_default_str();
  subcommand->add_option("--threads", options->threads, "Threads of each rank; 0: the processor's, shared among its ranks")
      ->transform(whole_number(0, 1024))
      ->type_name("N")
      ->capture_default_str();
  subcommand->add_flag("--json", options->json, "Print one JSON object and nothing else on standard output");
  subcommand->callback([options, &action] { action = [options](const World& world) { return quality(world, *options); }; });
}

}  // namespace dmoscope::app
