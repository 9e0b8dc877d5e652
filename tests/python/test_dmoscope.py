"""The Python module: arrays in and out without copies, the program's bits, interrupts, meshio."""

import copy
import gc
import multiprocessing
import os
import pickle
import signal
import struct
import subprocess
import threading
import time
import zlib

import numpy as np
import pytest

import dmoscope

PROGRAM = os.environ["DMOSCOPE_PROGRAM"]


def run(*arguments):
    subprocess.run([PROGRAM, *map(str, arguments)], check=True, stdout=subprocess.DEVNULL)


@pytest.fixture(scope="session")
def coast(tmp_path_factory):
    path = tmp_path_factory.mktemp("meshes") / "coast.14"
    run("generate", "coast", "-o", path)
    return path


def sheet(n=8):
    """n x n squares of two triangles, inner vertices out of place; two coordinates."""
    rng = np.random.default_rng(7)
    x, y = np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0))
    points = np.column_stack([x.ravel(), y.ravel()])
    inside = (points > 0).all(axis=1) & (points < n).all(axis=1)
    points[inside] += rng.uniform(-0.3, 0.3, (inside.sum(), 2))
    a = (np.arange(n)[None, :] + (n + 1) * np.arange(n)[:, None]).ravel()
    triangles = np.concatenate([np.column_stack([a, a + 1, a + n + 2]), np.column_stack([a, a + n + 2, a + n + 1])])
    return points, triangles, inside


def test_quality_by_hand():
    mesh = dmoscope.Mesh([[0, 0], [1, 0], [0.5, 0.75**0.5], [1, -1]], {"triangle": [[0, 1, 2], [0, 3, 1]]})
    q = mesh.quality()
    assert q.shape == (2,)
    assert q == pytest.approx([1.0, 4 * 3**0.5 * 0.5 / 4])
    assert mesh.statistics()["worst_cell"] == 1
    assert "mean-ratio" in dmoscope.metrics() and dmoscope.metrics()["mean-ratio"].highest == 1
    with pytest.raises(dmoscope.UsageError, match="mean-ratio"):
        mesh.quality("mean")


def test_points_are_a_view_that_outlives_the_mesh():
    points, triangles, _ = sheet()
    mesh = dmoscope.Mesh(points, {"triangle": triangles})
    view = mesh.points
    assert not view.flags.owndata and not view.flags.writeable
    assert mesh.points.__array_interface__["data"] == view.__array_interface__["data"]
    del mesh
    gc.collect()
    assert (view[:, :2] == points).all() and (view[:, 2] == 0).all()
    with pytest.raises(ValueError):
        view[0, 0] = 1


def test_cells_come_back_in_their_order():
    cells = [("quad", [[0, 1, 4, 3]]), ("triangle", [[1, 2, 5], [1, 5, 4]]), ("quad", [[3, 4, 7, 6], [4, 5, 8, 7]])]
    mesh = dmoscope.Mesh([[i, j] for j in range(3) for i in range(3)], cells)
    back = mesh.cells
    assert [kind for kind, _ in back] == ["quad", "triangle", "quad"]
    for (_, given), (_, got) in zip(cells, back):
        assert (np.asarray(given) == got).all()
    assert mesh.boundary.sum() == 8 and not mesh.boundary[4]
    assert "3 quad" in repr(mesh)


def test_what_cannot_be_is_refused():
    points, triangles, _ = sheet(2)
    for cells, told in [({"line": [[0, 1]]}, "line"), ({"triangle": [[0, 1]]}, "m x 3"), ({"triangle": [[0, 1, -2]]}, "from 0"), ([], "cells")]:
        with pytest.raises(ValueError, match=told):
            dmoscope.Mesh(points, cells)
    with pytest.raises(dmoscope.InputError, match="corner 99"):
        dmoscope.Mesh(points, {"triangle": [[0, 1, 99]]})
    with pytest.raises(ValueError, match="n x 3"):
        dmoscope.Mesh(np.zeros((3, 4)), {"triangle": triangles})
    with pytest.raises(ValueError, match="booleans"):
        dmoscope.smooth(dmoscope.Mesh(points, {"triangle": triangles}), fixed=np.zeros(3, dtype=bool))
    with pytest.raises(TypeError, match="no mesh"):
        dmoscope.smooth(points)
    with pytest.raises(TypeError, match="methode"):
        dmoscope.smooth(dmoscope.Mesh(points, {"triangle": triangles}), methode="dmo")


