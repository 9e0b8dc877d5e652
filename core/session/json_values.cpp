#include "core/session/json_values.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>

#include <fmt/format.h>

#include "core/base/error.h"

namespace dmoscope {

StateJson number_in_json(double value) {
  return std::isnan(value) ? StateJson("nan") : std::isinf(value) ? StateJson(value > 0 ? "inf" : "-inf") : StateJson(value);
}

double to_double(const StateJson& json) {
  if (json.is_number()) return json.get<double>();
  const auto word = json.get<std::string>();
  if (word == "inf") return std::numeric_limits<double>::infinity();
  if (word == "-inf") return -std::numeric_limits<double>::infinity();
  if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
  throw UsageError(fmt::format("'{}' is no number", word));
}

std::uint64_t to_whole(const StateJson& json) {
  if (!json.is_number_unsigned()) throw UsageError("a whole number is expected where there is none");
  return json.get<std::uint64_t>();
}

Index to_index(const StateJson& json) {
  const std::uint64_t value = to_whole(json);
  if (value >= kNoIndex) throw UsageError(fmt::format("{} is too large an index", value));
  return static_cast<Index>(value);
}

std::vector<Index> to_indices(const StateJson& json) {
  if (!json.is_array()) throw UsageError("a list of vertices is expected where there is none");
  std::vector<Index> indices;
  for (const StateJson& entry : json) indices.push_back(to_index(entry));
  return indices;
}

namespace {

constexpr std::array<std::string_view, 3> kEnds{"none", "certified", "no gain"};  // words in the order of JointState::End
constexpr double kNoLevel = std::numeric_limits<double>::infinity();

JointState::End to_end(const StateJson& json) {
  const auto found = std::ranges::find(kEnds, json.get<std::string>());
  if (found == kEnds.end()) throw UsageError("joint moves end in no such way");
  return static_cast<JointState::End>(found - kEnds.begin());
}

std::string_view word(JointState::End end) { return kEnds[static_cast<std::size_t>(end)]; }

}  // namespace

StateJson joint_json(const JointFigures& f) {
  StateJson json{word(f.end), f.certified, f.is_push, number_in_json(f.bound), number_in_json(f.gap), f.vertices, f.newton_steps};
  if (f.beyond) json.push_back(true);
  return json;
}

JointFigures to_joint_figures(const StateJson& json) {
  if (!json.is_array() || json.size() < 7 || json.size() > 8) throw UsageError("joint moves of an iteration have 7 or 8 values");
  return {to_end(json[0]),
          json[1].get<bool>(),
          json[2].get<bool>(),
          to_double(json[3]),
          to_double(json[4]),
          to_index(json[5]),
          static_cast<int>(std::min<std::uint64_t>(to_whole(json[6]), 1U << 30U)),
          json.size() == 8 && json[7].get<bool>()};
}

StateJson joint_json(const JointState& state) {
  StateJson atoms = StateJson::array(), levels = StateJson::array();
  for (auto from = state.atoms.begin(); from != state.atoms.end();) {
    const auto to = std::find_if(from, state.atoms.end(), [from](JointState::Of of) { return of != *from; });
    atoms.push_back(static_cast<unsigned>(*from));
    atoms.push_back(to - from);
    from = to;
  }
  for (std::size_t v = 0; v < state.levels.size(); ++v)
    if (state.levels[v] != kNoLevel) levels.push_back({v, number_in_json(state.levels[v])});
  StateJson json{{"atoms", atoms},
                 {"levels", levels},
                 {"clusters", state.clusters},
                 {"passes", state.passes},
                 {"untanglings", state.untanglings},
                 {"pass_began_at", number_in_json(state.pass_began_at)},
                 {"pushed", state.pushed},
                 {"mean raised", state.mean_raised},
                 {"end", word(state.end)}};
  if (state.beyond) json["beyond"] = true;
  return json;
}

JointState to_joint_state(const StateJson& json, std::size_t vertices) {
  constexpr std::size_t kMostAtoms = std::size_t{1} << 32U;
  JointState state;
  const StateJson& atoms = json.at("atoms");
  for (std::size_t i = 0; i + 1 < atoms.size(); i += 2) {
    const std::uint64_t of = to_whole(atoms.at(i)), count = to_whole(atoms.at(i + 1));
    if (of > static_cast<std::uint64_t>(JointState::Of::Closed) || count > kMostAtoms - state.atoms.size())
      throw UsageError("what joint moves know of elements is damaged");
    // Bounds the number of atoms by the most that a mesh can have: each vertex has its elements, and each element few atoms.
    if (state.atoms.size() + count > 4096 * (vertices + 1)) throw UsageError("joint moves know of more elements than there are");
    state.atoms.insert(state.atoms.end(), count, static_cast<JointState::Of>(of));
  }
  if (!state.atoms.empty()) state.levels.assign(vertices, kNoLevel);
  for (const StateJson& one : json.at("levels")) {
    const std::uint64_t vertex = to_whole(one.at(0));
    if (vertex >= state.levels.size()) throw UsageError("joint moves know of a vertex that is not there");
    state.levels[vertex] = to_double(one.at(1));
  }
  state.clusters = to_index(json.at("clusters"));
  state.passes = to_index(json.at("passes"));
  if (json.contains("mean raised")) state.mean_raised = json.at("mean raised").get<bool>();  // missing in older files
  if (json.contains("untanglings")) state.untanglings = to_index(json.at("untanglings"));    // missing in older files
  state.pass_began_at = to_double(json.at("pass_began_at"));
  state.pushed = json.at("pushed").get<bool>();
  state.beyond = json.value("beyond", false);
  state.end = to_end(json.at("end"));
  return state;
}

std::string pack_positions(std::span<const Vec3> positions) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(positions.size() * 24);
  for (const Vec3& p : positions) {
    for (const double coordinate : {p.x, p.y, p.z}) {
      const auto bits = std::bit_cast<std::uint64_t>(coordinate);
      for (unsigned k = 0; k < 8; ++k) bytes.push_back(static_cast<std::uint8_t>(bits >> 8U * k));
    }
  }
  return to_base64(bytes);
}

std::optional<std::vector<Vec3>> unpack_positions(std::string_view text, std::size_t count) {
  const auto bytes = from_base64(text);
  if (!bytes || bytes->size() != count * 24) return std::nullopt;
  const auto coordinate = [&](std::size_t i) {
    std::uint64_t bits = 0;
    for (unsigned k = 0; k < 8; ++k) bits |= static_cast<std::uint64_t>((*bytes)[8 * i + k]) << 8U * k;
    return std::bit_cast<double>(bits);
  };
  std::vector<Vec3> positions(count);
  for (std::size_t v = 0; v < count; ++v) {
    positions[v] = {coordinate(3 * v), coordinate(3 * v + 1), coordinate(3 * v + 2)};
    const Vec3& p = positions[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) return std::nullopt;
  }
  return positions;
}

}  // namespace dmoscope
