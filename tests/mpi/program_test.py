"""dmoscope under mpirun: the same files as by one process, and what happens when a rank, a disk or a file fails.

Arguments: the folder of the programs. Needs mpirun; ranks share this machine's processors.
"""
import json
import os
import pathlib
import resource
import shutil
import signal
import struct
import subprocess
import sys
import tempfile
import time
import unittest

BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
DMOSCOPE = BUILD / "dmoscope"
SHARED = pathlib.Path(__file__).resolve().parents[3] / "shared" / "meshes"
ENVIRONMENT = dict(
    os.environ,
    OMPI_ALLOW_RUN_AS_ROOT="1",
    OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
    OMPI_MCA_rmaps_base_oversubscribe="1",
    OMPI_MCA_mpi_yield_when_idle="1",
    OMPI_MCA_btl_vader_single_copy_mechanism="none",
)


def command(ranks, *words, program=DMOSCOPE):
    return ["mpirun", "--bind-to", "none", "-n", str(ranks), str(program), *map(str, words)]


def mpirun(ranks, *words, program=DMOSCOPE, timeout=240, **options):
    return subprocess.run(command(ranks, *words, program=program), env=ENVIRONMENT, capture_output=True, text=True, timeout=timeout, **options)


def alone(*words, code=0):
    done = subprocess.run([str(DMOSCOPE), *map(str, words)], capture_output=True, text=True, timeout=240)
    assert done.returncode == code, done.stderr
    return done


def raw_vtu(points, cells, types, point_data=(), cell_data=(), scalar="Float64"):
    """A VTU file with raw appended data: lists of numbers in, bytes out."""
    arrays, blob, offset = {}, b"", 0

    def add(section, name, kind, values, components=1):
        nonlocal blob, offset
        code = {"Float64": "d", "Float32": "f", "Int64": "q", "UInt8": "B", "Int32": "i"}[kind]
        data = struct.pack("<%d%s" % (len(values), code), *values)
        arrays.setdefault(section, "")
        arrays[section] += '<DataArray type="%s" Name="%s" NumberOfComponents="%d" format="appended" offset="%d"/>\n' % (kind, name, components, offset)
        blob += struct.pack("<Q", len(data)) + data
        offset = len(blob)

    for name, values in point_data:
        add("PointData", name, "Float64", values)
    for name, values in cell_data:
        add("CellData", name, "Int32", values)
    add("Points", "Points", scalar, [x for p in points for x in p], 3)
    ends, end = [], 0
    for cell in cells:
        end += len(cell)
        ends.append(end)
    add("Cells", "connectivity", "Int64", [v for cell in cells for v in cell])
    add("Cells", "offsets", "Int64", ends)
    add("Cells", "types", "UInt8", types)
    xml = '<?xml version="1.0"?>\n<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64">\n<UnstructuredGrid>\n'
    xml += '<Piece NumberOfPoints="%d" NumberOfCells="%d">\n' % (len(points), len(cells))
    for section in ("PointData", "CellData", "Points", "Cells"):
        xml += "<%s>\n%s</%s>\n" % (section, arrays.get(section, ""), section)
    xml += '</Piece>\n</UnstructuredGrid>\n<AppendedData encoding="raw">\n_'
    return xml.encode() + blob + b"\n</AppendedData>\n</VTKFile>\n"


def read_obj(path):
    points, faces = [], []
    for line in pathlib.Path(path).read_text().splitlines():
        words = line.split()
        if words and words[0] == "v":
            points.append(tuple(float(w) for w in words[1:4]))
        if words and words[0] == "f":
            faces.append([int(w) - 1 for w in words[1:]])
    return points, faces