def test_boundary_loops_parts_and_rings():
    points, triangles, _ = sheet(6)
    mesh = dmoscope.Mesh(points, {"triangle": triangles})
    (loop,) = mesh.boundary_loops
    assert loop.outer and loop.part == 0 and len(loop.vertices) == 24
    assert loop.length == pytest.approx(24) and loop.area == pytest.approx(36)
    assert set(loop.vertices) == set(np.flatnonzero(mesh.boundary))
    (part,) = mesh.parts
    assert list(part) == list(range(len(triangles)))
    ring = mesh.ring(8)
    around = points[ring] - points[8]
    turns = np.diff(np.unwrap(np.arctan2(around[:, 1], around[:, 0])))
    assert set(ring) == set(triangles[(triangles == 8).any(axis=1)].ravel()) - {8} and (turns > 0).all()
    with pytest.raises(dmoscope.UsageError, match="no vertex 49"):
        mesh.ring(49)
    # Two sheets are two parts; one is kept.
    both = dmoscope.Mesh(np.vstack([points, points + [10, 0]]), {"triangle": np.vstack([triangles, triangles + len(points)])})
    assert [len(part) for part in both.parts] == [len(triangles)] * 2 and [loop.part for loop in both.boundary_loops] == [0, 1]
    moved = dmoscope.smooth(both, 3, fixed="part:1").mesh.points != both.points
    assert not moved[:len(points)].any() and moved[len(points):].any()


def test_bad_file_names_file_and_line(tmp_path):
    path = tmp_path / "wrong.off"
    path.write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 one 0\n3 0 1 2\n")
    with pytest.raises(dmoscope.InputError) as told:
        dmoscope.read(path)
    assert told.value.file == str(path) and told.value.line == 5


@pytest.mark.parametrize("options, words", [
    (dict(iterations=7), ["--iterations", 7]),
    (dict(until_converged=True), ["--until-converged"]),
    (dict(until_converged=True, then="mean", metric="min-angle"), ["--until-converged", "--then", "mean", "--metric", "min-angle"]),
    (dict(iterations=5, combine="mean-ratio:0.7:min-angle", boundary="slide", corner_angle=30),
     ["--iterations", 5, "--combine", "mean-ratio:0.7:min-angle", "--boundary", "slide", "--corner-angle", 30]),
])
def test_same_bits_as_the_program(coast, tmp_path, options, words):
    run("smooth", coast, "-o", tmp_path / "program.14", *words)
    smoothed = dmoscope.smooth(dmoscope.read(coast), threads=1, **options)
    smoothed.mesh.write(tmp_path / "module.14")
    assert (tmp_path / "program.14").read_bytes() == (tmp_path / "module.14").read_bytes()
    assert (dmoscope.read(tmp_path / "program.14").points == smoothed.mesh.points).all()


def test_history_and_callback():
    points, triangles, inside = sheet(20)
    mesh = dmoscope.Mesh(points, {"triangle": triangles})
    heard = []
    smoothed = dmoscope.smooth(mesh, iterations=6, callback=lambda i: heard.append((i.number, i.minimum)))
    assert [number for number, _ in heard] == list(range(1, 7))
    assert smoothed.history["minimum"][1:].tolist() == [minimum for _, minimum in heard]
    assert smoothed.history["minimum"][0] == mesh.statistics()["minimum"]
    assert (np.diff(smoothed.history["minimum"]) >= 0).all()
    assert (smoothed.mesh.points[~inside] == mesh.points[~inside]).all()
    cut = dmoscope.smooth(mesh, iterations=6, callback=lambda i: i.number < 2)
    assert cut.cancelled and cut.iteration == 2
    assert (cut.mesh.points == dmoscope.smooth(mesh, iterations=2).mesh.points).all()

    def fails(iteration):
        raise KeyError("mine")

    with pytest.raises(KeyError, match="mine"):
        dmoscope.smooth(mesh, callback=fails)


