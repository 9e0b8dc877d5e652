#!/usr/bin/env python3
"""Wedges and pyramids, and their metrics in 50-digit arithmetic, for tests/cli/oracle_test.cpp: writes solids.vtk and solids.exact.csv here.

Written apart from the program, by the definitions: the matrix A of a corner is its edges' matrix times the inverse of that of the ideal
element's corner; mean ratio 3 det(A)^(2/3) / |A|^2, condition 3 / (|A| |A^-1|), both with the determinant's sign; scaled Jacobian the
determinant of the unit edges over that of the ideal corner's. Of an element the least of its corners (of a pyramid those of its base).
"""
from decimal import Decimal as D, getcontext
from pathlib import Path
import random

getcontext().prec = 60
half, zero, one = D(1) / 2, D(0), D(1)
ideal = {
    "wedge": [(zero, zero, zero), (one, zero, zero), (half, D(3).sqrt() / 2, zero),
              (zero, zero, one), (one, zero, one), (half, D(3).sqrt() / 2, one)],
    "pyramid": [(zero, zero, zero), (one, zero, zero), (one, one, zero), (zero, one, zero), (half, half, D(2).sqrt() / 2)],
}
corners = {
    "wedge": [(0, 1, 2, 3), (1, 2, 0, 4), (2, 0, 1, 5), (3, 5, 4, 0), (4, 3, 5, 1), (5, 4, 3, 2)],
    "pyramid": [(0, 1, 3, 4), (1, 2, 0, 4), (2, 3, 1, 4), (3, 0, 2, 4)],
}


def edges(p, corner):
    """Columns: the edges that leave the corner."""
    o, *ends = (p[i] for i in corner)
    return [[e[r] - o[r] for e in ends] for r in range(3)]


def det(m):
    return sum(m[0][i] * (m[1][(i + 1) % 3] * m[2][(i + 2) % 3] - m[1][(i + 2) % 3] * m[2][(i + 1) % 3]) for i in range(3))


def inverse(m):
    d = det(m)
    cofactor = lambda r, c: (m[(r + 1) % 3][(c + 1) % 3] * m[(r + 2) % 3][(c + 2) % 3]
                             - m[(r + 1) % 3][(c + 2) % 3] * m[(r + 2) % 3][(c + 1) % 3])
    return [[cofactor(c, r) / d for c in range(3)] for r in range(3)]


def times(a, b):
    return [[sum(a[r][k] * b[k][c] for k in range(3)) for c in range(3)] for r in range(3)]


def norm(m):
    return sum(x * x for row in m for x in row).sqrt()


def root(x, power):
    """|x|^power with the sign of x."""
    return zero if x == 0 else (abs(x).ln() * power).exp() * (1 if x > 0 else -1)


def unit_determinant(m):
    lengths = one
    for c in range(3):
        lengths *= sum(m[r][c] ** 2 for r in range(3)).sqrt()
    return det(m) / lengths


def values(kind, p):
    mean_ratio, scaled, condition = [], [], []
    for corner in corners[kind]:
        m, w = edges(p, corner), edges(ideal[kind], corner)
        a = times(m, inverse(w))
        d = det(a)
        mean_ratio.append(3 * root(d, D(2) / 3) / norm(a) ** 2)
        scaled.append(unit_determinant(m) / unit_determinant(w))
        condition.append(3 / (norm(a) * norm(inverse(a))) * (1 if d > 0 else -1))
    return min(mean_ratio), min(scaled), min(condition)


def solids():
    draw = random.Random(20180405)
    as_read = lambda p: [tuple(D(float(x)) for x in v) for v in p]  # rounded to the double that a program reads
    for kind in ideal:
        yield kind, as_read(ideal[kind])
        yield kind, as_read([(x * 1000000, y * 1000000, z * 1000000) for x, y, z in ideal[kind]])
        yield kind, as_read([(x, y, z / 100) for x, y, z in ideal[kind]])  # flat
        yield kind, as_read([(x, y, -z) for x, y, z in ideal[kind]])       # inside out
        yield kind, as_read([(x + 3 * z, y, z) for x, y, z in ideal[kind]])  # sheared
        for _ in range(100):
            size, noise = 10 ** draw.uniform(-3, 3), draw.uniform(0, 0.6)
            yield kind, as_read([tuple(D(size) * (c + D(draw.uniform(-noise, noise))) for c in v) for v in ideal[kind]])


def main():
    here = Path(__file__).parent
    points, cells, rows = [], [], ["cell,type,mean_ratio,scaled_jac,condition"]
    for kind, p in solids():
        cells.append((kind, range(len(points), len(points) + len(p))))
        points += p
        rows.append(",".join([str(len(cells) - 1), kind] + [f"{+v:.20g}" for v in values(kind, p)]))
    with open(here / "solids.vtk", "w") as f:
        f.write(f"# vtk DataFile Version 3.0\nwedges and pyramids by make_solids.py\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {len(points)} double\n")
        f.writelines(" ".join(repr(float(x)) for x in p) + "\n" for p in points)
        f.write(f"CELLS {len(cells)} {sum(len(c) + 1 for _, c in cells)}\n")
        # VTK winds a wedge the other way round than the definitions above.
        order = {"wedge": (0, 2, 1, 3, 5, 4), "pyramid": range(5)}
        f.writelines(f"{len(c)} " + " ".join(str(c[i]) for i in order[kind]) + "\n" for kind, c in cells)
        f.write(f"CELL_TYPES {len(cells)}\n")
        f.writelines({"wedge": "13\n", "pyramid": "14\n"}[kind] for kind, _ in cells)
    (here / "solids.exact.csv").write_text("\n".join(rows) + "\n")


if __name__ == "__main__":
    main()