class Case(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="dmoscope-mpi-"))
        self.addCleanup(shutil.rmtree, self.folder, True)

    def make(self, name, kind="coast", size=400, seed=1):
        path = self.folder / name
        alone("generate", kind, "--size", size, "--seed", seed, "-o", path)
        return path

    def vtu(self, name, kind="coast", size=400, scalar="Float64"):
        """A raw VTU file of a generated mesh, in two materials."""
        points, faces = read_obj(self.make("for_vtu.obj", kind, size))
        middle = sum(p[0] for p in points) / len(points)
        materials = [1 if points[f[0]][0] < middle else 2 for f in faces]
        path = self.folder / name
        path.write_bytes(raw_vtu(points, faces, [5 if len(f) == 3 else 9 for f in faces], [("depth", [p[1] for p in points])],
                                 [("material", materials)], scalar))
        return path

    def same_as_alone(self, mesh, options=(), ranks=(1, 2, 3), partitions=("hilbert",), threads=(1,)):
        want = self.folder / ("want" + mesh.suffix)
        options = (*options, "--fields", "carry")  # the default of several ranks
        alone_only = ("--geographic", "off")  # ranks take coordinates unprojected
        code = subprocess.run([str(DMOSCOPE), "smooth", str(mesh), "-o", str(want), *map(str, options), *alone_only],
                              capture_output=True, timeout=240).returncode
        self.assertIn(code, (0, 1))
        for n in ranks:
            for partition in partitions:
                for each in threads:
                    got = self.folder / ("got" + mesh.suffix)
                    done = mpirun(n, "smooth", mesh, "-o", got, "--partition", partition, "--threads", each, *options)
                    self.assertEqual(done.returncode, code, done.stderr)
                    self.assertEqual(got.read_bytes(), want.read_bytes(), f"{mesh.name}, {n} ranks, {partition}, {each} threads")
                    got.unlink()


    def pieces_same_as_alone(self, mesh, options, ranks):
        """By way of PVTU: pieces smoothed by many are what all of them smoothed by one are."""
        alone("convert", mesh, self.folder / "m.pvtu", "--pieces", 3)
        options = (*options, "--fields", "carry")
        code = subprocess.run([str(DMOSCOPE), "smooth", str(self.folder / "m.pvtu"), "-o", str(self.folder / "want.pvtu"), *map(str, options)],
                              capture_output=True, timeout=240).returncode
        alone("convert", self.folder / "want.pvtu", self.folder / "want.vtk")
        for n in ranks:
            done = mpirun(n, "smooth", self.folder / "m.pvtu", "-o", self.folder / "got.pvtu", *options)
            self.assertEqual(done.returncode, code, done.stderr)
            alone("convert", self.folder / "got.pvtu", self.folder / "got.vtk")
            self.assertEqual((self.folder / "got.vtk").read_bytes(), (self.folder / "want.vtk").read_bytes(), f"{mesh.name}, {n} ranks")


