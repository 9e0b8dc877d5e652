"""The module's interface: signatures, docstrings, stub and the program's table of parameters say the same; the examples run."""

import ast
import doctest
import inspect
import os
import pathlib
import re
import subprocess
import sys
import typing

import numpy as np
import pytest

import dmoscope
import test_dmoscope
from dmoscope import _dmoscope, _smooth

PROGRAM = os.environ["DMOSCOPE_PROGRAM"]
ROOT = pathlib.Path(__file__).parents[2]
PARAMETERS = {row["name"].replace("-", "_"): row for row in _dmoscope.parameters()}


def documented(function):
    """The docstring's parameters: (line of type and default, text) by name."""
    section = inspect.getdoc(function).split("Parameters\n----------\n")[1].split("\n\n")[0]
    entries = re.split(r"^(?=\S)", section, flags=re.MULTILINE)[1:]
    found = {}
    for entry in entries:
        head, *text = entry.split("\n")
        names, _, kind = head.partition(" : ")
        for name in names.split(", "):
            found[name.lstrip("*")] = (kind, " ".join(" ".join(text).split()))
    return found


@pytest.mark.parametrize("function", [dmoscope.smooth, dmoscope.trace, dmoscope.render, dmoscope.read, dmoscope.Mesh, dmoscope.Mesh.quality,
                                      dmoscope.Mesh.vertices])
def test_every_argument_is_documented_with_its_default(function):
    signature, entries = inspect.signature(function).parameters, documented(function)
    assert list(entries) == [name for name in signature if name != "self"]
    for name, (kind, text) in entries.items():
        default = signature[name].default
        if default is None and name != "guard":
            assert kind.endswith(", optional"), name
        elif default is not inspect.Parameter.empty:
            said = kind.rpartition("default ")[2]
            assert ast.literal_eval(said) == default, name
        assert text or name == "mesh", name


def test_public_names_are_documented():
    for name in dmoscope.__all__:
        one = getattr(dmoscope, name)
        assert name == "__version__" or inspect.getdoc(one) not in (None, ""), name
    for name, member in inspect.getmembers(dmoscope.Mesh):
        assert name.startswith("_") or inspect.getdoc(member), name


def test_smooth_has_a_keyword_for_each_row_of_the_table():
    signature, entries = inspect.signature(dmoscope.smooth).parameters, documented(dmoscope.smooth)
    hints = typing.get_type_hints(dmoscope.smooth)
    every = max(PARAMETERS.values(), key=lambda row: len(row["methods"]))["methods"]
    for name, row in PARAMETERS.items():
        text = entries[name][1]
        default = signature[name].default
        assert _smooth._text(name, "off" if default is None else default, default) == row["usual"] or float(default) == float(row["usual"])
        if row["choices"]:
            assert list(typing.get_args(hints[name])) == row["choices"], name
            assert all(f'"{word}"' in text for word in row["choices"]), name
        if row["most"] is not None and row["most"] < 1e9:
            range_ = f"above {row['least']:g}, up to {row['most']:g}" if isinstance(default, float) else f"{row['least']:g} to {row['most']:g}"
            assert range_ in text, name
        if row["methods"] != every:
            assert "Read by " + ", ".join(row["methods"]) in text, name
    others = {"mesh", "iterations", "until_converged", "patience", "max_iterations", "threads", "explain", "fixed", "slide", "corners", "no_corners",
              "features", "no_features", "surface", "method", "metric", "target", "combine", "size_function", "then", "recipe", "callback",
              "raise_on_interrupt"}
    assert set(signature) == others | set(PARAMETERS)
    assert list(typing.get_args(hints["method"])) == every


def test_the_manual_has_each_option_as_the_docstring_has_it():
    rows = {}
    for line in (ROOT / "docs" / "user" / "options.md").read_text().splitlines():
        cells = [cell.strip() for cell in line.replace("\\|", "\0").strip("|").split("|")]
        if len(cells) == 4 and cells[0].startswith("`"):
            rows[cells[0].strip("`")] = (cells[2].replace("\0", "|"), cells[3].strip("`"))
    signature, entries = inspect.signature(dmoscope.smooth).parameters, documented(dmoscope.smooth)
    assert set(rows) == set(signature) - {"mesh", "callback", "raise_on_interrupt"}
    for name, (text, default) in rows.items():
        assert text + "." in entries[name][1] + ".", name
        usual = signature[name].default
        assert default == {"None": "none", "False": "false"}.get(str(usual), str(usual)) or name == "iterations", name


def test_the_docstring_s_example_is_true():
    test = doctest.DocTestFinder().find(dmoscope.smooth, "smooth", globs={"dmoscope": dmoscope})[0]
    assert test.examples and doctest.DocTestRunner().run(test).failed == 0