def test_fixed_as_mask_and_as_numbers():
    points, triangles, inside = sheet()
    mesh = dmoscope.Mesh(points, {"triangle": triangles})
    mask = np.ones(len(points), dtype=bool)
    mask[40] = False
    for fixed in (mask, np.flatnonzero(mask)):
        moved = (dmoscope.smooth(mesh, fixed=fixed).mesh.points != mesh.points).any(axis=1)
        assert moved.sum() == 1 and moved[40]


def test_trace_ends_where_the_visit_does():
    points, triangles, inside = sheet(2)
    mesh = dmoscope.Mesh(points, {"triangle": triangles})
    trace = dmoscope.trace(mesh, 4)
    assert [level.candidates.shape for level in trace.levels] == [(8, 8, 3)] * 3
    assert (trace.end == dmoscope.smooth(mesh, iterations=1).mesh.points[4]).all()
    best = trace.levels[-1]
    if best.best is not None:
        assert best.values.ravel()[best.best] == best.values.max()
    assert trace.after >= trace.before


def test_interrupt_keeps_the_mesh(tmp_path):
    run("generate", "grid", "-o", tmp_path / "grid.off", "--size", 250000)
    mesh = dmoscope.read(tmp_path / "grid.off")
    begun = threading.Event()

    def interrupt():
        begun.wait()
        os.kill(os.getpid(), signal.SIGINT)
        interrupt.at = time.monotonic()

    thread = threading.Thread(target=interrupt)
    thread.start()
    with pytest.warns(RuntimeWarning, match="interrupted"):
        smoothed = dmoscope.smooth(mesh, iterations=10**6, callback=lambda i: begun.set())
    thread.join()
    assert smoothed.cancelled
    assert smoothed.mesh.statistics()["minimum"] > mesh.statistics()["minimum"]
    assert smoothed.iteration < 10**6


def test_other_threads_run_meanwhile():
    points, triangles, _ = sheet(150)
    mesh = dmoscope.Mesh(points, {"triangle": triangles})
    counted, stop = [0], threading.Event()

    def count():
        while not stop.is_set():
            counted[0] += 1

    thread = threading.Thread(target=count)
    thread.start()
    before = counted[0]
    dmoscope.smooth(mesh, iterations=20, threads=1)
    during = counted[0] - before
    stop.set()
    thread.join()
    assert during > 1000


def test_meshio_is_taken_and_given_back(tmp_path):
    meshio = pytest.importorskip("meshio")
    run("generate", "mixed", "-o", tmp_path / "mixed.vtk")
    given = meshio.read(tmp_path / "mixed.vtk")
    given.point_data["depth"] = np.arange(len(given.points), dtype=float)
    smoothed = dmoscope.smooth(given, iterations=4)
    assert isinstance(smoothed.mesh, meshio.Mesh)
    assert (smoothed.mesh.point_data["depth"] == given.point_data["depth"]).all()
    assert (given.points != smoothed.mesh.points).any(), "the one that was given is as it was"
    run("smooth", tmp_path / "mixed.vtk", "-o", tmp_path / "program.vtk", "--iterations", 4)
    assert (meshio.read(tmp_path / "program.vtk").points == smoothed.mesh.points).all()
    again = dmoscope.Mesh(given.points, given.cells).to_meshio()
    assert [(b.type, b.data.tolist()) for b in again.cells] == [(b.type, b.data.tolist()) for b in given.cells]
    before = given.point_data["depth"].copy()
    smoothed.mesh.point_data["depth"] += 1
    assert (given.point_data["depth"] == before).all()


