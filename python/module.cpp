// The Python module's core: meshes, quality, smoothing and traces as NumPy arrays. dmoscope/__init__.py wraps it for users.

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "dmoscope/dmoscope.h"

namespace py = pybind11;

namespace {

template <class T>
using Array = py::array_t<T, py::array::c_style | py::array::forcecast>;

/// A read-only view of memory that `owner` keeps.
template <class T>
py::array_t<T> view_of(const T* data, std::vector<py::ssize_t> shape, const py::object& owner) {
  py::array_t<T> array(std::move(shape), data, owner);
  array.attr("flags").attr("writeable") = false;
  return array;
}
/// Moves a vector into an array's memory, without a copy.
template <class T>
py::array array_of(std::vector<T> values, const std::vector<py::ssize_t>& shape) {
  auto* kept = new std::vector<T>(std::move(values));
  const py::capsule owner(kept, [](void* memory) { delete static_cast<std::vector<T>*>(memory); });
  return py::array_t<T>(shape, kept->data(), owner);
}
template <class T>
py::array array_of(std::vector<T> values) {
  const auto count = static_cast<py::ssize_t>(values.size());
  return array_of(std::move(values), {count});
}

py::ssize_t length(std::size_t n) { return static_cast<py::ssize_t>(n); }

/// Throws unless `points` is n x 3.
void require_points(const Array<double>& points) {
  if (points.ndim() != 2 || points.shape(1) != 3) throw py::value_error("points must be an array of n x 3");
}

using NumbersByName = std::map<std::string, py::array>;

/// Converts arrays with one number, or a row of them, for each vertex or cell.
std::vector<dmo::Numbers> numbers_of(const NumbersByName& arrays) {
  std::vector<dmo::Numbers> all;
  for (const auto& [name, array] : arrays) {
    const Array<double> values(array);
    const std::size_t components = values.ndim() < 2 ? 1 : static_cast<std::size_t>(values.shape(1));
    const bool whole = std::string("iub").find(array.dtype().kind()) != std::string::npos;
    all.push_back({name, {values.data(), values.data() + values.size()}, components, whole});
  }
  return all;
}

py::dict arrays_of(std::vector<dmo::Numbers> all) {
  py::dict arrays;
  for (dmo::Numbers& one : all) {
    std::vector<py::ssize_t> shape{length(one.values.size() / one.components)};
    if (one.components > 1) shape.push_back(length(one.components));
    const py::array values = array_of(std::move(one.values), shape);
    arrays[py::str(one.name)] = one.whole ? values.attr("astype")("int64") : py::object(values);
  }
  return arrays;
}

dmo::Mesh make_mesh(const Array<double>& points, const Array<std::uint8_t>& kinds, const Array<dmo::Index>& offsets,
                    const Array<dmo::Index>& connectivity, const NumbersByName& cell_numbers, const NumbersByName& point_numbers) {
  require_points(points);
  if (kinds.ndim() != 1 || offsets.ndim() != 1 || connectivity.ndim() != 1 || offsets.shape(0) != kinds.shape(0) + 1 ||
      offsets.data()[kinds.shape(0)] > connectivity.shape(0))
    throw py::value_error("kinds, offsets and connectivity do not fit one another");
  static_assert(sizeof(dmo::CellKind) == sizeof(std::uint8_t));
  const dmo::Cells cells{static_cast<std::size_t>(kinds.shape(0)), reinterpret_cast<const dmo::CellKind*>(kinds.data()), offsets.data(),
                         connectivity.data()};
  const auto vertices = static_cast<std::size_t>(points.shape(0));
  const std::vector<dmo::Numbers> cell_data = numbers_of(cell_numbers), point_data = numbers_of(point_numbers);
  const py::gil_scoped_release release;
  return dmo::Mesh(points.data(), vertices, cells, cell_data, point_data);
}

/// Lets a working thread ask the thread that has Python.
class Question {
 public:
  /// Asks, on the working thread, and waits for the answer.
  bool ask(const dmo::Iteration& about) {
    std::unique_lock lock(mutex_);
    about_ = about;
    changed_.notify_all();
    changed_.wait(lock, [this] { return !about_; });
    return answer_;
  }
  /// Answers, on the Python thread, by look(iteration), if a question is open.
  template <class Look>
  void answer(const Look& look) {
    const std::scoped_lock lock(mutex_);
    if (!about_) return;
    answer_ = look(*about_);
    about_.reset();
    changed_.notify_all();
  }
  /// Tells, on the working thread, that there will be no more questions.
  void end() {
    const std::scoped_lock lock(mutex_);
    ended_ = true;
    changed_.notify_all();
  }
  /// Waits, on the Python thread, for a question or the end, for at most 20 ms.
  void wait() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::milliseconds(20), [this] { return about_ || ended_; });
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<dmo::Iteration> about_;
  bool answer_ = true, ended_ = false;
};