def test_the_stub_has_what_the_module_has():
    stub = ast.parse((pathlib.Path(dmoscope.__file__).parent / "_dmoscope.pyi").read_text())
    members = {node.name: {m.name for m in node.body if isinstance(m, ast.FunctionDef)} | {m.target.id for m in node.body if isinstance(m, ast.AnnAssign)}
               for node in stub.body if isinstance(node, ast.ClassDef)}
    functions = {node.name: len(node.args.args) for node in stub.body if isinstance(node, ast.FunctionDef)}
    runtime = {name for name in vars(_dmoscope) if not name.startswith("_")}
    assert set(members) | set(functions) == runtime
    for name in ("Mesh", "Iteration", "Options"):
        of_runtime = {one for one in vars(getattr(_dmoscope, name)) if not one.startswith("_") or one == "__init__"}
        assert members[name] | {"__init__"} == of_runtime | {"__init__"}, name
    for name, count in functions.items():  # pybind11 writes the signature into the docstring
        head = getattr(_dmoscope, name).__doc__.split("\n")[0].partition("(")[2].rpartition(") ->")[0]
        assert len(re.findall(r"(?:^|, )(?:arg\d+|[a-z_]+): ", head)) == count, name


def test_mypy_takes_the_module_and_finds_typing_errors(tmp_path):
    pytest.importorskip("mypy")
    user = tmp_path / "user.py"
    user.write_text("""import dmoscope
mesh = dmoscope.Mesh([[0, 0], [1, 0], [0, 1]], {"triangle": [[0, 1, 2]]})
points = dmoscope.smooth(mesh, until_converged=True, boundary="slide", fixed={1, 2}, callback=lambda i: i.number < 3).mesh.points
dmoscope.smooth(mesh, boundry="slide")
dmoscope.smooth(mesh, boundary="slides")
dmoscope.smooth(mesh).mesh.pints
""")
    check = [sys.executable, "-m", "mypy", "--strict", f"--cache-dir={tmp_path}/cache"]
    env = {**os.environ, "MYPYPATH": str(pathlib.Path(dmoscope.__file__).parents[1])}
    package = subprocess.run([*check, "-p", "dmoscope"], capture_output=True, text=True, cwd=tmp_path, env=env)
    assert package.returncode == 0, package.stdout
    told = subprocess.run([*check, user], capture_output=True, text=True, cwd=tmp_path, env=env).stdout
    assert re.findall(r"user.py:(\d+): error", told) == ["4", "5", "6"], told


@pytest.mark.parametrize("example", sorted((ROOT / "examples").glob("*.py")), ids=lambda path: path.stem)
def test_examples_run(example, tmp_path):
    test_dmoscope.run("generate", "coast", "-o", tmp_path / "coast.14")
    told = subprocess.run([sys.executable, example, tmp_path / "coast.14"], capture_output=True, text=True, cwd=tmp_path)
    assert told.returncode == 0 and told.stdout, told.stderr


def sheet(n=8):
    points, triangles, _ = test_dmoscope.sheet(n)
    return dmoscope.Mesh(points, {"triangle": triangles})


def test_vertices_are_selected_in_any_form():
    mesh = sheet()
    mask = np.zeros(len(mesh.points), dtype=bool)
    mask[[30, 31, 40]] = True
    expected = dmoscope.smooth(mesh, fixed=mask).mesh.points
    assert (expected != dmoscope.smooth(mesh).mesh.points).any() and (expected[mask] == mesh.points[mask]).all()
    for fixed in ({40, 30, 31}, [30, 31, 40], (30, 31, 40), np.array([40, 31, 30]), "30-31,40", ["30", "31,40"], {"30-31", "40"}):
        assert (dmoscope.smooth(mesh, fixed=fixed).mesh.points == expected).all(), fixed
    assert (dmoscope.smooth(mesh, fixed=set()).mesh.points == dmoscope.smooth(mesh, fixed=[]).mesh.points).all()
    assert mesh.vertices("box:0,0,1,0").tolist() == [0, 1]
    assert set(mesh.cells_dict) == {"triangle"} and len(mesh.cells_dict["triangle"]) == 128