@pytest.mark.parametrize("extension", [".vtk", ".vtu", ".inp"])
def test_materials_come_and_go_by_meshio(tmp_path, extension):
    """meshio has the scalars of legacy VTK as (n, 1), and the element sets of Abaqus as cell_sets."""
    meshio = pytest.importorskip("meshio")
    path = tmp_path / ("nested" + extension)
    run("generate", "nested", "-o", path)
    own = dmoscope.read(path)
    held = dmoscope.smooth(own, until_converged=True).mesh.points
    assert (held == dmoscope.smooth(own.to_meshio(), until_converged=True).mesh.points).all()
    given = meshio.read(path)
    given.point_data["column"] = np.arange(len(given.points), dtype=float).reshape(-1, 1)
    smoothed = dmoscope.smooth(given, until_converged=True).mesh
    assert (held == smoothed.points).all() and smoothed.point_data["column"].shape == (len(held), 1)
    assert (held != dmoscope.smooth(own, until_converged=True, interfaces="free").mesh.points).any()
    back = dmoscope.Mesh(own.points, own.cells, {"region": np.ones((len(own.quality()), 1), dtype=int)}, {"wind": own.points}).to_meshio()
    assert back.point_data["wind"].tolist() == own.points.tolist()
    assert all(part.dtype.kind == "i" and (part == 1).all() for part in back.cell_data["region"])


def test_meshio_s_wedges_have_another_order(tmp_path):
    meshio = pytest.importorskip("meshio")
    run("generate", "solids", "-o", tmp_path / "solids.vtk")
    by_meshio, own = meshio.read(tmp_path / "solids.vtk"), dmoscope.read(tmp_path / "solids.vtk")
    wedges = {tuple(c) for b in by_meshio.cells if b.type == "wedge" for c in b.data.tolist()}
    assert wedges == {tuple(c) for b in own.to_meshio().cells if b.type == "wedge" for c in b.data.tolist()} and wedges
    # A single one has no neighbour that could tell its outside.
    points = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], dtype=float)
    meshio.write(tmp_path / "one.vtk", meshio.Mesh(points, [("wedge", np.array([[0, 1, 2, 3, 4, 5]]))]))
    of_file = dmoscope.read(tmp_path / "one.vtk")
    taken = dmoscope.smooth(meshio.read(tmp_path / "one.vtk"), iterations=0)
    assert of_file.quality()[0] > 0 and taken.history["minimum"][0] == of_file.quality()[0]


@pytest.mark.parametrize("extension", [".msh", ".mesh"])
def test_what_mesh_generators_put_beside_the_cells(tmp_path, extension):
    """Points, lines and faces of boundaries are passed over, and materials hold their interfaces: as with the program's own reader."""
    meshio = pytest.importorskip("meshio")
    run("generate", "nested", "-o", tmp_path / ("nested" + extension))
    of_file = dmoscope.smooth(dmoscope.read(tmp_path / ("nested" + extension)), iterations=3)
    given = meshio.read(tmp_path / ("nested" + extension))
    taken = dmoscope.smooth(given, iterations=3)
    assert (taken.mesh.points[:, :2] == of_file.mesh.points[:, :2]).all()
    with_more = meshio.Mesh(given.points, [("vertex", np.array([[0]])), ("line", np.array([[0, 1]]))] + [(b.type, b.data) for b in given.cells],
                            cell_data={name: [np.zeros(1), np.zeros(1)] + parts for name, parts in given.cell_data.items()})
    again = dmoscope.smooth(with_more, iterations=3).mesh
    assert (again.points == taken.mesh.points).all() and len(again.cells) == len(given.cells) + 2


