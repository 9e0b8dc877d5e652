#include "core/session/state_file.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <optional>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/base/fnv1a.h"
#include "core/base/unknown_value.h"
#include "core/io/mesh_io.h"
#include "core/io/reading/source_file.h"
#include "core/io/writing/atomic_file.h"
#include "core/session/json_values.h"
#include "core/session/saved_inputs.h"
#include "core/session/session.h"

namespace dmoscope {

namespace {

using Json = StateJson;

constexpr std::string_view kSessionFormat = "dmoscope session";
constexpr int kVersion = 4;  // 1: without checksums but that of the mesh; 4: runs that begin elsewhere than at the input
constexpr int kVersionOfSeveralMeshes = 3;
constexpr int kVersionOfOneMesh = 2;

/// The lowest version that can express the session, so that older programs can read it if possible.
int version_for(const SessionStanding& session) {
  const auto elsewhere = [](const RunStanding& run) { return run.begin != nullptr; };
  if (std::ranges::any_of(session.runs, elsewhere)) return kVersion;
  return session.meshes.size() > 1 ? kVersionOfSeveralMeshes : kVersionOfOneMesh;
}

/// One checksum for each part of an object, to tell which part is damaged, taken from the part's compact JSON, so that the file's layout
/// does not matter.
Json checksums_of(const Json& object) {
  Json sums = Json::object();
  for (const auto& [key, part] : object.items()) {
    if (key == "checksums" || key == "runs") continue;  // runs have checksums of their own
    Fnv1a hash;
    if (part.is_string()) {
      hash.add_bytes(part.get_ref<const std::string&>());
    } else {
      hash.add_bytes(part.dump(-1, ' ', false, Json::error_handler_t::replace));
    }
    sums[key] = hash.text();
  }
  return sums;
}

/// Throws UsageError if a part of an object is damaged, missing, or extra. `what`: "run 2", or empty for the session itself. A damaged view
/// does not throw, since its owner judges it: returns whether it is undamaged.
bool check_parts(const Json& object, const std::string& what) {
  if (!object.contains("checksums"))
    throw UsageError(fmt::format("{} is damaged: it has no checksums", what.empty() ? "the session" : what));
  const Json found = checksums_of(object);
  const Json& saved = object.at("checksums");
  const std::string of = what.empty() ? std::string("the session is damaged: its") : fmt::format("{} is damaged: its", what);
  bool view_as_saved = true;
  for (const auto& [key, sum] : found.items()) {
    if (saved.contains(key) && saved.at(key) == sum) continue;
    if (key != "view") throw UsageError(fmt::format("{} {} {} not what was saved", of, key, key.ends_with('s') ? "are" : "is"));
    view_as_saved = false;
  }
  for (const auto& [key, sum] : saved.items())
    if (!found.contains(key)) throw UsageError(fmt::format("{} {} {} missing", of, key, key.ends_with('s') ? "are" : "is"));
  return view_as_saved;
}

Json json_of(const Moment& moment) { return {moment.iteration, moment.visits, moment.edits}; }

Moment to_moment(const Json& json) {
  if (!json.is_array() || json.size() != 3) throw UsageError("a moment is a list of iteration, visits and edits");
  return {to_whole(json[0]), to_whole(json[1]), to_whole(json[2])};
}

Json json_of(const PhaseBegin& phase) {
  Json json{{"patience", phase.patience}, {"rise", phase.rise}};
  if (phase.from_best) json["from_best"] = true;  // older files do not have it
  return json;
}

std::optional<PhaseBegin> to_phase(const Json& json, const char* key) {
  if (!json.contains(key)) return std::nullopt;
  const Json& phase = json.at(key);
  const PhaseBegin read{to_whole(phase.at("patience")), to_double(phase.at("rise")), phase.value("from_best", false)};
  if (read.patience == 0) throw UsageError("a second phase needs a patience of at least 1");
  return read;
}

Json json_of(const Kinds& kinds) {
  return {{"corners", kinds.corners}, {"no_corners", kinds.no_corners}, {"features", kinds.features}, {"no_features", kinds.no_features}};
}

std::vector<EdgeEnds> to_edges(const Json& json) {
  if (!json.is_array()) throw UsageError("edges are a list of pairs of vertices");
  std::vector<EdgeEnds> edges;
  for (const Json& edge : json) {
    const std::vector<Index> ends = to_indices(edge);
    if (ends.size() != 2) throw UsageError("an edge is a pair of vertices");
    edges.push_back({ends[0], ends[1]});
  }
  return edges;
}

Kinds to_kinds(const Json& json) {
  Kinds kinds;
  say_corners(kinds, to_indices(json.at("corners")), Saying::Is);
  say_corners(kinds, to_indices(json.at("no_corners")), Saying::IsNot);
  say_features(kinds, to_edges(json.at("features")), Saying::Is);
  say_features(kinds, to_edges(json.at("no_features")), Saying::IsNot);
  return kinds;
}

Json json_of(const RunParameters& p) {
  Json json{{"method", p.method}, {"metric", info(p.metric).name}, {"fixed", p.fixed}};
  for (const ParameterInfo& row : parameter_table())
    if (row.in_session) json[std::string(row.name)] = parameter_json(row, p);
  if (p.combination) json["combination"] = to_text(p.metric, *p.combination);
  if (p.combination && !p.combination->size_text().empty()) json["size_function"] = p.combination->size_text();
  if (!p.kinds.empty()) json["kinds"] = json_of(p.kinds);  // older files do not have it
  if (p.then_joint) json["then_joint"] = json_of(*p.then_joint);
  if (p.then_mean) {
    json["then_mean"] = json_of(*p.then_mean);
    if (p.mean != MeanKind::Arithmetic) json["then_mean"]["raises"] = name(p.mean);
  }
  return json;
}

RunParameters to_parameters(const Json& json) {
  RunParameters p;
  p.method = json.at("method").get<std::string>();
  p.metric = parse_metric(json.at("metric").get<std::string>());
  p.fixed = to_indices(json.at("fixed"));
  for (const ParameterInfo& row : parameter_table()) {
    if (!row.in_session) continue;
    const std::string key(row.name);
    if (!row.before.empty() && !json.contains(key)) {
      row.from_text(p, std::string(row.before));
    } else {
      const Json& value = json.at(key);
      const bool wants_number = row.kind == ParameterKind::Whole || row.kind == ParameterKind::Real;
      if (wants_number ? !value.is_number() : !value.is_string())
        throw UsageError(fmt::format("the parameter {} is expected as a {}", key, wants_number ? "number" : "word"));
      row.from_text(p, wants_number ? value.dump() : value.get<std::string>());
    }
  }
  if (json.contains("combination"))
    std::tie(p.metric, p.combination) = parse_composite(json.at("combination").get<std::string>(), json.value("size_function", ""));
  if (json.contains("kinds")) p.kinds = to_kinds(json.at("kinds"));
  p.then_joint = to_phase(json, "then_joint");
  p.then_mean = to_phase(json, "then_mean");
  // Defaults to the arithmetic mean, which older files raise.
  if (p.then_mean)
    p.mean = parse_choice<MeanKind>("mean", json.at("then_mean").value("raises", std::string(name(MeanKind::Arithmetic))), kMeanNames);
  return p;
}

/// Record of an iteration as an array: [minimum, mean, movable minimum, ceiling, worst element, inverted, moved, seconds]; after joint
/// moves the array of joint_json(); the second metric's movable minimum, if known; true in the phase that raises a mean; {} if vertices
/// around the worst element move together next.
Json json_of(const IterationRecord& r) {
  const Statistics& s = r.statistics;
  Json json{number_in_json(s.minimum),
            number_in_json(s.mean),
            number_in_json(s.movable_minimum),
            number_in_json(s.ceiling),
            s.worst_element,
            s.inverted,
            r.moved,
            number_in_json(r.seconds)};
  if (r.joint) json.push_back(joint_json(*r.joint));
  if (r.second) json.push_back(number_in_json(*r.second));
  if (r.raises_mean) json.push_back(true);
  if (r.raise_follows) json.push_back(Json::object());
  return json;
}

IterationRecord to_record(const Json& json, std::uint64_t iteration) {
  if (!json.is_array() || json.size() < 8 || json.size() > 12) throw UsageError("a record of an iteration has 8 to 12 values");
  IterationRecord record{iteration, {}, to_whole(json[6]), to_double(json[7])};
  record.statistics = {to_double(json[0]), to_double(json[1]), to_double(json[2]), to_double(json[3]), kNoIndex, to_index(json[5])};
  if (to_whole(json[4]) != kNoIndex) record.statistics.worst_element = to_index(json[4]);
  for (std::size_t i = 8; i < json.size(); ++i) {
    if (json[i].is_boolean())
      record.raises_mean = json[i].get<bool>();
    else if (json[i].is_object())
      record.raise_follows = true;
    else if (json[i].is_number() || json[i].is_string())
      record.second = to_double(json[i]);
    else
      record.joint = to_joint_figures(json[i]);
  }
  return record;
}

/// Throws UsageError unless the record of an iteration agrees with its positions.
void require_record(const Run& run, const std::vector<IterationRecord>& records, std::uint64_t iteration, std::span<const Vec3> positions) {
  if (iteration >= records.size()) return;  // refused by adopt()
  constexpr double kLastDigits = 1e-6;      // tolerance: other versions of this program, and devices, may round differently
  const Statistics is = compute_statistics(run.input().quality_context(), positions, run.parameters().metric, run.immovable(), nullptr);
  const Statistics& said = records[iteration].statistics;
  const auto agree = [](double a, double b) {
    return a == b || std::abs(a - b) <= kLastDigits * std::max({1.0, std::abs(a), std::abs(b)}) || (std::isnan(a) && std::isnan(b));
  };
  if (is.inverted == said.inverted && agree(is.minimum, said.minimum) && agree(is.mean, said.mean)) return;
  throw UsageError(fmt::format(
      "a run is damaged: at iteration {} its positions have minimum {:.6g}, mean {:.6g} and {} inverted, its record says {:.6g}, "
      "{:.6g} and {}",
      iteration, is.minimum, is.mean, is.inverted, said.minimum, said.mean, said.inverted));
}

/// Recomputes the positions at the end of the run's present iteration; brings the run there and back. Throws UsageError if they do not
/// agree with the record, as in a run made by an older version of this program: the file written could not be opened.
std::vector<Vec3> start_computed_again(Run& run, Progress& progress) {
  const RunSnapshot here = run.point();
  Progress unwatched;  // not cancelled on the way back
  std::vector<Vec3> start;
  try {
    run.seek({here.moment.iteration}, progress);
    require_record(run, here.records.whole(), here.moment.iteration, run.positions());
    start.assign(run.positions().begin(), run.positions().end());
  } catch (...) {
    run.go_to(here, unwatched);
    throw;
  }
  run.go_to(here, unwatched);
  return start;
}

RunStanding standing_of_run(Run& run, std::span<const MeshStanding> meshes, Progress& progress) {
  RunStanding standing = without_positions(run, meshes);
  const Moment& at = run.moment();
  if (at.iteration == 0) return standing;
  if (at.is_iteration_end()) {
    standing.start = run.positions();  // written before the run goes on
  } else if (run.history().kept(at.iteration)) {
    standing.start = run.history().nearest(at.iteration).positions;
  } else {
    const auto start = std::make_shared<const std::vector<Vec3>>(start_computed_again(run, progress));
    standing.start = *start;
    standing.owner = start;
  }
  return standing;
}

/// Run as JSON. `several`: whether there are several meshes.
Json json_of(const RunStanding& run, const InputMesh& input, bool several) {
  Json edits = Json::array();
  for (const Edit& edit : run.edits) edits.push_back({{"at", json_of(edit.at)}, {"vertices", edit.vertices}});
  Json records = Json::array();
  for (const IterationRecord& record : run.records) records.push_back(json_of(record));
  Json json{{"parameters", json_of(run.parameters)}, {"moment", json_of(run.moment)}, {"edits", edits}, {"records", records}};
  if (!run.name.empty()) json["name"] = run.name;
  if (run.begin) json["begin"] = pack_positions(*run.begin);
  if (run.moment.iteration > 0) json["positions"] = pack_positions(run.start);
  if (run.joint) json["joint"] = joint_json(run.joint->state);
  json["standing"] = standing_mark(input, run.parameters.standing());
  if (const std::string size = size_mark(input, run.size.get()); !size.empty()) json["size"] = size;
  if (several) json["mesh"] = run.mesh;
  json["checksums"] = checksums_of(json);
  return json;
}

/// Throws UsageError if other vertices are fixed by rule, or other sizes wanted, which would lead the run elsewhere. `then`: the
/// data_marks() at saving. Older files have none of these marks.
void require_same_data(const Json& json, const Run& run, const std::vector<DataMark>& then) {
  const InputMesh& input = run.input();
  if (json.contains("standing") && json.at("standing") != standing_mark(input, run.parameters().standing())) {
    const std::string what = changed_data(then, data_marks(input.mesh));
    throw UsageError(fmt::format("{} has changed since this was saved: other vertices keep their place now ({})", input.mesh.name,
                                 what.empty() ? "this version of the program holds others" : what));
  }
  if (json.contains("size") && json.at("size") != size_mark(input, run.size_field().get()))
    throw UsageError(fmt::format("{} has changed since this was saved: the sizes wanted, its field \"{}\", are others", input.mesh.name,
                                 run.size_field()->function().field));
}

std::vector<Vec3> to_positions(const Json& json, const InputMesh& input) {
  auto unpacked = unpack_positions(json.get_ref<const std::string&>(), input.mesh.positions.size());
  if (!unpacked) throw UsageError("the positions of a run are damaged");
  return std::move(*unpacked);
}

/// Recreates a run on its mesh.
std::shared_ptr<Run> to_run(const Json& json, const Session& session, const std::shared_ptr<const InputMesh>& input,
                            const std::vector<DataMark>& data, Progress& progress) {
  BeginPositions begin;
  if (json.contains("begin")) begin = std::make_shared<const std::vector<Vec3>>(to_positions(json.at("begin"), *input));
  auto run = session.make_run(input, to_parameters(json.at("parameters")), std::move(begin));
  require_same_data(json, *run, data);
  RunSnapshot point;
  point.moment = to_moment(json.at("moment"));
  std::vector<Edit> edits;
  if (!json.at("edits").is_array() || !json.at("records").is_array()) throw UsageError("edits and records are lists");
  for (const Json& edit : json.at("edits")) edits.push_back({to_moment(edit.at("at")), to_indices(edit.at("vertices"))});
  std::vector<IterationRecord> records{run->history().records().front()};
  for (std::size_t i = 1; i < json.at("records").size(); ++i) records.push_back(to_record(json.at("records")[i], i));
  point.edits = SharedVector<Edit>(std::make_shared<const std::vector<Edit>>(std::move(edits)));
  point.records = SharedVector<IterationRecord>(std::make_shared<const std::vector<IterationRecord>>(std::move(records)));
  std::vector<Vec3> positions;
  if (point.moment.iteration > 0) {
    positions = to_positions(json.at("positions"), *input);
    for (Index v = 0; v < positions.size(); ++v)
      if (run->fixed()[v] != 0 && std::memcmp(&positions[v], &input->mesh.positions[v], sizeof(Vec3)) != 0)
        throw UsageError(fmt::format("vertex {} is fixed, but has moved", v));
  }
  if (point.moment.iteration > 0) require_record(*run, point.records.whole(), point.moment.iteration, positions);
  if (json.contains("joint"))
    point.joint.standing = std::make_shared<const JointStanding>(
        JointStanding{point.moment.iteration, to_joint_state(json.at("joint"), input->mesh.vertex_count())});
  run->adopt(point, positions, progress);
  if (json.contains("name")) {
    auto name = json.at("name").get<std::string>();
    require_run_name(name);
    run->set_given_name(std::move(name));
  }
  return run;
}

struct Opened {
  std::vector<std::shared_ptr<Run>> runs;
  std::size_t active = 0;
  Metric shown = Metric::MeanRatio;
  std::string view;
  std::string note;
};

Opened to_session(const Json& json, const std::filesystem::path& path, const Session& session, Progress& progress,
                  const std::shared_ptr<const InputMesh>& input) {
  if (!json.is_object() || json.value("format", "") != kSessionFormat) throw UsageError("this is no saved session of dmoscope");
  const std::uint64_t version = to_whole(json.at("version"));
  if (version < 1 || version > kVersion)
    throw UsageError(
        fmt::format("this session was saved in version {} of the format; this program reads versions 1 to {}", version, kVersion));
  Opened opened;
  const bool checked = version > 1 || json.contains("checksums");
  if (!checked) opened.note = "this session was saved without checksums: damage to it may go unnoticed; save it again to have them";
  if (checked && !check_parts(json, "")) opened.note = "the view was changed since the session was saved";
  const std::vector<OpenedMesh> meshes = to_meshes(json, path, session.reading(progress), input);
  const Json& runs = json.at("runs");
  if (!runs.is_array() || runs.empty()) throw UsageError("the session has no runs");
  for (const Json& run : runs) {
    progress.check();
    if (checked) (void)check_parts(run, fmt::format("run {}", opened.runs.size() + 1));
    const std::uint64_t mesh = run.contains("mesh") ? to_whole(run.at("mesh")) : 0;
    if (mesh >= meshes.size()) throw UsageError(fmt::format("a run is on mesh {}, but there are {}", mesh, meshes.size()));
    opened.runs.push_back(to_run(run, session, meshes[mesh].input, meshes[mesh].data, progress));
  }
  opened.active = to_whole(json.at("active"));
  if (opened.active >= runs.size()) throw UsageError(fmt::format("run {} is active, but there are {}", opened.active, runs.size()));
  opened.shown = parse_metric(json.at("shown").get<std::string>());
  if (json.contains("view")) opened.view = json.at("view").dump(-1, ' ', false, Json::error_handler_t::replace);
  return opened;
}

Json parse(std::string_view text, const std::string& file) {
  try {
    // Limits the depth: sessions are not nested deeply, and later code that walks through them is recursive.
    return Json::parse(text, [&file](int depth, Json::parse_event_t /*event*/, Json& /*parsed*/) {
      constexpr int kDeepest = 64;
      if (depth > kDeepest) throw InputError(file, 0, "nested too deeply for a saved session");
      return true;
    });
  } catch (const Json::parse_error& error) {
    const std::string_view before = text.substr(0, std::min<std::size_t>(text.size(), error.byte == 0 ? 0 : error.byte - 1));
    const auto line = static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n')) + 1;
    throw InputError(file, line, "this is not a saved session: it is not JSON");
  } catch (const Json::exception&) {  // a number beyond the range of double
    throw InputError(file, 0, "a number in it is too large for a saved session");
  }
}

}  // namespace

void save_state(const std::filesystem::path& path, Session& session, const std::string& view, Progress& progress) {
  (void)session.input();  // throws if no mesh is open
  SessionStanding standing = without_runs(session);
  for (std::size_t i = 0; i < session.run_count(); ++i) {
    progress.check();
    standing.runs.push_back(standing_of_run(session.run(i), standing.meshes, progress));
  }
  write_state(path, standing, view, progress);
}

void write_state(const std::filesystem::path& path, const SessionStanding& session, const std::string& view, Progress& progress) {
  const bool several = session.meshes.size() > 1;
  Json json{{"format", kSessionFormat}, {"version", version_for(session)}};
  if (several) {
    for (const MeshStanding& mesh : session.meshes) json["inputs"].push_back(input_json(mesh));
  } else {
    json["input"] = input_json(session.meshes.front());
  }
  json["runs"] = Json::array();
  for (const RunStanding& run : session.runs) {
    progress.check();
    json["runs"].push_back(json_of(run, *session.meshes[run.mesh].input, several));
  }
  json["active"] = session.active;
  json["shown"] = info(session.shown).name;
  if (!view.empty()) {
    json["view"] = Json::parse(view, nullptr, false);
    if (json["view"].is_discarded()) throw UsageError("the view to be saved is no JSON");
  }
  json["checksums"] = checksums_of(json);
  std::string text;
  try {
    text = json.dump(1) + "\n";
  } catch (const Json::exception&) {
    throw OutputError(path.string(), "the mesh's name is no UTF-8 text");
  }
  write_file_atomically(path, text);
}

std::string open_state(const std::filesystem::path& path, Session& session, Progress& progress,
                       const std::shared_ptr<const InputMesh>& input) {
  const std::string file = path.string();
  const FileBytes bytes = read_whole_file(path, progress);
  const Json json = parse(bytes.view(), file);
  Opened opened;
  try {
    opened = to_session(json, path, session, progress, input);
  } catch (const Json::exception&) {
    throw InputError(file, 0, "something is missing in this saved session, or is of another kind than it should be");
  } catch (const UsageError& error) {
    throw InputError(file, 0, error.what());
  }
  session.replace(std::move(opened.runs), opened.active, opened.shown);
  session.restore_view(std::move(opened.view));
  return opened.note;
}

}  // namespace dmoscope
