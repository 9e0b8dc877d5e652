"""compare_metrics.py MESH: smooth a mesh by two metrics, and judge each result by both."""

import sys

import dmoscope

metrics = ["mean-ratio", "min-angle"]


def judge(name: str, mesh: dmoscope.Mesh) -> None:
    print(f"{name:12}", *(f"{metric}: minimum {mesh.statistics(metric)['minimum']:.4f}, mean {mesh.statistics(metric)['mean']:.4f}" for metric in metrics),
          sep="  ")


mesh = dmoscope.read(sys.argv[1])
judge("input", mesh)
for metric in metrics:
    judge(metric, dmoscope.smooth(mesh, recipe="best", metric=metric).mesh)
