#include "core/view/judgements.h"

#include <algorithm>
#include <utility>

#include "core/quality/quality.h"
#include "core/run/percentiles.h"

namespace dmoscope {

namespace {

bool is_defined(Metric metric, const Mesh& mesh) {
  return std::ranges::all_of(mesh.elements.kinds(), [&](ElementKind kind) { return info(metric).defined_for(kind); });
}

/// Whether a point belongs to a record, which a later path through the same iteration may have replaced.
bool is_of(const JudgedPoint& point, const IterationRecord& record) {
  return point.iteration == record.iteration && point.own_minimum == record.statistics.minimum && point.own_mean == record.statistics.mean;
}

/// The points of a course that still belong to the run's path.
std::vector<JudgedPoint> still_true(const std::vector<JudgedPoint>& course, const std::vector<IterationRecord>& records) {
  std::vector<JudgedPoint> kept;
  std::ranges::copy_if(course, std::back_inserter(kept), [&](const JudgedPoint& point) {
    return point.iteration < records.size() && is_of(point, records[point.iteration]);
  });
  return kept;
}

const JudgedBy* find_metric(const std::vector<JudgedBy>* by, Metric metric) {
  if (by == nullptr) return nullptr;
  const auto at = std::ranges::find(*by, metric, &JudgedBy::metric);
  return at == by->end() ? nullptr : &*at;
}

}  // namespace

std::vector<Metric> compared_metrics(Session& session) {
  std::vector<Metric> metrics;
  if (session.run_count() < 2) return metrics;
  const auto add = [&metrics](Metric metric) {
    if (std::ranges::find(metrics, metric) == metrics.end()) metrics.push_back(metric);
  };
  add(session.shown());
  for (std::size_t i = 0; i < session.run_count(); ++i) add(session.run(i).parameters().metric);
  return metrics;
}

std::vector<std::uint64_t> judged_iterations(std::uint64_t count) {
  constexpr std::uint64_t kAll = 8;
  constexpr double kGrowth = 1.25;
  std::vector<std::uint64_t> chosen;
  for (std::uint64_t i = 0; i < std::min(count, kAll); ++i) chosen.push_back(i);
  for (double at = static_cast<double>(kAll); at < static_cast<double>(count); at *= kGrowth)
    chosen.push_back(static_cast<std::uint64_t>(at));
  if (count > kAll && chosen.back() != count - 1) chosen.push_back(count - 1);
  return chosen;
}

Judgements::Known* Judgements::known(Session& session, std::size_t run) {
  const auto at = std::ranges::find_if(known_, [&](const Known& one) { return one.at.run.lock() == session.identity(run).lock(); });
  return at == known_.end() ? nullptr : &*at;
}

std::shared_ptr<const std::vector<JudgedBy>> Judgements::of(Session& session, std::size_t run) const {
  const auto at = std::ranges::find(known_, session.standing(run), &Known::at);
  return at == known_.end() ? nullptr : at->by;
}

std::shared_ptr<const std::vector<JudgedBy>> Judgements::of_input(Session& /*session*/,
                                                                  const std::shared_ptr<const InputMesh>& input) const {
  const auto at = std::ranges::find_if(inputs_, [&](const KnownInput& one) { return one.input.lock() == input; });
  return at == inputs_.end() ? nullptr : at->by;
}

bool Judgements::find_inputs(Session& session, const std::vector<Metric>& metrics, const std::function<bool()>& go_on) {
  bool found = false;
  std::vector<KnownInput> inputs;
  ThreadPool* pool = session.pool().get();
  for (const auto& input : session.inputs()) {
    const auto before = of_input(session, input);
    std::vector<JudgedBy> by;
    bool changed = false;
    for (const Metric metric : metrics) {
      if (const JudgedBy* at = find_metric(before.get(), metric)) {
        by.push_back(*at);
      } else if (is_defined(metric, input->mesh) && go_on()) {
        const std::span<const Vec3> positions = input->mesh.positions;
        const Statistics statistics = compute_statistics(input->quality_context(), positions, metric, std::span<const Index>(), pool);
        const Percentiles percentiles = compute_percentiles(input->quality_context(), positions, metric, pool);
        by.push_back({metric, statistics.minimum, percentiles.p1, statistics.mean, {}});
        changed = true;
      }
    }
    found = found || changed;
    inputs.push_back({input, changed || !before ? std::make_shared<const std::vector<JudgedBy>>(std::move(by)) : before});
  }
  inputs_ = std::move(inputs);
  return found;
}

bool Judgements::find(Session& session, const std::function<bool()>& go_on) {
  const std::vector<Metric> metrics = compared_metrics(session);
  bool found = find_inputs(session, metrics, go_on);
  std::vector<Known> all;
  ThreadPool* pool = session.pool().get();
  for (std::size_t i = 0; !metrics.empty() && i < session.run_count(); ++i) {
    Run& run = session.run(i);
    const Known* before = known(session, i);
    const bool stands = before != nullptr && before->at == session.standing(i);
    std::vector<JudgedBy> by;
    bool changed = !stands;
    for (const Metric metric : metrics) {
      const JudgedBy* at = before == nullptr ? nullptr : find_metric(before->by.get(), metric);
      if (at != nullptr && stands) {
        by.push_back(*at);
        continue;
      }
      changed = true;
      if (!is_defined(metric, run.input().mesh) || !go_on()) continue;
      const QualityContext context = run.input().quality_context();
      const auto positions = run.positions();
      const Statistics statistics = compute_statistics(context, positions, metric, run.immovable(), pool);
      by.push_back({metric, statistics.minimum, compute_percentiles(context, positions, metric, pool).p1, statistics.mean,
                    at == nullptr ? std::vector<JudgedPoint>{} : still_true(at->course, run.history().records())});
    }
    found = found || changed;
    all.push_back({session.standing(i), changed ? std::make_shared<const std::vector<JudgedBy>>(std::move(by)) : before->by});
  }
  known_ = std::move(all);
  return found;
}

bool Judgements::judge_course(Session& session, std::size_t index, JudgedBy& by, const std::function<bool()>& go_on) const {
  Run& run = session.run(index);
  const std::vector<IterationRecord>& records = run.history().records();
  const bool own = by.metric == run.parameters().metric;
  bool found = false;
  std::vector<JudgedPoint> course;
  for (const std::uint64_t iteration : judged_iterations(own ? 0 : records.size())) {
    const IterationRecord& record = records[iteration];
    const auto before = std::ranges::find(by.course, iteration, &JudgedPoint::iteration);
    if (before != by.course.end()) {
      course.push_back(*before);
      continue;
    }
    const bool here = run.moment() == Moment{iteration};
    if ((!here && !run.history().kept(iteration)) || !go_on()) continue;
    const auto positions = here ? run.positions() : run.history().nearest(iteration).positions;
    const Statistics statistics =
        compute_statistics(run.input().quality_context(), positions, by.metric, run.immovable(), session.pool().get());
    course.push_back({iteration, statistics.minimum, statistics.mean, record.statistics.minimum, record.statistics.mean});
    found = true;
  }
  by.course = std::move(course);
  return found;
}

bool Judgements::find_courses(Session& session, const std::function<bool()>& go_on) {
  bool found = false;
  for (std::size_t i = 0; i < session.run_count(); ++i) {
    Known* one = known(session, i);
    if (one == nullptr || !(one->at == session.standing(i))) continue;
    std::vector<JudgedBy> by = *one->by;
    bool changed = false;
    for (JudgedBy& metric : by) changed = judge_course(session, i, metric, go_on) || changed;
    if (changed) one->by = std::make_shared<const std::vector<JudgedBy>>(std::move(by));
    found = found || changed;
  }
  return found;
}

}  // namespace dmoscope
