#include "library/include/dmoscope/quality.h"

#include "core/base/thread_count.h"
#include "core/base/thread_pool.h"
#include "core/quality/defined_metric.h"
#include "core/quality/metric.h"
#include "core/quality/quality.h"
#include "library/mesh_data.h"
#include "library/statistics.h"
#include "library/translate.h"

namespace dmo {

Statistics statistics_of(const dmoscope::Statistics& s) {
  return {s.minimum, s.mean, s.movable_minimum, s.inverted, s.worst_element == dmoscope::kNoIndex ? 0 : s.worst_element};
}

std::vector<Metric> metrics() {
  std::vector<Metric> all;
  const auto add = [&all](const dmoscope::MetricInfo& m, std::string_view title, std::string_view formula, std::string_view doc) {
    all.push_back({std::string(m.name), std::string(title), m.lowest, m.highest, std::string(formula), std::string(doc)});
  };
  for (const dmoscope::MetricInfo& m : dmoscope::metric_table()) add(m, m.title, m.formula, m.doc);
  for (const dmoscope::NamedFormula& m : dmoscope::named_formulas()) add(info(dmoscope::parse_metric(m.name)), m.title, m.formula, m.doc);
  return all;
}

std::vector<double> quality(const Mesh& mesh, const std::string& metric, unsigned threads) {
  return translated([&] {
    dmoscope::require_thread_count(threads);
    const dmoscope::Metric parsed = dmoscope::parse_metric(metric);
    dmoscope::ThreadPool pool(threads);
    std::vector<double> values(mesh.cell_count());
    dmoscope::element_qualities(mesh.data()->judge()->quality_context(), mesh.data()->judged_positions(), parsed, &pool, values);
    return values;
  });
}

Statistics statistics(const Mesh& mesh, const std::string& metric, unsigned threads) {
  return translated([&] {
    dmoscope::require_thread_count(threads);
    const auto judge = mesh.data()->judge();
    const dmoscope::InputMesh& input = *judge;
    const dmoscope::Metric parsed = dmoscope::parse_metric(metric);
    require_defined(parsed, input);
    dmoscope::ThreadPool pool(threads);
    return statistics_of(
        dmoscope::compute_statistics(input.quality_context(), mesh.data()->judged_positions(), parsed, input.topology.boundary(), &pool));
  });
}

}  // namespace dmo