class SameBytes(Case):
    def test_formats(self):
        for name in ("a.obj", "a.off", "a.14"):
            self.same_as_alone(self.make(name), ("--iterations", 5))

    def test_quadrilaterals_and_mixed(self):
        for kind in ("quads", "mixed", "tangled"):
            self.same_as_alone(self.make(kind + ".obj", kind, 300), ("--iterations", 5), ranks=(2, 4))

    def test_quadrilaterals_with_a_corner_twice(self):
        mesh = self.make("a.14", "coast", 400)
        lines = mesh.read_text().splitlines()
        cells, points = map(int, lines[1].split()[:2])
        for i in range(2 + points, 2 + points + cells, 2):
            number, _, a, b, c = lines[i].split()[:5]
            lines[i] = f"{number} 4 {a} {b} {c} {c}"
        mesh.write_text("\n".join(lines) + "\n")
        self.same_as_alone(mesh, ("--iterations", 5), ranks=(1, 3))
        told = mpirun(3, "smooth", mesh, "-o", self.folder / "told.14", "--iterations", 1)
        self.assertIn(f"{(cells + 1) // 2} quadrilaterals that have corners twice are taken as the triangles that they are", told.stderr.replace(",", ""))

    def test_partitions_threads_and_many_ranks(self):
        mesh = self.make("a.14", "coast", 900)
        parts = self.folder / "parts"
        count = int(mesh.read_text().splitlines()[1].split()[1])
        parts.write_text("".join("%d\n" % ((7 * v) % 5) for v in range(count)))
        self.same_as_alone(mesh, ("--iterations", 4), (3, 7), ("hilbert", "block", f"file:{parts}"), (1, 2))

    def test_until_converged_then_mean(self):
        self.same_as_alone(self.make("a.off", "random", 300), ("--until-converged", "--patience", 10, "--then", "mean"), ranks=(3,))

    def test_vtu_with_materials(self):
        for scalar in ("Float64", "Float32"):
            mesh = self.vtu("m.vtu", "random", 400, scalar)
            self.same_as_alone(mesh, ("--iterations", 5), ranks=(1, 3))
            self.same_as_alone(mesh, ("--iterations", 3, "--interfaces", "free"), ranks=(2,))

    def test_fixed_vertices(self):
        mesh = self.vtu("m.vtu", "random", 300)
        for words in (("--fix", "50-90,7"), ("--fix", "box:0.2,0.2,0.6,0.7"), ("--fix", "material=2")):
            self.same_as_alone(mesh, ("--iterations", 3, *words), ranks=(3,))

    def test_text_as_people_write_it(self):
        """Comments, blank lines, Windows line ends, joined lines, indices that count back, weights."""
        points, faces = read_obj(self.make("plain.obj", "grid", 60))
        lines = ["# a comment", ""]
        for i, (x, y, z) in enumerate(points):
            lines.append(f"v {x} \\\n  {y} {z}" if i % 3 == 0 else f"v   {x}\t{y} {z} 1.0")
            if i % 7 == 0:
                lines += ["", "# more"]
        for i, face in enumerate(faces):
            lines.append("f " + " ".join(str(v + 1) if i % 2 else str(v - len(points)) for v in face))
        mesh = self.folder / "people.obj"
        mesh.write_bytes("\r\n".join(lines).encode() + b"\r\n")
        self.same_as_alone(mesh, ("--iterations", 4), ranks=(1, 2, 5))
        off = self.folder / "people.off"
        off.write_text("# head\nOFF # word\n\n%d %d 0\n" % (len(points), len(faces)) + "".join("%r %r %r # v\n\n" % p for p in points)
                       + "".join("3 %d %d %d 255 0 0\n" % tuple(f) for f in faces) + "trailing words\n")
        self.same_as_alone(off, ("--iterations", 4), ranks=(2, 5))

    def test_fort14_with_other_numbers_and_strings(self):
        points, faces = read_obj(self.make("plain.obj", "grid", 80))
        number = [3 * i + 11 for i in range(len(points))]
        text = "title\n%d %d\n" % (len(faces), len(points))
        text += "".join("%d %r %r 5.5\n" % (number[i], p[0], p[1]) for i, p in enumerate(points))
        text += "".join("%d 3 %d %d %d\n" % (i + 1, *(number[v] for v in f)) for i, f in enumerate(faces))
        text += "1 = open\n2 = total\n2\n%d\n%d\n1\n3\n3 24\n%d %d 1. 1. 1.\n%d %d 1. 1. 1.\n%d %d 1. 1. 1.\n" % (
            number[0], number[1], number[40], number[41], number[42], number[43], number[44], number[45])
        mesh = self.folder / "n.14"
        mesh.write_text(text)
        self.same_as_alone(mesh, ("--iterations", 4), ranks=(1, 3))
        self.same_as_alone(mesh, ("--iterations", 4, "--interfaces", "free"), ranks=(2,))

    def test_that_fields_are_carried_is_said(self):
        mesh = self.make("a.14")
        done = mpirun(2, "smooth", mesh, "-o", self.folder / "o.14", "--json")
        self.assertIn("depth is carried with the vertices", done.stderr)
        self.assertEqual(json.loads(done.stdout)["fields"]["carried"], ["depth"])
        self.assertNotIn("carried", mpirun(2, "smooth", mesh, "-o", self.folder / "p.14", "--fields", "carry").stderr)
        self.assertEqual((self.folder / "o.14").read_bytes(), (self.folder / "p.14").read_bytes())
        self.assertIn("depth is carried", mpirun(2, "smooth", self.vtu("m.vtu"), "-o", self.folder / "q.vtu").stderr)
        self.assertNotIn("carried", mpirun(2, "smooth", self.make("a.obj"), "-o", self.folder / "o.obj").stderr)

    def test_shared_meshes(self):
        if not SHARED.is_dir():
            self.skipTest("the folder of shared meshes is not here")
        self.same_as_alone(SHARED / "ocean/east.14", ("--iterations", 4), ranks=(3, 7), threads=(1, 2))
        for name in ("mixed2d/overt_hyb_1.vtk", "tet/tire.vtk", "mixed3d/mixed-hex-pyr-tet.vtk", "tri/tangled_tri.vtk"):
            self.pieces_same_as_alone(SHARED / name, ("--iterations", 4), (3, 7))

    def test_quality(self):
        mesh = self.make("a.14", "mixed", 500)
        want = json.loads(alone("quality", mesh, "--json", "--worst", 4).stdout)
        for n in (1, 3):
            got = json.loads(mpirun(n, "quality", mesh, "--json", "--worst", 4).stdout)
            for key in ("vertices", "elements", "inverted", "metrics"):
                self.assertEqual(got[key], want[key], key)

    def test_stats_and_json(self):
        mesh = self.make("a.obj", "random", 300)
        alone("smooth", mesh, "-o", self.folder / "w.obj", "--stats", self.folder / "w.csv", "--iterations", 4)
        done = mpirun(3, "smooth", mesh, "-o", self.folder / "g.obj", "--stats", self.folder / "g.csv", "--iterations", 4, "--json")
        report = json.loads(done.stdout)
        self.assertEqual((report["ranks"], report["iterations"]), (3, 4))

        def without_seconds(path):
            return [line.split(",")[:6] + line.split(",")[7:] for line in path.read_text().splitlines()]

        self.assertEqual(without_seconds(self.folder / "g.csv"), without_seconds(self.folder / "w.csv"))


