// compare_metrics MESH: smooths a mesh by two metrics, and judges each result by both.

#include <cstdio>
#include <string>

#include <dmoscope/dmoscope.h>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "compare_metrics MESH\n");
    return 2;
  }
  const std::string metrics[] = {"mean-ratio", "min-angle"};
  const auto judge = [&](const char* name, const dmo::Mesh& mesh) {
    std::printf("%-12s", name);
    for (const std::string& metric : metrics) {
      const dmo::Statistics all = dmo::statistics(mesh, metric);
      std::printf("  %s: minimum %.4f, mean %.4f", metric.c_str(), all.minimum, all.mean);
    }
    std::printf("\n");
  };
  try {
    const dmo::Mesh mesh = dmo::Mesh::read(argv[1]);
    judge("input", mesh);
    for (const std::string& metric : metrics) {
      dmo::SmoothOptions options;
      options.metric = metric;
      options.recipe = dmo::Recipe::Best;
      judge(metric.c_str(), dmo::smooth(mesh, options).mesh);
    }
  } catch (const dmo::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