/// Does the work on another thread, while this one answers its questions by look(iteration), and handles Python's signals: the first one
/// cancels the work. Returns the exception that a signal's handler raised, if one did.
template <class Work, class Look>
auto interruptible(dmo::Progress progress, Question& question, const Work& work, const Look& look) {
  std::optional<py::error_already_set> raised;
  std::future<decltype(work())> future;
  {
    const py::gil_scoped_release release;
    future = std::async(std::launch::async, [&] {
      const std::unique_ptr<Question, void (*)(Question*)> end(&question, [](Question* asked) { asked->end(); });
      return work();
    });
    while (future.wait_for(std::chrono::seconds(0)) != std::future_status::ready) {
      question.wait();
      const py::gil_scoped_acquire acquire;
      question.answer(look);
      if (raised || PyErr_CheckSignals() == 0) continue;
      raised.emplace();
      progress.request_cancel();
    }
  }
  return std::pair(std::move(future), std::move(raised));
}

dmo::Mesh read(const std::string& path) {
  dmo::Progress progress;
  Question none;
  auto [future, raised] = interruptible(
      progress, none, [&] { return dmo::Mesh::read(path, progress); }, [](const dmo::Iteration&) { return true; });
  if (raised) throw std::move(*raised);
  return future.get();
}

py::dict history_of(const std::vector<dmo::Iteration>& iterations) {
  const auto column = [&](auto get) {
    std::vector<decltype(get(iterations.front()))> values;
    for (const dmo::Iteration& one : iterations) values.push_back(get(one));
    return array_of(std::move(values));
  };
  py::dict columns;
  columns["iteration"] = column([](const dmo::Iteration& i) { return i.number; });
  columns["minimum"] = column([](const dmo::Iteration& i) { return i.statistics.minimum; });
  columns["mean"] = column([](const dmo::Iteration& i) { return i.statistics.mean; });
  columns["movable_minimum"] = column([](const dmo::Iteration& i) { return i.statistics.movable_minimum; });
  columns["inverted"] = column([](const dmo::Iteration& i) { return static_cast<std::uint64_t>(i.statistics.inverted); });
  columns["moved"] = column([](const dmo::Iteration& i) { return i.moved; });
  columns["seconds"] = column([](const dmo::Iteration& i) { return i.seconds; });
  return columns;
}

/// Names and numbers of vertices or edges.
template <class Number>
using Selected = std::pair<std::vector<std::string>, std::vector<Number>>;
using SelectedVertices = std::map<std::string, Selected<dmo::Index>>;
using SelectedEdges = std::map<std::string, Selected<std::array<dmo::Index, 2>>>;

dmo::SmoothOptions options_of(const std::vector<std::pair<std::string, std::string>>& words, const SelectedVertices& vertices,
                              const SelectedEdges& edges, const std::optional<dmo::Mesh>& surface) {
  dmo::SmoothOptions options;
  for (const auto& [name, text] : words) options.set(name, text);
  const auto take = [](auto& numbers, auto& names, const auto& selected) {
    names = selected.first;
    numbers = selected.second;
  };
  for (const auto& [name, field] : {std::pair("fixed", &dmo::SmoothOptions::fixed),
                                    {"slide", &dmo::SmoothOptions::slide},
                                    {"corners", &dmo::SmoothOptions::corners},
                                    {"no_corners", &dmo::SmoothOptions::no_corners}})
    take((options.*field).numbers, (options.*field).names, vertices.at(name));
  take(options.features.ends, options.features.names, edges.at("features"));
  take(options.no_features.ends, options.no_features.names, edges.at("no_features"));
  options.surface = surface;
  return options;
}

