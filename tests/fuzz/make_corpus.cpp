// Writes the samples of every format to FOLDER/<format>/, from which the fuzzers start.

#include <cstdio>
#include <exception>
#include <filesystem>

#include "core/io/writing/atomic_file.h"
#include "core/quality/defined_metric.h"
#include "tests/fuzz/check_session.h"
#include "tests/fuzz/samples.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: make_corpus FOLDER\n", stderr);
    return 2;
  }
  try {
    std::vector<dmoscope::testing::Sample> samples = dmoscope::testing::samples();
    for (const bool joined : {false, true}) samples.push_back({joined ? "joined" : "named", "gzip", dmoscope::testing::gzip_off(joined)});
    samples.push_back({"saved", "session", dmoscope::testing::sample_session()});
    samples.push_back({"verbs", "script", std::string(dmoscope::testing::kSampleScript)});
    for (const dmoscope::MetricInfo& metric : dmoscope::metric_table())
      samples.push_back({std::string(metric.name), "formula", std::string(dmoscope::formula_of(metric.metric))});
    samples.push_back({"all", "formula",
                       "\"T\"; a = l12/lmax; b = if(a < 1 && !(a == 0) || a >= 2, atan2(a, 1), exp(-a)^2) # c\n"
                       "triangle_ = min_corner(dot(u, v)/norm^2); max(b, triangle_, field(\"f\"), x(p2 - p1)/length(p3 - p1))"});
    for (const char* target : {"layers:input:2:5%+wing:aspect:4:30+field:m", "aspect:2:0:0:1", "input:3"})
      samples.push_back({std::string("target-") + target[0], "formula", target});
    for (const dmoscope::testing::Sample& sample : samples) {
      if (sample.bytes.starts_with("\x89HDF")) continue;  // damage in their structure is left to the library's tests
      const auto folder = std::filesystem::path(argv[1]) / sample.format;
      std::filesystem::create_directories(folder);
      dmoscope::write_file_atomically(folder / sample.name, sample.bytes);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 3;
  }
  return 0;
}
