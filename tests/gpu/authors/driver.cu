// driver MESH.off [ITERATIONS [REPEATS]]: times the paper's authors' own kernel (mean ratio of triangles) on a mesh, launches included,
// copies excluded. Their source is included from a folder of its own (authors.sh); this only fills their structures and holds the watch.
// ITERATIONS 0: tells about the mesh and needs no GPU.

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

// Their source relies on other headers for this one.
#include <thrust/pair.h>

#include "DMO/dmoKernel.cu"

namespace {

using DMO::gpuAssert;  // used by their macro gpuErrchk

struct Triangles {
  std::vector<double> x, y;
  std::vector<int> corners;  // three a triangle
};

Triangles read_off(const std::string& name) {
  std::ifstream file(name);
  std::string line;
  std::size_t vertices = 0, faces = 0;
  if (!std::getline(file, line) || line != "OFF") throw std::runtime_error(name + ": not an OFF file");
  while (std::getline(file, line) && (line.empty() || line[0] == '#')) {
  }
  if (!(std::istringstream(line) >> vertices >> faces)) throw std::runtime_error(name + ": no counts");
  Triangles mesh;
  mesh.x.resize(vertices);
  mesh.y.resize(vertices);
  double z = 0;
  for (std::size_t v = 0; v < vertices; ++v) file >> mesh.x[v] >> mesh.y[v] >> z;
  for (std::size_t f = 0; f < faces; ++f) {
    int n = 0, a = 0, b = 0, c = 0;
    if (!(file >> n >> a >> b >> c) || n != 3) throw std::runtime_error(name + ": cut off, or not all triangles");
    mesh.corners.insert(mesh.corners.end(), {a, b, c});
  }
  return mesh;
}

double quality(const Triangles& m, int a, int b, int c) {
  const double ux = m.x[b] - m.x[a], uy = m.y[b] - m.y[a], vx = m.x[c] - m.x[a], vy = m.y[c] - m.y[a];
  const double wx = vx - ux, wy = vy - uy;
  return 2 * std::sqrt(3.0) * (ux * vy - uy * vx) / (ux * ux + uy * uy + vx * vx + vy * vy + wx * wx + wy * wy);
}

double worst(const Triangles& m) {
  double least = 1;
  for (std::size_t i = 0; i < m.corners.size(); i += 3)
    least = std::min(least, quality(m, m.corners[i], m.corners[i + 1], m.corners[i + 2]));
  return least;
}

/// The edges opposite to every vertex, one per triangle, as pairs from first[v] on.
struct Stars {
  std::vector<std::size_t> first;
  std::vector<std::pair<int, int>> opposite;
};

Stars stars_of(const Triangles& m) {
  Stars stars;
  stars.first.assign(m.x.size() + 1, 0);
  for (const int v : m.corners) ++stars.first[static_cast<std::size_t>(v) + 1];
  for (std::size_t v = 0; v < m.x.size(); ++v) stars.first[v + 1] += stars.first[v];
  stars.opposite.resize(m.corners.size());
  std::vector<std::size_t> next(stars.first.begin(), stars.first.end() - 1);
  for (std::size_t i = 0; i < m.corners.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) stars.opposite[next[m.corners[i + k]]++] = {m.corners[i + (k + 1) % 3], m.corners[i + (k + 2) % 3]};
  }
  return stars;
}

/// The neighbours of v in order, the first one again at the end; empty for a vertex of the boundary.
std::vector<int> ring_of(const Stars& stars, std::size_t v) {
  std::vector<int> ring;
  const auto first = stars.opposite.begin() + static_cast<std::ptrdiff_t>(stars.first[v]);
  const auto last = stars.opposite.begin() + static_cast<std::ptrdiff_t>(stars.first[v + 1]);
  if (first == last) return ring;
  ring.push_back(first->first);
  for (auto edge = first; ring.size() <= static_cast<std::size_t>(last - first);) {
    ring.push_back(edge->second);
    if (edge->second == ring.front()) break;
    edge = std::find_if(first, last, [&ring](const auto& e) { return e.first == ring.back(); });
    if (edge == last) return {};
  }
  return ring.size() == static_cast<std::size_t>(last - first) + 1 && ring.back() == ring.front() ? ring : std::vector<int>();
}

