#include "core/run/parameters.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/base/unknown_value.h"
#include "core/base/words.h"
#include "core/quality/defined_judge.h"

namespace dmoscope {

namespace {

int to_int(const std::string& word) {
  const std::uint64_t value = to_count(word);
  if (value > 1000000) throw WrongArguments(fmt::format("'{}' is too large", word));
  return static_cast<int>(value);
}

/// Reads a share or an angle: above 0.
double to_positive(const std::string& word, double most, std::string_view what) {
  const double value = to_number(word);
  if (!(value > 0.0 && value <= most)) throw UsageError(fmt::format("the {} must be above 0 and at most {}, not {}", what, most, word));
  return value;
}

using P = RunParameters;
using Word = const std::string&;

constexpr std::array<std::string_view, 2> kPrecisions{"float", "double"}, kDirections{"random", "axes"}, kBoundary{"fixed", "slide"},
    kLayers{"keep", "free"};
constexpr std::array<std::string_view, 4> kSimdLevels{"auto", "baseline", "avx2", "avx512"};
constexpr std::array<std::string_view, 3> kBackends{"auto", "cpu", "cuda"}, kInterfaces{"fixed", "free", "slide"};

const std::array kTable{
    ParameterInfo{.name = "grid",
                  .title = "grid points",
                  .type = "N",
                  .doc = "Candidates per axis of the grid (the paper: 8)",
                  .kind = ParameterKind::Whole,
                  .least = kLeastGridPoints,
                  .most = kMostGridPoints,
                  .reader = &MethodInfo::searches_grid,
                  .to_text = [](const P& p) { return std::to_string(p.search.grid_points); },
                  .from_text = [](P& p, Word word) { p.search.grid_points = to_int(word); },
                  .in_title = [](const P& p) { return fmt::format("grid {}", p.search.grid_points); }},
    ParameterInfo{.name = "levels",
                  .title = "levels",
                  .type = "N",
                  .doc = "Grids per visit, each finer than the one before (the paper: 3)",
                  .kind = ParameterKind::Whole,
                  .least = kLeastLevels,
                  .most = kMostLevels,
                  .reader = &MethodInfo::searches_grid,
                  .to_text = [](const P& p) { return std::to_string(p.search.levels); },
                  .from_text = [](P& p, Word word) { p.search.levels = to_int(word); },
                  .in_title = [](const P& p) { return fmt::format("levels {}", p.search.levels); }},
    ParameterInfo{.name = "omega",
                  .title = "omega",
                  .type = "X",
                  .doc = "Size of the first grid in bounding boxes of the star's other vertices (the paper: 0.5)",
                  .kind = ParameterKind::Real,
                  .most = kMostOmega,
                  .reader = &MethodInfo::searches_grid,
                  .to_text = [](const P& p) { return fmt::format("{}", p.search.omega); },
                  .from_text = [](P& p, Word word) { p.search.omega = to_number(word); },
                  .in_title = [](const P& p) { return fmt::format("omega {:g}", p.search.omega); }},
    ParameterInfo{.name = "precision",
                  .title = "precision",
                  .type = "float|double",
                  .doc = "Scalar of the search; moves are always confirmed in double",
                  .kind = ParameterKind::Choice,
                  .choices = kPrecisions,
                  .reader = &MethodInfo::searches_grid,
                  .to_text = [](const P& p) { return std::string(name(p.search.precision)); },
                  .from_text = [](P& p, Word word) { p.search.precision = parse_precision(word); },
                  .in_title = [](const P& p) { return std::string(name(p.search.precision)); }},
    ParameterInfo{
        .name = "simd",
        .title = "SIMD",
        .type = "LEVEL",
        .doc = "Vector instructions: auto, baseline, avx2 or avx512. The result is the same for any",
        .choices = kSimdLevels,
        .reader = &MethodInfo::searches_grid,
        .to_text = [](const P& p) { return std::string(p.search.simd ? name(*p.search.simd) : "auto"); },
        .from_text = [](P& p, Word word) { p.search.simd = word == "auto" ? std::nullopt : std::optional(parse_simd_level(word)); },
        .in_session = false},
    ParameterInfo{.name = "relaxation",
                  .title = "relaxation",
                  .type = "X",
                  .doc = "Share of the way to the new place that a vertex goes",
                  .kind = ParameterKind::Real,
                  .most = 1.0,
                  .reader = &MethodInfo::relaxes,
                  .to_text = [](const P& p) { return fmt::format("{}", p.options.relaxation); },
                  .from_text = [](P& p, Word word) { p.options.relaxation = to_number(word); },
                  .in_title = [](const P& p) { return fmt::format("relaxation {}", p.options.relaxation); },
                  .before = "1"},
    ParameterInfo{.name = "directions",
                  .title = "directions",
                  .type = "random|axes",
                  .doc = "Directions of the lines along which vertices move, one per iteration: at random, or the axes in turn",
                  .kind = ParameterKind::Choice,
                  .choices = kDirections,
                  .reader = &MethodInfo::has_directions,
                  .to_text = [](const P& p) { return std::string(name(p.options.directions)); },
                  .from_text = [](P& p, Word word) { p.options.directions = parse_directions(word); },
                  .in_title = [](const P&) { return std::string("along the axes"); },
                  .before = "random"},
    ParameterInfo{.name = "seed",
                  .title = "seed",
                  .type = "N",
                  .doc = "Seed of the random directions",
                  .kind = ParameterKind::Whole,
                  .most = static_cast<double>(std::numeric_limits<std::uint64_t>::max()),
                  .reader = &MethodInfo::has_directions,
                  .condition = [](const P& p) { return p.options.directions == Directions::Random; },
                  .to_text = [](const P& p) { return std::to_string(p.options.seed); },
                  .from_text = [](P& p, Word word) { p.options.seed = to_count(word); },
                  .in_title = [](const P& p) { return fmt::format("directions {}", p.options.seed); },
                  .before = "1",
                  .item = "directions-seed"},
    ParameterInfo{
        .name = "guard",
        .title = "guard",
        .type = "METRIC:input|METRIC:VALUE|off",
        .doc = "A metric whose least falls neither below that of the input (or a value) nor, where it is below, any further, whatever "
               "metric is raised; not that metric itself, and not where targets are given",
        .to_text = [](const P& p) { return to_text(p.guard); },
        .from_text = [](P& p, Word word) { p.guard = parse_guard(word); },
        .in_title = [](const P& p) { return "guard " + to_text(p.guard); },
        .before = "off"},
    ParameterInfo{.name = "order",
                  .title = "order",
                  .type = "natural|shuffle:SEED",
                  .doc = "Order in which vertices are coloured and visited",
                  .to_text = [](const P& p) { return to_text(p.order); },
                  .from_text = [](P& p, Word word) { p.order = parse_order(word); },
                  .in_title = [](const P& p) { return to_text(p.order); }},
    ParameterInfo{
        .name = "interfaces",
        .title = "interfaces",
        .type = "fixed|free|slide",
        .doc = "Whether vertices stay that lie between groups of elements (or between values of material, region, mat_id and the "
               "like), or on inner lines and faces, boundary strings and points that the file names. Slide: those between materials move "
               "along themselves",
        .kind = ParameterKind::Choice,
        .choices = kInterfaces,
        .to_text = [](const P& p) { return std::string(name(p.interfaces)); },
        .from_text = [](P& p, Word word) { p.interfaces = parse_interface_rule(word); },
        .in_title = [](const P& p) { return fmt::format("interfaces {}", name(p.interfaces)); },
        .before = "free"},
    ParameterInfo{.name = "layers",
                  .title = "layers",
                  .type = "keep|free",
                  .doc = "Whether the vertices of boundary layers stay: stacks of at least 3 cells that begin at the "
                         "boundary 4 times as wide as high, and grow. With a target they are free",
                  .kind = ParameterKind::Choice,
                  .choices = kLayers,
                  .to_text = [](const P& p) { return std::string(name(p.layers)); },
                  .from_text = [](P& p, Word word) { p.layers = parse_layer_rule(word); },
                  .in_title = [](const P& p) { return fmt::format("layers {}", name(p.layers)); },
                  .before = "free"},
    ParameterInfo{.name = "boundary",
                  .title = "boundary",
                  .type = "fixed|slide",
                  .doc =
                      "Whether the vertices of the boundary stay or slide: in a plane along the boundary of the input, in a volume on its "
                      "surface. Corners stay, and what the file names",
                  .kind = ParameterKind::Choice,
                  .choices = kBoundary,
                  .to_text = [](const P& p) { return std::string(name(p.boundary)); },
                  .from_text = [](P& p, Word word) { p.boundary = parse_boundary_rule(word); },
                  .in_title = [](const P& p) { return fmt::format("boundary {}", name(p.boundary)); },
                  .before = "fixed"},
    ParameterInfo{.name = "corner-angle",
                  .title = "corner angle",
                  .type = "X",
                  .doc =
                      "Degrees: a vertex where the boundary, or a feature edge of a surface, turns by more is a corner, which stays where "
                      "others slide",
                  .kind = ParameterKind::Real,
                  .most = 180.0,
                  .sliding_only = true,
                  .to_text = [](const P& p) { return fmt::format("{}", p.corner_angle); },
                  .from_text = [](P& p, Word word) { p.corner_angle = to_positive(word, 180.0, "corner angle"); },
                  .in_title = [](const P& p) { return fmt::format("corner angle {:g}", p.corner_angle); },
                  .before = "20"},
    ParameterInfo{
        .name = "feature-angle",
        .title = "feature angle",
        .type = "X",
        .doc = "Degrees: where the surface of a volume folds by more it has a feature edge, which vertices slide along and not across",
        .kind = ParameterKind::Real,
        .most = 180.0,
        .volume_only = true,
        .sliding_only = true,
        .to_text = [](const P& p) { return fmt::format("{}", p.feature_angle); },
        .from_text = [](P& p, Word word) { p.feature_angle = to_positive(word, 180.0, "feature angle"); },
        .in_title = [](const P& p) { return fmt::format("feature angle {:g}", p.feature_angle); },
        .before = "40"},
    ParameterInfo{.name = "max-deviation",
                  .title = "max deviation",
                  .type = "X",
                  .doc = "How far the boundary may come to lie from that of the input where it slides, as a share of the diagonal of "
                         "the mesh's box",
                  .kind = ParameterKind::Real,
                  .most = 1.0,
                  .sliding_only = true,
                  .to_text = [](const P& p) { return fmt::format("{}", p.max_deviation); },
                  .from_text = [](P& p, Word word) { p.max_deviation = to_positive(word, 1.0, "greatest deviation"); },
                  .in_title = [](const P& p) { return fmt::format("max deviation {:g}", p.max_deviation); },
                  .before = "0.001"},
    ParameterInfo{.name = "fit",
                  .title = "fit within",
                  .type = "DISTANCE|off",
                  .doc = "Vertices within this distance of another mesh's surface are drawn to their nearest place on it first, as far "
                         "as all elements stay sound and the guard holds. The boundary slides then",
                  .sliding_only = true,
                  .to_text = [](const P& p) { return p.fit > 0.0 ? fmt::format("{}", p.fit) : std::string("off"); },
                  .from_text =
                      [](P& p, Word word) {
                        p.fit = word == "off" ? 0.0 : to_positive(word, std::numeric_limits<double>::max(), "distance of a fit");
                        if (p.fit > 0.0) p.boundary = BoundaryRule::Slide;
                      },
                  .in_title = [](const P& p) { return fmt::format("fit {:g}", p.fit); },
                  .before = "off",
                  .said = "fit-surface",
                  .item = "fit-surface"},
    ParameterInfo{.name = "joint-gap",
                  .title = "joint gap",
                  .type = "X",
                  .doc = "How near joint moves bring the minimum of a cluster to what it can reach, as a share of that. The last half "
                         "percent costs the mean",
                  .kind = ParameterKind::Real,
                  .most = 0.5,
                  .joint_only = true,
                  .to_text = [](const P& p) { return fmt::format("{}", p.joint_gap); },
                  .from_text = [](P& p, Word word) { p.joint_gap = to_positive(word, 0.5, "gap of joint moves"); },
                  .in_title = [](const P& p) { return fmt::format("joint gap {:g}", p.joint_gap); },
                  .before = "0.0002"},
    ParameterInfo{.name = "fields",
                  .title = "fields",
                  .type = "place|carry|NAME=place,...",
                  .doc = "Whether nodal fields (depth, temperature) are written as the input has them at the vertices' new places or "
                         "go along with the vertices: place, carry, or either for some by name (depth=carry). Whole numbers and sets go "
                         "along in any case",
                  .to_text = [](const P& p) { return to_text(p.fields); },
                  .from_text = [](P& p, Word word) { p.fields = parse_field_rules(word); },
                  .before = "place"},
    ParameterInfo{.name = "backend",
                  .title = "backend",
                  .type = "auto|cpu|cuda",
                  .doc = "What smooths: the CPU, a CUDA device, or (auto) a CUDA device where it can be used",
                  .kind = ParameterKind::Choice,
                  .choices = kBackends,
                  .to_text = [](const P& p) { return std::string(name(p.backend)); },
                  .from_text = [](P& p, Word word) { p.backend = parse_backend(word); }},
};

}  // namespace

namespace {

bool something_slides(const RunParameters& p) {
  return p.boundary == BoundaryRule::Slide || p.interfaces == InterfaceRule::Slide || !p.kinds.features.empty();
}

}  // namespace

bool ParameterInfo::read_by(const RunParameters& parameters, bool surface) const {
  if (reader != nullptr && !(method_info(parameters.method).*reader)) return false;
  if (sliding_only && !surface && !something_slides(parameters)) return false;
  if (joint_only && !parameters.then_joint && !method_info(parameters.method).joint) return false;
  return condition == nullptr || condition(parameters);
}

std::string ParameterInfo::help() const {
  constexpr double kAny = 1e9;  // more is no practical limit
  std::string text(doc);
  if (kind == ParameterKind::Whole && most < kAny) text += fmt::format(", {} to {}", least, most);
  if (kind == ParameterKind::Real) text += fmt::format(", above {}, up to {}", least, most);
  std::vector<std::string_view> readers;
  for (const MethodInfo& method : method_table())
    if (reader == nullptr || method.*reader) readers.push_back(method.name);
  return readers.size() == method_table().size() ? text : fmt::format("{}. For {}", text, fmt::join(readers, ", "));
}

std::span<const ParameterInfo> parameter_table() { return kTable; }

const ParameterInfo& parameter_info(std::string_view name) {
  const auto found = std::ranges::find(kTable, name, &ParameterInfo::name);
  if (found == kTable.end()) throw UsageError(fmt::format("there is no parameter '{}'", name));
  return *found;
}

StandingRule RunParameters::standing() const {
  const bool kept = target_of(metric).is_ideal() && layers == LayerRule::Keep;
  return {interfaces, boundary, corner_angle, feature_angle, kinds, kept ? LayerRule::Keep : LayerRule::Free, fit};
}

void aim_at(RunParameters& parameters, const Target& target) {
  const Metric first = with_target(parameters.metric, target);
  if (parameters.combination)
    if (auto* second = std::get_if<Metric>(&parameters.combination->second)) *second = with_target(*second, target);
  parameters.metric = first;
}

std::string target_sentence(const InputMesh& input, Metric metric) {
  const Target target = target_of(metric);
  if (target.is_ideal()) return "targets: ideal elements";
  return fmt::format("targets: {}", input.quality_context().judge(metric)->targets().facts().phrase);
}

void set_then(RunParameters& parameters, std::string_view words, const PhaseBegin& begin) {
  constexpr std::string_view kJoint = "joint";
  const bool joint = words == kJoint || words.starts_with("joint,");
  const std::string_view mean = joint ? words.substr(std::min(words.size(), kJoint.size() + 1)) : words;
  const bool known = std::ranges::find(kMeanNames, mean) != kMeanNames.end();
  if (!known && words != kJoint && words != "nothing") {
    std::vector<std::string_view> choices{"joint", "joint,mean", "nothing"};
    choices.insert(choices.end(), kMeanNames.begin(), kMeanNames.end());
    throw UsageError(unknown_value("later phases", std::string(words), choices));
  }
  parameters.then_joint = joint ? std::optional(begin) : std::nullopt;
  parameters.then_mean = known ? std::optional(begin) : std::nullopt;
  parameters.mean = known ? parse_choice<MeanKind>("mean", mean, kMeanNames) : MeanKind::Harmonic;
}

void be_patient(RunParameters& parameters, std::uint64_t patience) {
  if (parameters.then_joint) parameters.then_joint->patience = patience;
  if (parameters.then_mean) parameters.then_mean->patience = patience;
}

std::string then_words(const RunParameters& parameters) {
  const std::string mean(parameters.then_mean ? name(parameters.mean) : "");
  if (parameters.then_joint) return mean.empty() ? "joint" : "joint," + mean;
  return mean.empty() ? "nothing" : mean;
}

std::string then_text(const RunParameters& parameters) {
  return fmt::format("{}{}", parameters.then_joint ? ", then joint" : "",
                     parameters.then_mean ? fmt::format(", then {}", name(parameters.mean)) : "");
}

std::string other_than_usual(const RunParameters& parameters, bool surface) {
  const RunParameters usual;
  const SizeFunction* size = parameters.combination ? parameters.combination->size() : nullptr;
  std::string text;
  if (size != nullptr && size->has_point()) text += fmt::format(", at {:g} {:g}", size->point.x, size->point.y);
  for (const ParameterInfo& row : kTable)
    if (row.in_title != nullptr && row.read_by(parameters, surface) && row.to_text(parameters) != row.to_text(usual))
      text += ", " + row.in_title(parameters);
  if (const std::string kinds = phrase(parameters.kinds); !kinds.empty() && (surface || something_slides(parameters))) text += ", " + kinds;
  return text;
}

std::string to_text(const VisitOrder& order) { return order.seed ? fmt::format("shuffle:{}", *order.seed) : "natural"; }

VisitOrder parse_order(std::string_view word) {
  constexpr std::string_view prefix = "shuffle:";
  if (word == "natural") return {};
  if (word.starts_with(prefix)) return {to_count(std::string(word.substr(prefix.size())))};
  throw WrongArguments(fmt::format("'{}' is not an order: choose natural or shuffle:SEED", word));
}

}  // namespace dmoscope
