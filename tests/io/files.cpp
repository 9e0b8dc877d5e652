#include "tests/io/files.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/base/same_bits.h"
#include "core/io/mesh_io.h"

namespace dmoscope::test {

void put(const std::filesystem::path& path, std::string_view bytes) {
  std::ofstream(path, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

std::string get(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

Mesh read_bytes(std::string_view name, std::string_view bytes) {
  const TemporaryFolder folder;
  put(folder / name, bytes);
  Progress progress;
  return read_mesh(folder / name, progress);
}

std::string written(std::string_view name, const Mesh& mesh, std::span<const Vec3> positions, std::vector<std::string>* notes) {
  const TemporaryFolder folder;
  Progress progress;
  auto said = write_mesh(folder / name, mesh, positions, progress);
  if (notes != nullptr) *notes = std::move(said);
  const auto files = std::distance(std::filesystem::directory_iterator(folder.path()), std::filesystem::directory_iterator());
  EXPECT_EQ(files, 1) << "a temporary file was left";
  return get(folder / name);
}

void expect_refused(std::string_view name, std::string_view bytes, std::size_t line, std::string_view words) {
  try {
    (void)read_bytes(name, bytes);
    ADD_FAILURE() << "read, but should be refused for: " << words << "\n" << bytes;
  } catch (const InputError& error) {
    EXPECT_EQ(error.line(), line) << error.what() << "\n" << bytes;
    EXPECT_NE(std::string_view(error.what()).find(words), std::string_view::npos) << error.what() << "\nwanted: " << words;
  }
}

void expect_consistent(const Mesh& mesh) {
  for (const Index c : mesh.elements.all_corners()) ASSERT_LT(c, mesh.positions.size());
  for (const Group& group : mesh.groups) {
    for (const Index v : group.vertices()) ASSERT_LT(v, mesh.positions.size());
    const std::size_t limit = group.dimension == 2 ? mesh.elements.size() : mesh.positions.size();
    for (const Index m : group.members) ASSERT_LT(m, limit);
    if (group.dimension == 1) {
      ASSERT_EQ(group.members.size() % 2, 0U);
    }
  }
  for (const Field& field : mesh.fields) {
    const std::size_t things = field.on == Field::On::Vertices ? mesh.positions.size() : mesh.elements.size();
    ASSERT_EQ(field.values.size(), things * static_cast<std::size_t>(field.components));
  }
  for (const Vec3& p : mesh.positions) ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
}

void expect_truncation_safe(std::string_view name, std::string_view bytes) {
  const TemporaryFolder folder;
  Progress progress;
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    put(folder / name, bytes.substr(0, size));
    try {
      const Mesh mesh = read_mesh(folder / name, progress);
      expect_consistent(mesh);
    } catch (const InputError&) {
    }
  }
}

void expect_same_positions(std::span<const Vec3> expected, std::span<const Vec3> found) {
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t v = 0; v < expected.size(); ++v) {
    ASSERT_TRUE(same_bits(expected[v], found[v])) << "vertex " << v << ": " << found[v].x << " " << found[v].y << " " << found[v].z;
  }
}

void expect_same_elements(const Mesh& expected, const Mesh& found) {
  ASSERT_TRUE(std::ranges::equal(expected.elements.kinds(), found.elements.kinds()));
  ASSERT_TRUE(std::ranges::equal(expected.elements.all_corners(), found.elements.all_corners()));
}

std::vector<Vec3> moved(const Mesh& mesh, std::size_t every, bool three, std::uint64_t seed) {
  constexpr double kSpecial[] = {
      -0.0,      1e300,       -1e-300, std::numeric_limits<double>::denorm_min(), 0.1,
      1.0 / 3.0, 123456789.0, 1e22,    std::numeric_limits<double>::max(),        -std::numeric_limits<double>::min()};
  std::mt19937_64 random(seed);
  const auto next = [&] {
    if (random() % 4 == 0) return kSpecial[random() % std::size(kSpecial)];
    double value = 0.0;
    do {
      value = std::bit_cast<double>(static_cast<std::uint64_t>(random()));
    } while (!std::isfinite(value));
    return value;
  };
  std::vector<Vec3> positions = mesh.positions;
  for (std::size_t v = 0; v < positions.size(); v += every) {
    positions[v].x = next();
    if (v % 2 == 0) positions[v].y = next();
    if (three) positions[v].z = next();
  }
  return positions;
}

namespace {

/// Splits a text into words and the blanks between them, in turn.
std::vector<std::string_view> pieces(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r\n,";
  std::vector<std::string_view> result;
  bool blank = true;
  while (!text.empty()) {
    const std::size_t end = std::min(text.size(), blank ? text.find_first_not_of(kBlanks) : text.find_first_of(kBlanks));
    result.push_back(text.substr(0, end));
    text.remove_prefix(end);
    blank = !blank;
  }
  return result;
}

std::size_t changed_coordinates(std::span<const Vec3> a, std::span<const Vec3> b) {
  const auto differ = [](double x, double y) { return std::size_t{std::bit_cast<std::uint64_t>(x) != std::bit_cast<std::uint64_t>(y)}; };
  std::size_t count = 0;
  for (std::size_t v = 0; v < a.size(); ++v) count += differ(a[v].x, b[v].x) + differ(a[v].y, b[v].y) + differ(a[v].z, b[v].z);
  return count;
}

}  // namespace

void expect_patched(std::string_view name, std::string_view bytes, bool three) {
  const Mesh mesh = read_bytes(name, bytes);
  expect_consistent(mesh);
  std::vector<std::string> notes;
  EXPECT_EQ(written(name, mesh, mesh.positions, &notes), bytes);
  EXPECT_TRUE(notes.empty()) << notes.front();

  const std::vector<Vec3> positions = moved(mesh, 3, three, bytes.size());
  const std::string patched = written(name, mesh, positions, &notes);
  EXPECT_TRUE(notes.empty()) << notes.front();
  const Mesh again = read_bytes(name, patched);
  expect_same_positions(positions, again.positions);
  expect_same_elements(mesh, again);

  const auto before = pieces(bytes);
  const auto after = pieces(patched);
  ASSERT_EQ(before.size(), after.size());
  std::size_t differ = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i] == after[i]) continue;
    ++differ;
    ASSERT_EQ(i % 2, 1U) << "blanks were changed";
  }
  EXPECT_EQ(differ, changed_coordinates(mesh.positions, positions));
}

std::vector<std::filesystem::path> shared_meshes(std::string_view extension) {
  std::vector<std::filesystem::path> result;
  const std::filesystem::path root = std::filesystem::path(DMOSCOPE_SHARED_DIR) / "meshes";
  if (!std::filesystem::exists(root)) return result;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root)) {
    if (entry.is_regular_file() && entry.path().extension() == extension) result.push_back(entry.path());
  }
  std::sort(result.begin(), result.end());
  return result;
}

}  // namespace dmoscope::test