py::list parameters() {
  py::list all;
  for (const dmo::Parameter& p : dmo::parameters())
    all.append(py::dict(py::arg("name") = p.name, py::arg("doc") = p.doc, py::arg("usual") = p.usual, py::arg("least") = p.least,
                        py::arg("most") = p.most, py::arg("choices") = p.choices, py::arg("methods") = p.methods));
  return all;
}

py::object held_of(const std::optional<dmo::Held>& held) {
  if (!held) return py::none();
  std::map<dmo::Index, std::string> vertices;
  for (std::size_t i = 0; i < held->vertices.size(); ++i) vertices[held->vertices[i]] = held->reasons[i];
  return py::make_tuple(held->cell, held->quality, held->by, vertices, held->change, held->certified, held->sentence);
}

/// Whether the answer is False, or NumPy's False.
bool is_false(const py::object& answer) {
  if (answer.ptr() == Py_False) return true;
  return std::string(Py_TYPE(answer.ptr())->tp_name).starts_with("numpy.bool") && PyObject_IsTrue(answer.ptr()) == 0;
}

py::tuple smooth(const dmo::Mesh& mesh, dmo::SmoothOptions options, const py::object& callback) {
  std::exception_ptr failure;  // an exception of the callback
  Question question;
  if (!callback.is_none()) options.after_iteration = [&question](const dmo::Iteration& at) { return question.ask(at); };
  const auto look = [&](const dmo::Iteration& at) {
    try {
      return !is_false(callback(at));
    } catch (...) {
      failure = std::current_exception();
      return false;
    }
  };
  auto [future, raised] = interruptible(
      options.progress, question, [&] { return dmo::smooth(mesh, options); }, look);
  if (failure) std::rethrow_exception(failure);
  if (raised && !raised->matches(PyExc_KeyboardInterrupt)) throw std::move(*raised);  // raised by the user's own handler
  dmo::Smoothed smoothed = future.get();
  const bool interrupted = raised.has_value();
  return py::make_tuple(smoothed.mesh, history_of(smoothed.history), smoothed.iteration, smoothed.converged, smoothed.cancelled,
                        interrupted, smoothed.sentence, smoothed.warnings, smoothed.fields, held_of(smoothed.held));
}

py::dict trace(const dmo::Mesh& mesh, dmo::Index vertex, const dmo::SmoothOptions& options) {
  const dmo::Trace traced = [&] {
    const py::gil_scoped_release release;
    return dmo::trace(mesh, vertex, options);
  }();
  py::list levels;
  for (const dmo::TraceLevel& level : traced.levels) {
    std::vector<py::ssize_t> grid(mesh.is_volume() ? 3 : 2, length(level.points)), places = grid;
    places.push_back(3);
    py::dict one;
    one["candidates"] = array_of(level.candidates, places);
    one["values"] = array_of(level.values, grid);
    one["quality"] = array_of(level.quality, grid);
    one["best"] = level.best < 0 ? py::object(py::none()) : py::object(py::int_(level.best));
    levels.append(std::move(one));
  }
  py::dict result;
  result["start"] = array_of(std::vector(traced.from, traced.from + 3));
  result["end"] = array_of(std::vector(traced.to, traced.to + 3));
  result["before"] = traced.before;
  result["after"] = traced.after;
  result["levels"] = std::move(levels);
  result["value"] = traced.value;
  result["sentence"] = traced.sentence;
  return result;
}

