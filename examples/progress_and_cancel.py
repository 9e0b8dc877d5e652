"""Smooth arrays, show how far that is, and end it when enough is reached."""

import numpy as np

import dmoscope

n = 200
x, y = np.meshgrid(np.arange(n + 1.0), np.arange(n + 1.0))
points = np.column_stack([x.ravel(), y.ravel()])
inside = (points > 0).all(axis=1) & (points < n).all(axis=1)
points[inside] += np.random.default_rng(7).uniform(-0.3, 0.3, (inside.sum(), 2))
a = (np.arange(n) + (n + 1) * np.arange(n)[:, None]).ravel()
triangles = np.concatenate([np.column_stack([a, a + 1, a + n + 2]), np.column_stack([a, a + n + 2, a + n + 1])])


def enough(iteration: dmoscope.Iteration) -> bool:
    print(f"iteration {iteration.number}: minimum {iteration.minimum:.4f}, {iteration.moved} moved")
    return iteration.minimum < 0.7  # False ends the run, as Ctrl+C does


mesh = dmoscope.Mesh(points, {"triangle": triangles})
result = dmoscope.smooth(mesh, 1000, callback=enough)
print(result.cancelled, result.iteration, result.mesh.points.shape)
assert result.cancelled and result.history["minimum"][-1] >= 0.7
