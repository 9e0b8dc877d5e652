// dmoscope info: describes this program and the machine's devices; or the content of a mesh file.

#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "app/common/console.h"
#include "app/common/machine.h"
#include "app/common/text.h"
#include "app/subcommands/input_report.h"
#include "app/subcommands/subcommands.h"
#include "core/base/error.h"
#include "core/io/mesh_io.h"
#include "core/mesh/generate.h"
#include "core/mesh/thin.h"
#include "core/numeric/simd.h"
#include "core/quality/defined_metric.h"
#include "core/quality/metric.h"
#include "core/run/run.h"
#include "core/target/boundary_layers.h"
#include "core/view/drawing_path.h"
#include "gpu/accelerator.h"
#include "gpu/device.h"

#ifdef DMOSCOPE_HAVE_GUI
#include "app/window/interop.h"
#include "core/smooth/execution/method_table.h"
#endif

namespace dmoscope::app {
namespace {

std::array<std::size_t, kElementKindCount> count_kinds(const Mesh& mesh) {
  std::array<std::size_t, kElementKindCount> counts{};
  for (const ElementKind kind : mesh.elements.kinds()) ++counts[static_cast<std::size_t>(kind)];
  return counts;
}

Json json_of(const InputMesh& input, const Mesh& mesh, const std::filesystem::path& file, const std::vector<std::string>& warnings) {
  const auto counts = count_kinds(mesh);
  const BoundaryLayers layers = find_boundary_layers(input.mesh, input.geometry);
  Json kinds = Json::object();
  for (std::size_t k = 0; k < kElementKindCount; ++k)
    if (counts[k] > 0) kinds[std::string(kElementKinds[k].plural)] = counts[k];
  return {{"input", file.string()},
          {"title", mesh.title},
          {"vertices", mesh.vertex_count()},
          {"elements", mesh.elements.size()},
          {"kinds", std::move(kinds)},
          {"groups", json_of_groups(mesh)},
          {"data", json_of_fields(mesh)},
          {"outline", json_of_outline(outline_of(input.mesh))},
          {"boundary_layers", {{"elements", layers.elements.size()}, {"stacks", layers.stacks}, {"most", layers.most}}},
          {"thin", input.mesh.thin != nullptr},
          {"held_on_interfaces", input.interfaces.count()},
          {"warnings", warnings}};
}

/// Prints the file's elements, groups, data and interfaces; with `json` as one JSON object. Throws the errors of reading.
void tell_mesh(const std::filesystem::path& file, bool json) {
  Watch watch;
  IoContext reading(watch.progress());
  reading.geographic = Geographic::Auto;
  reading.thin = Thin::Auto;
  const auto input = load_input(file, Need::QualityOnly, reading);
  const Mesh cells = input->mesh.thin ? with_cells(input->mesh) : Mesh();
  const Mesh& mesh = input->mesh.thin ? cells : input->mesh;  // the cells of the file
  const std::vector<std::string> warnings = tell_findings(*input);
  if (json) return print_json(json_of(*input, mesh, file, warnings));
  std::string kinds;
  const auto counts = count_kinds(mesh);
  for (std::size_t k = 0; k < kElementKindCount; ++k) {
    if (counts[k] == 0) continue;
    kinds += (kinds.empty() ? "" : ", ") + counted(counts[k], kElementKinds[k].name, kElementKinds[k].plural);
  }
  print("{}: {}, {}\n", mesh.name, counted(mesh.vertex_count(), "vertex", "vertices"), kinds);
  if (!mesh.title.empty()) print("{}\n", mesh.title);
  print_groups(mesh, std::numeric_limits<std::size_t>::max());
  print_fields(mesh);
  print_outline(outline_of(input->mesh));
  if (const BoundaryLayers layers = find_boundary_layers(input->mesh, input->geometry); !layers.empty())
    print("\nboundary layers: {} in {}, up to {} high ({})\n", counted(layers.elements.size(), "element", "elements"),
          counted(layers.stacks, "stack", "stacks"), layers.most,
          input->layers.empty()
              ? "--target layers:input keeps them"
              : fmt::format("{} of them stay when it is smoothed: --layers free lets them go, --target layers:input keeps "
                            "their shape",
                            counted(input->layers.size(), "vertex", "vertices")));
  if (const std::string sentence = input->interfaces.sentence("--interfaces free"); !sentence.empty())
    print("\nwhen it is smoothed, {}\n", sentence);
}

struct OpenGl {
  bool usable = false;
  std::string text;     // the drawing context, or why there is none
  DrawingPath drawing;  // from the device that runs would compute on
};

OpenGl headless_opengl(const Acceleration& acceleration) {
  const auto path = [&](const std::string& obstacle) {
    if (!acceleration.accelerator) return drawing_path(Backend::Cpu, "no cuda: " + acceleration.reason, obstacle);
    return drawing_path(acceleration.accelerator->backend(), acceleration.accelerator->description(), obstacle);
  };
#ifdef DMOSCOPE_HAVE_GUI
  try {
    const auto context = headless_context_for(acceleration);
    return {true, context->description(), path(no_interop(acceleration, *context))};
  } catch (const Error& error) {
    return {false, error.what(), path(error.what())};
  }
#else
  const std::string reason = "built without OpenGL";
  return {false, reason, path(reason)};
#endif
}

Json json_of(const gpu::Availability& cuda, const Acceleration& acceleration) {
  Json devices = Json::array();
  for (const gpu::Device& device : cuda.devices) {
    devices.push_back(
        {{"name", device.name}, {"compute_capability", fmt::format("{}.{}", device.major, device.minor)}, {"memory", device.memory}});
  }
  return {{"name", "cuda"},
          {"usable", acceleration.accelerator != nullptr},
          {"built", cuda.built},
          {"reason", acceleration.reason},
          {"description", acceleration.accelerator ? acceleration.accelerator->description() : std::string()},
          {"devices", std::move(devices)}};
}

std::vector<std::string_view> simd_names() {
  std::vector<std::string_view> names;
  for (const SimdLevel level : supported_simd_levels()) names.push_back(name(level));
  return names;
}

Json everything() {
  const Acceleration acceleration = gpu::make_accelerator();
  const OpenGl gl = headless_opengl(acceleration);
  const unsigned threads = std::thread::hardware_concurrency();
  const auto elements_of = [](const MetricInfo& metric) {
    Json kinds = Json::array();
    for (std::size_t k = 0; k < kElementKindCount; ++k)
      if (metric.defined_for(static_cast<ElementKind>(k))) kinds.push_back(kElementKinds[k].name);
    return kinds;
  };
  Json object{{"version", DMOSCOPE_VERSION}, {"build", DMOSCOPE_BUILD_TYPE}, {"compiler", compiler()}, {"threads", threads}};
  object["backends"] = {{{"name", "cpu"}, {"usable", true}, {"threads", threads}, {"simd", name(best_simd_level())}},
                        json_of(gpu::availability(), acceleration)};
  object["simd"] = {{"levels", simd_names()}, {"used", name(best_simd_level())}};
  object["opengl"] = {{"usable", gl.usable}, {"description", gl.text}};
  object["drawing"] = {{"path", gl.drawing.name}, {"reason", gl.drawing.reason}};
  for (const FormatInfo& f : format_table()) {
    object["formats"].push_back({{"name", f.name}, {"title", f.title}, {"extensions", f.extensions}, {"doc", f.doc}});
  }
  for (const MetricInfo& m : metric_table()) {
    object["metrics"].push_back({{"name", m.name},
                                 {"title", m.title},
                                 {"elements", elements_of(m)},
                                 {"lowest", m.lowest},
                                 {"highest", m.highest},
                                 {"acceptable", m.acceptable},
                                 {"formula", m.formula},
                                 {"doc", m.doc}});
  }
  for (const MethodInfo& m : method_table()) object["methods"].push_back({{"name", m.name}, {"doc", m.doc}});
  for (const GeneratorInfo& g : generator_table()) {
    object["generators"].push_back({{"name", g.name}, {"doc", g.doc}, {"default_size", g.default_size}});
  }
  return object;
}

std::string not_usable(const Acceleration& acceleration) { return "not usable: " + acceleration.reason; }

void print_cuda(const gpu::Availability& cuda, const Acceleration& acceleration) {
  print("  cuda   {}\n", acceleration.accelerator ? "usable: " + acceleration.accelerator->description() : not_usable(acceleration));
  for (const gpu::Device& device : cuda.devices) {
    print("         {} (compute capability {}.{}, {:.1f} GiB)\n", device.name, device.major, device.minor,
          static_cast<double>(device.memory) / static_cast<double>(std::size_t{1} << 30U));
  }
}

/// One sentence: the path of a run's mesh to the screen, and the reason if it is not the fastest.
std::string path_sentence(const DrawingPath& path, const Acceleration& acceleration) {
  if (!acceleration.accelerator) return "from the processor's memory, since CUDA is " + not_usable(acceleration);
  if (path.reason.empty()) return "written by the CUDA device";
  return "copied from the CUDA device through the processor's memory: " + path.reason;
}

void print_for_a_person() {
  const Acceleration acceleration = gpu::make_accelerator();
  const OpenGl gl = headless_opengl(acceleration);
  print("dmoscope {} ({}, {})\n\nbackends\n", DMOSCOPE_VERSION, DMOSCOPE_BUILD_TYPE, compiler());
  print("  cpu    usable, {}\n", counted(std::thread::hardware_concurrency(), "processor thread", "processor threads"));
  print("         SIMD {} (supported: {})\n", name(best_simd_level()), fmt::join(simd_names(), ", "));
  print_cuda(gpu::availability(), acceleration);
  print("\ndrawing\n  path   {}\n", path_sentence(gl.drawing, acceleration));
  print("  opengl {}{}\n\nformats\n", gl.usable ? "" : "not usable: ", gl.text);
  for (const FormatInfo& f : format_table()) print("  {:<16} {}; {}\n", f.extensions, f.title, f.doc);
  print("\nmetrics\n");
  for (const MetricInfo& m : metric_table()) print("  {:<22} {}\n", m.name, m.doc);
  for (const NamedFormula& m : named_formulas()) print("  {:<22} {}\n", m.name, m.doc);
  print("\nmethods\n");
  for (const MethodInfo& m : method_table()) print("  {:<16} {}\n", m.name, m.doc);
  print("\nsamples (dmoscope generate)\n");
  for (const GeneratorInfo& g : generator_table()) print("  {:<16} {}\n", g.name, g.doc);
}

}  // namespace

void add_info(CLI::App& app, Action& action) {
  auto json = std::make_shared<bool>(false);
  auto file = std::make_shared<std::filesystem::path>();
  CLI::App* subcommand =
      app.add_subcommand("info", "Version, backends and devices, formats, metrics, methods and samples; or what is in a mesh");
  subcommand->add_option("FILE", *file, "Mesh whose elements, groups and data to list");
  subcommand->add_flag("--json", *json, "Print one JSON object and nothing else on standard output");
  subcommand->callback([json, file, &action] {
    action = [json, file] {
      if (!file->empty()) {
        tell_mesh(*file, *json);
      } else if (*json) {
        print_json(everything());
      } else {
        print_for_a_person();
      }
      return 0;
    };
  });
}

}  // namespace dmoscope::app