void define_mesh(py::module_& module) {
  py::class_<dmo::Mesh>(module, "Mesh")
      .def(py::init(&make_mesh), py::arg("points"), py::arg("kinds"), py::arg("offsets"), py::arg("connectivity"), py::arg("cell_data"),
           py::arg("point_data"))
      .def_static("read", &read, py::arg("path"))
      .def(
          "write", [](const dmo::Mesh& mesh, const std::string& path) { return mesh.write(path); }, py::arg("path"),
          py::call_guard<py::gil_scoped_release>())
      .def("with_points",
           [](const dmo::Mesh& mesh, const Array<double>& points) {
             require_points(points);
             if (static_cast<std::size_t>(points.shape(0)) != mesh.vertex_count()) throw py::value_error("another number of points");
             const py::gil_scoped_release release;
             return mesh.with_positions(points.data());
           })
      .def("with_materials", &dmo::Mesh::with_materials, py::arg("names"), py::call_guard<py::gil_scoped_release>())
      .def_property_readonly("points",
                             [](const py::object& self) {
                               const auto& mesh = self.cast<const dmo::Mesh&>();
                               return view_of(mesh.positions(), {length(mesh.vertex_count()), 3}, self);
                             })
      .def_property_readonly("kinds",
                             [](const py::object& self) {
                               const dmo::Cells cells = self.cast<const dmo::Mesh&>().cells();
                               return view_of(reinterpret_cast<const std::uint8_t*>(cells.kinds), {length(cells.count)}, self);
                             })
      .def_property_readonly("offsets",
                             [](const py::object& self) {
                               const dmo::Cells cells = self.cast<const dmo::Mesh&>().cells();
                               return view_of(cells.offsets, {length(cells.count + 1)}, self);
                             })
      .def_property_readonly("connectivity",
                             [](const py::object& self) {
                               const dmo::Cells cells = self.cast<const dmo::Mesh&>().cells();
                               return view_of(cells.connectivity, {length(cells.offsets[cells.count])}, self);
                             })
      .def_property_readonly("boundary",
                             [](const py::object& self) {
                               const auto& mesh = self.cast<const dmo::Mesh&>();
                               return view_of(mesh.boundary(), {length(mesh.vertex_count())}, self);
                             })
      .def_property_readonly("cell_data", [](const dmo::Mesh& mesh) { return arrays_of(mesh.cell_data()); })
      .def_property_readonly("point_data", [](const dmo::Mesh& mesh) { return arrays_of(mesh.point_data()); })
      .def_property_readonly("groups",
                             [](const dmo::Mesh& mesh) {
                               py::list groups;
                               for (dmo::Group& group : mesh.groups())
                                 groups.append(py::make_tuple(group.name, group.kind, group.members, group.number,
                                                              array_of(std::move(group.cells)), array_of(std::move(group.vertices))));
                               return groups;
                             })
      .def("vertices", [](const dmo::Mesh& mesh, const std::string& name) { return array_of(mesh.vertices(name)); })
      .def_property_readonly(
          "boundary_loops",
          [](const dmo::Mesh& mesh) {
            py::list loops;
            for (dmo::BoundaryLoop& loop : mesh.boundary_loops())
              loops.append(py::make_tuple(array_of(std::move(loop.vertices)), loop.length, loop.area, loop.part, loop.outer));
            return loops;
          })
      .def_property_readonly("parts",
                             [](const dmo::Mesh& mesh) {
                               py::list parts;
                               for (std::vector<dmo::Index>& part : mesh.parts()) parts.append(array_of(std::move(part)));
                               return parts;
                             })
      .def("ring", [](const dmo::Mesh& mesh, std::size_t vertex) { return array_of(mesh.ring(vertex)); })
      .def("to_bytes", [](const dmo::Mesh& mesh) { return py::bytes(mesh.to_bytes()); })
      .def_static("from_bytes", [](const py::bytes& bytes) { return dmo::Mesh::from_bytes(std::string_view(bytes)); })
      .def_property_readonly("is_volume", &dmo::Mesh::is_volume)
      .def_property_readonly("in_degrees", &dmo::Mesh::in_degrees)
      .def("with_degrees", &dmo::Mesh::with_degrees)
      .def_property_readonly("thin", &dmo::Mesh::thin)
      .def("with_thin", &dmo::Mesh::with_thin)
      .def_property_readonly("is_surface", &dmo::Mesh::is_surface);
}

}  // namespace

