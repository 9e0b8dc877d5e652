"""A coarse mesh of a sphere whose vertices slide on a fine mesh of it; both are arrays."""

import numpy as np

import dmoscope


def sphere(n: int, off: float) -> dmoscope.Mesh:
    """n x n quadrilaterals on each side of a cube, put on the sphere of radius 1, where vertices are out of place by up to `off` cells."""
    squares = []
    grid = np.linspace(-1.0, 1.0, n + 1)
    for axis in range(3):
        for side in (-1.0, 1.0):
            for u0, u1 in zip(grid, grid[1:]):
                for v0, v1 in zip(grid, grid[1:]):
                    square = np.array([[side, u0, v0], [side, u1, v0], [side, u1, v1], [side, u0, v1]])
                    squares.append(np.roll(square if side > 0 else square[::-1], axis, axis=1))
    points, corners = np.unique(np.round(np.concatenate(squares), 9), axis=0, return_inverse=True)
    points = np.tan(np.pi / 4 * points) + off / n * np.random.default_rng(1).uniform(-1, 1, points.shape)
    return dmoscope.Mesh(points / np.linalg.norm(points, axis=1)[:, None], {"quad": corners.reshape(-1, 4)})


def distance(mesh: dmoscope.Mesh) -> float:
    return float(np.abs(np.linalg.norm(mesh.points, axis=1) - 1.0).max())


mesh = sphere(8, 0.5)
options = dict(until_converged=True, max_deviation=0.02, feature_angle=90.0)
alone = dmoscope.smooth(mesh, **options).mesh
on_fine = dmoscope.smooth(mesh, surface=sphere(32, 0.0), **options).mesh
print(*(f"minimum {one.statistics()['minimum']:.4f}, distance from the sphere {distance(one):.5f}" for one in (mesh, alone, on_fine)), sep="\n")
assert distance(on_fine) < distance(alone)