/// Fills their structures: rings of the free vertices, and the greedy colours of their createColoring().
DMO::DmoMesh<true> prepared(const Triangles& mesh) {
  const Stars stars = stars_of(mesh);
  DMO::DmoMesh<true> theirs;
  std::vector<int> colour(mesh.x.size(), -2);
  std::vector<std::vector<int>> classes;
  for (std::size_t v = 0; v < mesh.x.size(); ++v) {
    const std::vector<int> ring = ring_of(stars, v);
    if (ring.empty()) continue;
    if (ring.size() >= DMO::MAX_ONE_RING_SIZE) throw std::runtime_error("a vertex has more neighbours than their kernel takes");
    unsigned long taken = 0;
    for (const int neighbour : ring) {
      if (colour[neighbour] >= 0) taken |= 1UL << colour[neighbour];
    }
    int own = 0;
    while ((taken >> own & 1UL) != 0) ++own;
    colour[v] = own;
    if (static_cast<std::size_t>(own) >= classes.size()) classes.resize(own + 1);
    classes[own].push_back(static_cast<int>(theirs.vertices.h().size()));
    theirs.vertices.h().push_back({static_cast<int>(theirs.oneRingVec.h().size()), static_cast<int>(ring.size()), static_cast<int>(v)});
    theirs.oneRingVec.h().insert(theirs.oneRingVec.h().end(), ring.begin(), ring.end());
  }
  theirs.colorOffset_ = {0};
  for (const auto& members : classes) {
    theirs.coloredVertexIDs.h().insert(theirs.coloredVertexIDs.h().end(), members.begin(), members.end());
    theirs.colorOffset_.push_back(static_cast<int>(theirs.coloredVertexIDs.h().size()));
  }
  return theirs;
}

DMO::DmoVector<float2> points_of(const Triangles& mesh) {
  DMO::DmoVector<float2> points;
  for (std::size_t v = 0; v < mesh.x.size(); ++v) points.h().push_back({static_cast<float>(mesh.x[v]), static_cast<float>(mesh.y[v])});
  return points;
}

/// Returns the milliseconds of `iterations` of their kernel from the input on; `points` keeps the result, on the device.
float timed(DMO::DmoVector<float2>& points, DMO::DmoMesh<true>& theirs, int iterations) {
  points.copyHostToDevice();
  cudaEvent_t begin{}, end{};
  gpuErrchk(cudaEventCreate(&begin));
  gpuErrchk(cudaEventCreate(&end));
  gpuErrchk(cudaDeviceSynchronize());
  gpuErrchk(cudaEventRecord(begin));
  for (int i = 0; i < iterations; ++i) DMO::detail::dmoGPU(points.d().data().get(), theirs, DMO::Metrics::Tri::MeanRatio());
  gpuErrchk(cudaEventRecord(end));
  gpuErrchk(cudaEventSynchronize(end));
  gpuErrchk(cudaGetLastError());
  float ms = 0;
  gpuErrchk(cudaEventElapsedTime(&ms, begin, end));
  gpuErrchk(cudaEventDestroy(begin));
  gpuErrchk(cudaEventDestroy(end));
  return ms;
}

void run(const std::string& name, int iterations, int repeats) {
  Triangles mesh = read_off(name);
  DMO::DmoMesh<true> theirs = prepared(mesh);
  const std::size_t free = theirs.vertices.h().size();
  std::printf("%zu vertices, %zu free, %zu colours, worst quality %.6f\n", mesh.x.size(), free, theirs.colorOffset_.size() - 1,
              worst(mesh));
  if (iterations == 0) return;
  theirs.copyHostToDevice();
  DMO::DmoVector<float2> points = points_of(mesh);
  timed(points, theirs, 1);  // the first launch loads the code
  std::vector<float> ms;
  for (int r = 0; r < repeats; ++r) ms.push_back(timed(points, theirs, iterations));
  std::sort(ms.begin(), ms.end());
  points.copyDeviceToHost();
  for (std::size_t v = 0; v < mesh.x.size(); ++v) {
    mesh.x[v] = points.h()[v].x;
    mesh.y[v] = points.h()[v].y;
  }
  const float median = ms[ms.size() / 2];
  std::printf("authors' kernel: %d iterations in %.3f ms (median of %d, %.3f to %.3f), %.1f Mv/s, worst quality then %.6f\n", iterations,
              median, repeats, ms.front(), ms.back(), 1e-3 * static_cast<double>(free) * iterations / median, worst(mesh));
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc < 2) throw std::runtime_error("usage: driver MESH.off [ITERATIONS [REPEATS]]");
    run(argv[1], argc > 2 ? std::atoi(argv[2]) : 4, argc > 3 ? std::atoi(argv[3]) : 5);
    return 0;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "driver: %s\n", error.what());
    return 1;
  }
}