PYBIND11_MODULE(_dmoscope, module) {
  module.attr("__version__") = dmo::version();
  // Never destroyed: the interpreter ends before static objects are destroyed.
  static const py::object& error = *new py::exception<dmo::Error>(module, "Error", PyExc_RuntimeError);
  static const py::object& input_error =
      *new py::exception<dmo::InputError>(module, "InputError", py::make_tuple(error, py::handle(PyExc_ValueError)));
  static const py::object& output_error = *new py::exception<dmo::OutputError>(module, "OutputError", error);
  static const py::object& usage_error =
      *new py::exception<dmo::UsageError>(module, "UsageError", py::make_tuple(error, py::handle(PyExc_ValueError)));
  error.attr("__doc__") = "Base of all errors of the module.";
  input_error.attr("__doc__") = "Error in a file's content, or in an array; `file` and `line` say where (line 0: nowhere in particular).";
  output_error.attr("__doc__") = "A file could not be written; a former file of that name is unchanged.";
  usage_error.attr("__doc__") = "A request for something that does not exist or does not fit: an unknown metric, an option out of range.";
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const dmo::InputError& what) {
      const py::object made = input_error(what.what());
      made.attr("file") = what.file();
      made.attr("line") = what.line();
      PyErr_SetObject(input_error.ptr(), made.ptr());
    } catch (const dmo::OutputError& what) {
      PyErr_SetString(output_error.ptr(), what.what());
    } catch (const dmo::UsageError& what) {
      PyErr_SetString(usage_error.ptr(), what.what());
    } catch (const dmo::Error& what) {
      PyErr_SetString(error.ptr(), what.what());
    }
  });

  define_mesh(module);
  py::class_<dmo::Iteration>(module, "Iteration", "State at the end of an iteration, by the metric that is raised.")
      .def_readonly("number", &dmo::Iteration::number, "Number of the iteration, from 1 on.")
      .def_readonly("moved", &dmo::Iteration::moved, "Number of vertices that moved.")
      .def_readonly("seconds", &dmo::Iteration::seconds, "Time of smoothing alone.")
      .def_property_readonly(
          "minimum", [](const dmo::Iteration& i) { return i.statistics.minimum; }, "Quality of the worst cell.")
      .def_property_readonly(
          "mean", [](const dmo::Iteration& i) { return i.statistics.mean; }, "Mean quality of the cells.")
      .def_property_readonly(
          "movable_minimum", [](const dmo::Iteration& i) { return i.statistics.movable_minimum; },
          "Quality of the worst cell with a corner off the boundary.")
      .def_property_readonly(
          "inverted", [](const dmo::Iteration& i) { return i.statistics.inverted; }, "Number of inverted cells.");
  py::class_<dmo::SmoothOptions>(module, "Options").def(py::init(&options_of));
  module.def("parameters", &parameters);
  module.def("smooth", &smooth);
  module.def("trace", &trace);
  module.def("quality", [](const dmo::Mesh& mesh, const std::string& metric, unsigned threads) {
    std::vector<double> values;
    {
      const py::gil_scoped_release release;
      values = dmo::quality(mesh, metric, threads);
    }
    return array_of(std::move(values));
  });
  module.def("statistics", [](const dmo::Mesh& mesh, const std::string& metric, unsigned threads) {
    dmo::Statistics s;
    {
      const py::gil_scoped_release release;
      s = dmo::statistics(mesh, metric, threads);
    }
    py::dict result;
    result["minimum"] = s.minimum;
    result["mean"] = s.mean;
    result["movable_minimum"] = s.movable_minimum;
    result["inverted"] = s.inverted;
    result["worst_cell"] = s.worst_cell;
    return result;
  });
  module.def("metrics", [] {
    py::dict all;
    for (const dmo::Metric& m : dmo::metrics()) all[py::str(m.name)] = py::make_tuple(m.title, m.lowest, m.highest, m.formula, m.doc);
    return all;
  });
}
