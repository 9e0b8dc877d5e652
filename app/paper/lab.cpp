#include "app/paper/lab.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope::app {
namespace {

/// The first file of that name below a folder, in the order of paths.
std::optional<std::filesystem::path> find_below(const std::filesystem::path& folder, const std::string& file) {
  namespace fs = std::filesystem;
  std::vector<fs::path> found;
  std::error_code error;
  const auto options = fs::directory_options::skip_permission_denied | fs::directory_options::follow_directory_symlink;
  for (fs::recursive_directory_iterator at(folder, options, error), end; !error && at != end; at.increment(error)) {
    if (at.depth() > 8) at.disable_recursion_pending();  // a link may lead back up
    if (at->path().filename() == file && at->is_regular_file(error)) found.push_back(at->path());
  }
  if (found.empty()) return std::nullopt;
  return *std::ranges::min_element(found);
}

}  // namespace

Lab::Lab(std::filesystem::path meshes, Extent extent, Workshop workshop)
    : meshes_(std::move(meshes)), extent_(extent), workshop_(std::move(workshop)) {
  std::error_code error;
  if (!meshes_.empty() && !std::filesystem::is_directory(meshes_, error)) throw InputError(meshes_.string(), 0, "is no folder");
}

std::shared_ptr<const InputMesh> Lab::mesh(const std::string& file, Figure& figure) {
  const auto path = meshes_.empty() ? std::nullopt : find_below(meshes_, file);
  if (path) return load_input(*path, Need::Smoothing, {workshop_.progress, workshop_.pool.get()});
  figure.lack(
      file, "all of it", Verdict::NoMesh,
      meshes_.empty() ? "No folder of meshes was named (--meshes)." : fmt::format("There is no {} below {}.", file, meshes_.string()));
  return nullptr;
}

std::shared_ptr<const InputMesh> Lab::stand_in(const std::string& words) {
  const auto made = generate_input(words, workshop_.progress);
  InputMesh named = *made;
  named.mesh.name = words + ", stand-in";
  return std::make_shared<const InputMesh>(std::move(named));
}

std::optional<JudgedRun> Lab::run(const std::shared_ptr<const InputMesh>& input, RunParameters parameters, std::uint64_t iterations,
                                  Figure& figure, std::optional<Metric> judge) {
  std::string name = parameters.method;
  if (parameters.metric != Metric::MeanRatio) name += fmt::format(", {}", info(parameters.metric).name);
  if (parameters.combination) name += ", combined";
  name += then_text(parameters);
  workshop_.progress.begin(fmt::format("figure {}: {} on {}:", figure.id, name, input->mesh.name));
  parameters.interfaces = InterfaceRule::Free;  // the paper has no interfaces
  try {
    const Metric by = judge.value_or(parameters.metric);
    return run_judged(name, input, std::move(parameters), by, {iterations}, workshop_);
  } catch (const UsageError& error) {
    figure.lack(input->mesh.name, name, Verdict::NotPossible, fmt::format("{}.", error.what()));
    return std::nullopt;
  }
}

void Lab::picture(Figure& figure, const InputMesh& input, std::span<const Vec3> positions, Metric metric, std::string caption) {
  figure.pictured_metric = info(metric).name;
  figure.pictures.emplace_back(std::move(caption), picture_of_mesh(input, positions, metric, workshop_.progress));
}

std::vector<Experiment> experiments() {
  std::vector<Experiment> all;
  for (const auto& group :
       {convergence_experiments(), speed_experiments(), metric_experiments(), density_experiments(), order_experiments()})
    all.insert(all.end(), group.begin(), group.end());
  return all;
}

std::optional<std::uint64_t> first_at_least(const JudgedRun& run, double minimum) {
  const auto reached = [&](const IterationRecord& record) { return record.statistics.minimum >= minimum; };
  const auto found = std::ranges::find_if(run.records, reached);
  if (found == run.records.end()) return std::nullopt;
  return found->iteration;
}

std::string_view name(Verdict verdict) {
  constexpr std::array<std::string_view, 5> kNames{"holds", "differs", "told", "no mesh", "not possible"};
  return kNames[static_cast<std::size_t>(verdict)];  // in the order of Verdict
}

Claim Claim::about(double value, double tolerance, std::string why) {
  return {fmt::format("{:g} ± {:g}", value, tolerance), value, value - tolerance, value + tolerance, std::move(why)};
}

std::string Claim::tolerance() const {
  if (!std::isfinite(highest)) return fmt::format("at least {:.4g}", lowest);
  if (!std::isfinite(lowest)) return fmt::format("at most {:.4g}", highest);
  return fmt::format("{:.4g} to {:.4g}", lowest, highest);
}

void Figure::check(std::string mesh, std::string what, double ours, Claim claim) {
  std::optional<double> difference;
  if (claim.value) difference = ours - *claim.value;
  const Verdict verdict = claim.holds(ours) ? Verdict::Holds : Verdict::Differs;
  findings.push_back(
      {id, std::move(mesh), std::move(what), std::move(claim.paper), ours, difference, claim.tolerance(), verdict, std::move(claim.why)});
}

void Figure::tell(std::string mesh, std::string what, double ours, std::string paper, std::string why) {
  findings.push_back({id, std::move(mesh), std::move(what), std::move(paper), ours, {}, {}, Verdict::Told, std::move(why)});
}

void Figure::lack(std::string mesh, std::string what, Verdict verdict, std::string why) {
  Finding finding{.figure = id, .mesh = std::move(mesh), .what = std::move(what), .paper = {}};
  finding.verdict = verdict;
  finding.why = std::move(why);
  findings.push_back(std::move(finding));
}

}  // namespace dmoscope::app