def test_med_is_written_as_meshio_reads_it(tmp_path):
    meshio = pytest.importorskip("meshio")
    pytest.importorskip("h5py")
    run("generate", "solids", "-o", tmp_path / "solids.vtk")
    given = meshio.read(tmp_path / "solids.vtk")
    kinds = {block.type for block in given.cells}
    by_kind = [(kind, np.concatenate([b.data for b in given.cells if b.type == kind])) for kind in sorted(kinds)]
    meshio.write(tmp_path / "solids.med", meshio.Mesh(given.points, by_kind))
    run("smooth", tmp_path / "solids.med", "-o", tmp_path / "smoothed.med", "--iterations", 4)
    smoothed = meshio.read(tmp_path / "smoothed.med")
    assert (smoothed.points != given.points).any()
    assert {b.type: b.data.tolist() for b in smoothed.cells} == {kind: data.tolist() for kind, data in by_kind}
    assert dmoscope.read(tmp_path / "smoothed.med").quality().min() > dmoscope.read(tmp_path / "solids.med").quality().min()


def test_faces_beside_solids_are_passed_over(tmp_path):
    meshio = pytest.importorskip("meshio")
    run("generate", "tetrahedra", "-o", tmp_path / "t.vtk", "--size", 125)
    given = meshio.read(tmp_path / "t.vtk")
    plain = dmoscope.smooth(given, iterations=2).mesh.points
    faces = given.cells[0].data[:5, :3]
    both = meshio.Mesh(given.points, [("triangle", faces), ("tetra", given.cells[0].data)])
    assert (dmoscope.smooth(both, iterations=2).mesh.points == plain).all()


def test_materials_hold_their_interface():
    points, triangles, inside = sheet(8)
    material = (points[triangles].mean(axis=1)[:, 0] > 4).astype(int)
    free = dmoscope.smooth(dmoscope.Mesh(points, {"triangle": triangles}))
    held = dmoscope.smooth(dmoscope.Mesh(points, {"triangle": triangles}, {"material": material}))
    between = np.intersect1d(triangles[material == 0], triangles[material == 1])
    assert (held.mesh.points[between, :2] == points[between]).all()
    assert (free.mesh.points[between, :2] != points[between]).any()
    with pytest.raises(dmoscope.InputError, match="3 values"):
        dmoscope.Mesh(points, {"triangle": triangles}, {"material": [1, 2, 3]})


def test_callback_is_called_on_the_calling_thread():
    points, triangles, _ = sheet()
    seen = set()
    dmoscope.smooth(dmoscope.Mesh(points, {"triangle": triangles}), callback=lambda i: seen.add(threading.current_thread()))
    assert seen == {threading.current_thread()}
    for answer, iterations in ((0.0, 4), ("text", 4), (np.bool_(False), 1), (False, 1)):
        heard = []
        dmoscope.smooth(dmoscope.Mesh(points, {"triangle": triangles}), iterations=4, callback=lambda i: (heard.append(1), answer)[1])
        assert len(heard) == iterations, answer


def test_options_are_heard_or_refused():
    points, triangles, _ = sheet()
    mesh = dmoscope.Mesh(points, {"triangle": triangles})
    for options in (dict(max_iterations=2), dict(patience=3), dict(recipe="best", method="laplace"), dict(iterations=3, until_converged=True),
                    dict(combine="mean-ratio:0.7:density", then="mean")):
        with pytest.raises(dmoscope.UsageError):
            dmoscope.smooth(mesh, **options)
    assert any("set until_converged" in told for told in dmoscope.smooth(mesh, iterations=2, then="mean").warnings)
    assert dmoscope.smooth(mesh, recipe="best").converged
    assert dmoscope.smooth(mesh, recipe=None).iteration == 20
    by_option, by_metric = dmoscope.smooth(mesh, target="input"), dmoscope.smooth(mesh, metric="mean-ratio@input")
    assert (by_option.mesh.points == by_metric.mesh.points).all()
    assert set(dmoscope.metrics()) >= {"aspect", "relative-size", "shape-size"}


