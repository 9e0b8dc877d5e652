// smooth_file IN OUT: smooths a mesh until its minimum no longer rises, and says how that goes.

#include <cstdio>

#include <dmoscope/dmoscope.h>

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "smooth_file IN OUT\n");
    return 2;
  }
  try {
    const dmo::Mesh mesh = dmo::Mesh::read(argv[1]);
    dmo::SmoothOptions options;
    options.until_converged = true;
    options.metric = "mean-ratio";
    options.after_iteration = [](const dmo::Iteration& at) {
      std::printf("iteration %llu: minimum %.4f\n", static_cast<unsigned long long>(at.number), at.statistics.minimum);
      return true;  // false would end here
    };
    const dmo::Smoothed result = dmo::smooth(mesh, options);
    std::printf("%s\n", result.sentence.c_str());
    result.mesh.write(argv[2]);
  } catch (const dmo::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
}