class Pieces(Case):
    def test_materials_with_fewer_pieces_than_ranks(self):
        self.pieces_same_as_alone(self.vtu("m.vtu", "random", 400), ("--iterations", 4), (2, 5))
        self.pieces_same_as_alone(self.vtu("m.vtu", "random", 400), ("--iterations", 4, "--fix", "material=2", "--interfaces", "free"), (5,))

    def test_pieces_that_were_read_stay(self):
        alone("convert", self.make("a.obj"), self.folder / "a.pvtu", "--pieces", 2)
        shutil.copy(self.folder / "a.pvtu", self.folder / "old.pvtu")
        before = (self.folder / "a_0.vtu").read_bytes()
        done = mpirun(2, "smooth", self.folder / "old.pvtu", "-o", self.folder / "a.pvtu")
        self.assertEqual(done.returncode, 2)
        self.assertIn("which would be overwritten", done.stderr)
        self.assertEqual((self.folder / "a_0.vtu").read_bytes(), before)
        done = mpirun(2, "smooth", self.folder / "a.pvtu", "-o", self.folder / "a.pvtu", "--iterations", 3)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertNotEqual((self.folder / "a_0.vtu").read_bytes(), before)

    def test_there_and_back(self):
        mesh = self.make("a.obj", "mixed", 500)
        alone("convert", mesh, self.folder / "a.pvtu", "--pieces", 5)
        self.assertTrue((self.folder / "a_4.vtu").exists())
        alone("convert", self.folder / "a.pvtu", self.folder / "back.obj")
        points, faces = read_obj(mesh)
        self.assertEqual(read_obj(self.folder / "back.obj"), (points, faces))
        alone("smooth", mesh, "-o", self.folder / "want.obj", "--iterations", 5)
        for n in (1, 2, 3, 7):
            done = mpirun(n, "smooth", self.folder / "a.pvtu", "-o", self.folder / "s.pvtu", "--iterations", 5)
            self.assertEqual(done.returncode, 0, done.stderr)
            alone("convert", self.folder / "s.pvtu", self.folder / "s.obj")
            self.assertEqual(read_obj(self.folder / "s.obj"), read_obj(self.folder / "want.obj"), n)

    def test_without_ids_and_with_all_fields(self):
        """Pieces that share the vertices on their seam by their places; fields that no rank reads stay."""
        points, faces = read_obj(self.make("a.obj", "random", 300))
        middle = sorted(p[0] for p in points)[len(points) // 2]
        names, order = [], []
        for side in (0, 1):
            mine = [f for f in faces if (points[f[0]][0] < middle) == (side == 0)]
            used = sorted({v for f in mine for v in f})
            place = {v: i for i, v in enumerate(used)}
            order += [v for v in used if v not in order]
            name = "part_%d.vtu" % side
            (self.folder / name).write_bytes(raw_vtu([points[v] for v in used], [[place[v] for v in f] for f in mine], [5] * len(mine),
                                                     [("temperature", [points[v][0] ** 2 for v in used])]))
            names.append(name)
        pvtu = self.folder / "parts.pvtu"
        pvtu.write_text('<?xml version="1.0"?>\n<VTKFile type="PUnstructuredGrid">\n<PUnstructuredGrid>\n'
                        + "".join('<Piece Source="%s"/>\n' % n for n in names) + "</PUnstructuredGrid>\n</VTKFile>\n")
        alone("smooth", pvtu, "-o", self.folder / "want.obj", "--iterations", 5)
        before = (self.folder / "part_0.vtu").read_bytes()
        for n in (1, 2, 3):
            done = mpirun(n, "smooth", pvtu, "-o", self.folder / "s.pvtu", "--iterations", 5, "--partition", "hilbert")
            self.assertEqual(done.returncode, 0, done.stderr)
            alone("convert", self.folder / "s.pvtu", self.folder / "s.obj")
            self.assertEqual(read_obj(self.folder / "s.obj")[0], read_obj(self.folder / "want.obj")[0])
            after = (self.folder / "s_0.vtu").read_bytes()
            self.assertEqual(len(after), len(before))
            begin = before.index(b"_") + 1
            self.assertEqual(after[begin : begin + 8 * 40], before[begin : begin + 8 * 40])  # the temperatures are first

    def test_pieces_that_disagree(self):
        mesh = self.make("a.obj", "grid", 60)
        alone("convert", mesh, self.folder / "a.pvtu", "--pieces", 2)
        points, faces = read_obj(mesh)
        half = len(faces) // 2
        for side, mine in enumerate((faces[:half], faces[half:])):
            used = sorted({v for f in mine for v in f})
            place = {v: i for i, v in enumerate(used)}
            moved = [(x + (0.01 if side else 0.0), y, z) for x, y, z in (points[v] for v in used)]
            (self.folder / ("a_%d.vtu" % side)).write_bytes(raw_vtu(moved, [[place[v] for v in f] for f in mine], [5] * len(mine),
                                                                    [("GlobalNodeIds", [float(v) for v in used])]))
        for done in (mpirun(2, "smooth", self.folder / "a.pvtu", "-o", self.folder / "s.pvtu"),
                     subprocess.run([str(DMOSCOPE), "quality", str(self.folder / "a.pvtu")], capture_output=True, text=True)):
            self.assertEqual(done.returncode, 3)
            self.assertIn("pieces disagree on where vertex", done.stderr)
        self.assertFalse((self.folder / "s.pvtu").exists())


class Failures(Case):
    def refused(self, done, code, *words):
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_what_ranks_do_not_do(self):
        mesh = self.make("a.obj")
        out = self.folder / "o.obj"
        for options, word in ((("--method", "joint"), "joint moves"), (("--boundary", "slide"), "slide"), (("--order", "shuffle:3"), "order"),
                              (("--backend", "cuda"), "device"), (("--partition", "sideways"), "hilbert"), (("--fix", "box:9,9,9.5,9.5"), "box")):
            self.refused(mpirun(2, "smooth", mesh, "-o", out, *options), 2, word)
        self.refused(mpirun(2, "smooth", mesh, "-o", self.folder / "o.off"), 2, "convert")
        self.refused(mpirun(2, "smooth", self.make("a.msh"), "-o", self.folder / "o.msh"), 2, ".pvtu")
        self.refused(mpirun(2, "smooth", self.make("can.obj", "can"), "-o", out), 3, "curved surface")
        self.refused(mpirun(2, "smooth", self.make("w.14", "wrapped"), "-o", self.folder / "o.14"), 3, "180 degrees")
        self.refused(mpirun(2, "render", mesh, "-o", "x.png"), 2, "render")
        self.assertFalse(out.exists())

    def test_files_that_are_wrong(self):
        lines = self.make("a.obj", "grid", 300).read_text().splitlines()
        out = self.folder / "o.obj"
        out.write_text("before")
        broken = self.folder / "broken.obj"
        last = max(i for i, line in enumerate(lines) if line.startswith("f"))
        for i, line, word in ((120, "v 1 2 three", "z coordinate"), (last, "f 1 2 99999", "out of range"), (last, "f 1 2", "2 corners")):
            broken.write_text("\n".join(lines[:i] + [line] + lines[i + 1 :]) + "\n")
            self.refused(mpirun(3, "smooth", broken, "-o", out), 3, word, f"broken.obj:{i + 1}:", "rank ")
        fort = self.make("a.14", "grid", 200)
        fort.write_text("\n".join(fort.read_text().splitlines()[:150]) + "\n")
        self.refused(mpirun(3, "smooth", fort, "-o", self.folder / "o.14"), 3, "the file ends before")
        vtu = self.vtu("a.vtu")
        vtu.write_bytes(vtu.read_bytes()[:-3000])
        self.refused(mpirun(3, "smooth", vtu, "-o", self.folder / "o.vtu"), 3, "a.vtu")
        alone("convert", self.make("b.obj"), self.folder / "packed.vtu")
        self.refused(mpirun(2, "smooth", self.folder / "packed.vtu", "-o", self.folder / "o.vtu"), 3, "raw appended data")
        alone("convert", self.make("b.obj"), self.folder / "p.pvtu", "--pieces", 3)
        (self.folder / "p_1.vtu").unlink()
        self.refused(mpirun(2, "smooth", self.folder / "p.pvtu", "-o", self.folder / "o.pvtu"), 3, "p_1.vtu")
        self.refused(mpirun(2, "smooth", self.folder / "none.obj", "-o", out), 3, "none.obj")
        self.assertEqual(out.read_text(), "before")
        self.assertFalse(any(self.folder.glob(".dmoscope-*")))

    def test_full_disk(self):
        """A limit on the size of files stands for it: where room is asked for (the first rank), and where it is written (another)."""
        mesh = self.make("a.obj", "grid", 60000)
        out = self.folder / "o.obj"
        for which in (0, 2):
            out.write_text("before")
            job = subprocess.Popen(command(3, "smooth", mesh, "-o", out, "--iterations", 200), env=ENVIRONMENT, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE, text=True)
            self.addCleanup(job.kill)
            self.wait_for("reading", job)
            self.has_read = False
            for rank in self.children(job):
                number = pathlib.Path(f"/proc/{rank}/environ").read_bytes().split(b"OMPI_COMM_WORLD_RANK=")[1].split(b"\0")[0]
                if int(number) == which:
                    resource.prlimit(rank, resource.RLIMIT_FSIZE, (100_000, 100_000))
            errors = job.communicate(timeout=120)[1]
            self.assertEqual(job.returncode, 3, errors)
            self.assertIn(f"rank {which}: {out}: ", errors)
            self.assertEqual(out.read_text(), "before")
            self.assertFalse(any(self.folder.glob(".dmoscope-*")))

    def test_killed_ranks(self):
        """While it reads, smooths and writes: mpirun ends soon, and the old output stands."""
        mesh = self.make("a.obj", "grid", 150000)
        out = self.folder / "o.obj"
        for when in ("reading", "smoothing", "writing"):
            out.write_text("before")
            iterations = 1 if when == "writing" else 100000
            job = subprocess.Popen(command(3, "smooth", mesh, "-o", out, "--iterations", iterations), env=ENVIRONMENT, stdout=subprocess.DEVNULL,
                                   stderr=subprocess.DEVNULL)
            self.addCleanup(job.kill)
            rank = self.wait_for(when, job)
            os.kill(rank, signal.SIGKILL)
            begin = time.monotonic()
            self.assertNotEqual(job.wait(timeout=60), 0)
            print(f"killed while {when}: mpirun ended after {time.monotonic() - begin:.1f} s")
            self.assertEqual(out.read_text(), "before")

    @staticmethod
    def children(job):
        return [int(p) for p in pathlib.Path(f"/proc/{job.pid}/task/{job.pid}/children").read_text().split()]

    def wait_for(self, when, job):
        """A rank, once it is there."""
        for _ in range(20000):
            ranks = self.children(job)
            if len(ranks) == 3:
                rank = ranks[1]
                try:
                    files = {os.readlink(f"/proc/{rank}/fd/{fd}") for fd in os.listdir(f"/proc/{rank}/fd")}
                except OSError:
                    files = set()
                reads = any(f.endswith("/a.obj") for f in files)
                self.has_read = getattr(self, "has_read", False) or reads
                if when == "reading" and reads:
                    return rank
                if when == "smoothing" and self.has_read and not reads:
                    time.sleep(3)
                    self.has_read = False
                    return rank
                if when == "writing" and any(".dmoscope-" in f for f in files):
                    return rank
            if job.poll() is not None:
                self.fail(f"ended before it was {when}")
            time.sleep(0.001)
        self.fail(f"never {when}")

    def test_the_desktop_program_needs_no_mpi(self):
        libraries = subprocess.run(["ldd", str(DMOSCOPE)], capture_output=True, text=True).stdout
        self.assertIn("libc.so", libraries)
        self.assertNotIn("mpi", libraries)

    def test_a_build_without_mpi_refuses(self):
        lonely = self.folder / "dmoscope"
        shutil.copy(DMOSCOPE, lonely)
        mesh = self.make("a.obj")
        done = mpirun(2, "smooth", mesh, "-o", self.folder / "o.obj", program=lonely)
        self.refused(done, 2, "dmoscope-mpi")
        self.assertEqual(done.stderr.count("processes of dmoscope were started together"), 1)
        self.assertFalse((self.folder / "o.obj").exists())


if __name__ == "__main__":
    unittest.main(verbosity=2)