def test_an_interrupt_at_once_keeps_the_mesh_or_is_raised(tmp_path):
    run("generate", "grid", "-o", tmp_path / "grid.off", "--size", 300000)
    moved = dmoscope.smooth(dmoscope.read(tmp_path / "grid.off"), iterations=1).mesh  # prepared anew for the next smoothing
    for wait in (0.15, 0.5):
        threading.Timer(wait, os.kill, (os.getpid(), signal.SIGINT)).start()
        with pytest.warns(RuntimeWarning, match="interrupted"):
            assert dmoscope.smooth(moved, iterations=10**6).cancelled
    threading.Timer(0.15, os.kill, (os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        dmoscope.smooth(moved, iterations=10**6, raise_on_interrupt=True)


def test_point_data_belong_to_places():
    points, triangles, _ = sheet()
    depth = 10 * points[:, 0] + 0.25
    mesh = dmoscope.Mesh(points, {"triangle": triangles}, point_data={"depth": depth, "flag": np.arange(len(points)) % 3})
    result = dmoscope.smooth(mesh)
    assert (result.mesh.points != mesh.points).any()
    assert np.allclose(result.mesh.point_data["depth"], 10 * result.mesh.points[:, 0] + 0.25, rtol=0, atol=1e-12)
    assert (result.mesh.point_data["flag"] == mesh.point_data["flag"]).all()
    assert result.fields.startswith("depth was taken anew")
    assert (pickle.loads(pickle.dumps(result.mesh)).point_data["depth"] == result.mesh.point_data["depth"]).all()
    assert (dmoscope.smooth(mesh, fields="carry").mesh.point_data["depth"] == depth).all()
    meshio = pytest.importorskip("meshio")
    given = meshio.Mesh(points, [("triangle", triangles)], point_data={"depth": depth.astype(np.float32), "flag": np.arange(len(points))})
    back = dmoscope.smooth(given).mesh
    assert back.point_data["depth"].dtype == np.float32 and np.allclose(back.point_data["depth"], 10 * back.points[:, 0] + 0.25, atol=1e-5)
    assert (back.point_data["flag"] == given.point_data["flag"]).all()


def test_meshes_can_be_pickled():
    points, triangles, _ = sheet()
    mesh = dmoscope.Mesh(points, {"triangle": triangles}, {"material": np.arange(len(triangles)) // 16}, {"depth": points[:, 0]})
    again = pickle.loads(pickle.dumps(mesh))
    assert (again.points == mesh.points).all() and (again.cells[0][1] == mesh.cells[0][1]).all()
    assert (again.cell_data["material"] == mesh.cell_data["material"]).all() and (again.point_data["depth"] == points[:, 0]).all()
    with pytest.raises(dmoscope.InputError, match="damaged"):
        dmoscope._from_bytes(b"no mesh")


def by_copies(mesh):
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        elsewhere = pool.map(dmoscope.smooth, [mesh])[0].mesh
    return [elsewhere] + [dmoscope.smooth(one).mesh for one in (pickle.loads(pickle.dumps(mesh)), copy.copy(mesh), copy.deepcopy(mesh))]


@pytest.mark.parametrize("kind, extension", [("coast", ".14"), ("nested", ".vtk"), ("nested", ".msh")])
def test_copies_are_smoothed_and_written_as_the_mesh_is(tmp_path, kind, extension):
    run("generate", kind, "-o", tmp_path / ("mesh" + extension))
    mesh = dmoscope.read(tmp_path / ("mesh" + extension))
    run("smooth", tmp_path / ("mesh" + extension), "-o", tmp_path / ("program" + extension))
    for smoothed in by_copies(mesh):
        smoothed.write(tmp_path / ("copy" + extension))
        assert (tmp_path / ("copy" + extension)).read_bytes() == (tmp_path / ("program" + extension)).read_bytes()


def test_new_places_are_written_in_the_file_s_own_format(coast, tmp_path):
    mesh = dmoscope.read(coast)
    moved = mesh.with_points(mesh.points * [2, 2, 1] + [1000, 0, 0])
    smoothed = dmoscope.smooth(moved, fields="carry")
    count = int(coast.read_text().split("\n")[1].split()[1])
    before = [line.split() for line in coast.read_text().splitlines()]
    for one in (moved, smoothed.mesh, dmoscope.smooth(smoothed.mesh.with_points(moved.points), fields="carry").mesh):
        one.write(tmp_path / "new.14")
        after = [line.split() for line in (tmp_path / "new.14").read_text().splitlines()]
        nodes = slice(2, 2 + count)
        assert [[float(x), float(y)] for _, x, y, *_ in after[nodes]] == one.points[:, :2].tolist()
        assert [line[:1] + line[3:] for line in after[nodes]] == [line[:1] + line[3:] for line in before[nodes]]
        assert after[:2] + after[2 + count:] == before[:2] + before[2 + count:]


def test_any_cell_data_name_materials():
    points, triangles, _ = sheet(8)
    halves = (points[triangles].mean(axis=1)[:, 0] > np.median(points[:, 0])).astype(int)
    mesh = dmoscope.Mesh(points, {"triangle": triangles}, {"zoning": halves})
    between = [v for v in range(len(points)) if len(set(halves[(triangles == v).any(axis=1)])) > 1 and not mesh.boundary[v]]
    named = mesh.with_materials("zoning")
    assert len(between) > 3
    for one in (named, pickle.loads(pickle.dumps(named))):
        assert (dmoscope.smooth(one, 3).mesh.points[between] == mesh.points[between]).all()
    assert (dmoscope.smooth(named.with_materials(()), 3).mesh.points[between] != mesh.points[between]).any()
    with pytest.raises(ValueError, match="unknown cell data 'zones'; known are zoning"):
        mesh.with_materials("zones")


def test_numbers_that_are_not_whole_are_refused():
    points, triangles, _ = sheet(2)
    mesh = dmoscope.Mesh(points, {"triangle": triangles})
    for error, match, work in [(TypeError, "iterations must be a whole number, not 5.5", lambda: dmoscope.smooth(mesh, 5.5)),
                               (ValueError, "iterations must be a whole number from 0 on, not -1", lambda: dmoscope.smooth(mesh, -1)),
                               (ValueError, "threads must be a whole number from 0 on, not -1", lambda: dmoscope.smooth(mesh, threads=-1)),
                               (ValueError, "threads: expected a whole number from 0 to 1024", lambda: mesh.quality(threads=1025)),
                               (ValueError, "threads: expected a whole number from 0 to 1024", lambda: mesh.statistics(threads=2**40)),
                               (ValueError, "threads: expected a whole number from 0 to 1024", lambda: dmoscope.smooth(mesh, threads=1025)),
                               (ValueError, "vertex must be a whole number from 0 on, not -1", lambda: dmoscope.trace(mesh, -1))]:
        with pytest.raises(error, match=match):
            work()
    assert dmoscope.smooth(mesh, np.int64(3), threads=np.int32(1)).iteration == 3
    with pytest.raises(ValueError, match="whole"):
        dmoscope.Mesh(points, {"triangle": triangles + 0.5})
    with pytest.raises(ValueError, match="fixed must be whole"):
        dmoscope.smooth(dmoscope.Mesh(points, {"triangle": triangles}), fixed=[4.9])


def test_pyvista_is_taken_and_given_back():
    """By an object with the same members: PyVista is no package of Debian's."""

    class Grid:
        def __init__(self, points, cells):
            self.points = points
            self.celltypes = np.full(len(cells), 5, dtype=np.uint8)
            self.offset = np.arange(0, 3 * len(cells) + 1, 3)
            self.cell_connectivity = cells.ravel()
            self.cells = np.column_stack([np.full(len(cells), 3), cells]).ravel()  # flat, as in PyVista
            self.cells_dict = {5: cells}
            self.point_data, self.cell_data = {}, {}

        def copy(self):
            return Grid(self.points.copy(), self.cell_connectivity.reshape(-1, 3).copy())

    points, triangles, _ = sheet()
    grid = Grid(np.column_stack([points, np.zeros(len(points))]), triangles)
    material = (points[triangles].mean(axis=1)[:, 0] > 4).astype(int)
    grid.cell_data["material"] = material.reshape(-1, 1)
    held = dmoscope.smooth(dmoscope.Mesh(points, {"triangle": triangles}, {"material": material}), iterations=3)
    assert (dmoscope.smooth(grid, iterations=3).mesh.points == held.mesh.points).all()
    grid.cell_data.clear()
    smoothed = dmoscope.smooth(grid, iterations=3)
    assert isinstance(smoothed.mesh, Grid)
    mesh = dmoscope.Mesh(points, {"triangle": triangles})
    assert (smoothed.mesh.points == dmoscope.smooth(mesh, iterations=3).mesh.points).all()
    grid.celltypes[3] = 22
    with pytest.raises(ValueError, match="22"):
        dmoscope.smooth(grid)


def png(path):
    """A PNG's pixels, by the standard library alone: 8 bits of red, green, blue and opacity, not interlaced."""
    data = path.read_bytes()
    width, height = struct.unpack(">II", data[16:24])
    assert data[24:26] == b"\x08\x06" and data[28] == 0
    at, packed = 8, b""
    while at < len(data):
        length, kind = struct.unpack(">I4s", data[at:at + 8])
        if kind == b"IDAT":
            packed += data[at + 8:at + 8 + length]
        at += 12 + length
    raw = np.frombuffer(zlib.decompress(packed), dtype=np.uint8).reshape(height, 1 + 4 * width).astype(np.int64)
    out = np.zeros((height, width, 4), dtype=np.int64)
    for y in range(height):
        kind, line = raw[y, 0], raw[y, 1:].reshape(width, 4)
        above = out[y - 1] if y else np.zeros((width, 4), dtype=np.int64)
        if kind == 2:
            out[y] = (line + above) % 256
            continue
        left, corner = np.zeros(4, dtype=np.int64), np.zeros(4, dtype=np.int64)
        for x in range(width):
            if kind == 4:
                p = left + above[x] - corner
                a, b, c = abs(p - left), abs(p - above[x]), abs(p - corner)
                guess = np.where((a <= b) & (a <= c), left, np.where(b <= c, above[x], corner))
            else:
                guess = [0, left, None, (left + above[x]) // 2][kind]
            out[y, x] = (line[x] + guess) % 256
            left, corner = out[y, x], above[x]
    return out


@pytest.mark.parametrize("kind, words, options", [
    ("coast", [], {}),
    ("solids", ["--clip", "x:0.4", "--view", "+x", "--metric", "scaled-jacobian"], dict(clip="x:0.4", view="+x", metric="scaled-jacobian")),
])
def test_pictures_are_the_program_s(tmp_path, kind, words, options):
    run("generate", kind, "-o", tmp_path / "mesh.vtk")
    told = subprocess.run([PROGRAM, "info"], check=True, capture_output=True, text=True).stdout
    if "opengl not usable" in told.lower():
        pytest.skip("no OpenGL here")
    mesh = dmoscope.read(tmp_path / "mesh.vtk")
    pixels = dmoscope.render(mesh, (240, 160), colour_bar=False, **options)
    assert pixels.shape == (160, 240, 4) and pixels.dtype == np.uint8
    assert len(np.unique(pixels.reshape(-1, 4), axis=0)) > 20
    # With its colour bar, it equals the program's picture but for the mesh's name.
    run("render", tmp_path / "mesh.vtk", "-o", tmp_path / "mesh.png", "--size", "240x160", *words)
    with_bar = dmoscope.render(mesh, (240, 160), **options)
    assert (with_bar != png(tmp_path / "mesh.png")).any(axis=2).mean() < 0.05
    with pytest.raises(ValueError, match="range"):
        dmoscope.render(mesh, range=(1, 0))