@pytest.mark.parametrize("name, value, error", [
    ("fixed", [81], "fixed: there is no vertex 81, the mesh has 81"), ("fixed", [-1], "fixed must be whole"), ("fixed", [0.5], "fixed must be whole"),
    ("fixed", [[1, 2]], "fixed must be a list"), ("fixed", [float("nan")], "fixed must be whole"), ("fixed", "group:wall", "fixed: group:wall"),
    ("fixed", [True, False], "fixed must be 81 booleans"), ("slide", [40], "slide: none of"), ("corners", [99], "corners: there is no vertex 99"),
    ("no_corners", {99}, "no_corners: there is no vertex 99"), ("features", [1, 2], "features must be k x 2"),
    ("features", [[0, 80]], "features: there is no edge 0-80"), ("no_features", "seam", "no_features: "), ("threads", 100000, "threads: "),
    ("iterations", 10**10, "iterations: "), ("grid", 1, "grid"), ("omega", float("nan"), "omega: "), ("corner_angle", 500, "corner_angle: "),
    ("max_deviation", -1, "max_deviation: "), ("joint_gap", float("inf"), "joint_gap: "), ("fit", -1, "fit: "), ("fit", 1, "fit: it takes a surface"),
    ("guard", "skew:input", "guard: "), ("order", "random", "order: "), ("boundary", "slides", "boundary: "), ("interfaces", "off", "interfaces: "),
    ("metric", "skew", "metric: "), ("combine", "mean-ratio", "combine: "), ("target", "round", "target: "), ("method", "dmoo", "method: "),
    ("recipe", "bests", "recipe: "), ("then", "peace", "then: "), ("size_function", "h1:0,0", "size_function is for"), ("fields", "depth=carry", "fields: "),
    ("backend", "gpu", "backend: "), ("simd", "sse9", "simd: "), ("patience", 3, "patience is for"), ("max_iterations", 3, "max_iterations is for"),
])
def test_wrong_values_are_value_errors_that_name_the_argument(name, value, error):
    with pytest.raises(ValueError, match=re.escape(error)):
        dmoscope.smooth(sheet(), **{name: value})


@pytest.mark.parametrize("name, value", [("grid", 8.5), ("seed", "one"), ("omega", "half"), ("omega", [1, 2]), ("metric", 3), ("boundary", True), ("surface", 3)])
def test_wrong_types_are_type_errors(name, value):
    with pytest.raises(TypeError):
        dmoscope.smooth(sheet(), **{name: value})
    with pytest.raises(TypeError, match="boundry"):
        dmoscope.trace(sheet(), 40, boundry="slide")


def test_what_holds_the_minimum_is_explained():
    mesh = sheet()
    assert dmoscope.smooth(mesh).held is None
    held = dmoscope.smooth(mesh, until_converged=True, explain=True).held
    assert held.cell < 128 and len(held.vertices) == 3 and "worst" in held.sentence and held.quality > 0.3
    alone = dmoscope.Mesh([[0, 0], [1, 0], [0, 1]], {"triangle": [[0, 1, 2]]})
    result = dmoscope.smooth(alone, explain=True)
    assert any("nothing can move" in told for told in result.warnings)


def test_arrays_of_a_wrong_kind_are_value_errors():
    for points in ([[0, 0], [1, 0], [0, np.nan]], [[0, 0], [1, 0]]):
        with pytest.raises(ValueError):
            dmoscope.Mesh(points, {"triangle": [[0, 1, 2]]})


@pytest.mark.parametrize("words, options", [
    (["--boundary", "slide", "--corner", "0-5", "--feature-angle", 60], dict(boundary="slide", corners=range(6), feature_angle=60)),
    (["--recipe", "best"], dict(recipe="best")),
    (["--guard", "scaled-jacobian:input", "--metric", "condition", "--order", "shuffle:5"],
     dict(guard="scaled-jacobian:input", metric="condition", order="shuffle:5")),
    (["--surface", "other.vtk", "--boundary", "slide"], dict(surface=True, boundary="slide")),
    (["--surface", "other.vtk", "--fit", "0.05"], dict(surface=True, fit=0.05)),
])
def test_volumes_have_the_program_s_bits(tmp_path, words, options):
    test_dmoscope.run("generate", "tetrahedra", "-o", tmp_path / "mesh.vtk", "--size", 343)
    test_dmoscope.run("generate", "tetrahedra", "-o", tmp_path / "other.vtk", "--size", 1000)
    subprocess.run([PROGRAM, "smooth", "mesh.vtk", "-o", "program.vtk", *map(str, words)], cwd=tmp_path, stdout=subprocess.DEVNULL)
    if "surface" in options:
        options = {**options, "surface": dmoscope.read(tmp_path / "other.vtk")}
    mesh = dmoscope.read(tmp_path / "mesh.vtk")
    smoothed = dmoscope.smooth(mesh, **options).mesh
    assert (smoothed.points != mesh.points).any()
    smoothed.write(tmp_path / "module.vtk")
    assert (tmp_path / "program.vtk").read_bytes() == (tmp_path / "module.vtk").read_bytes()
