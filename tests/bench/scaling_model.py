#!/usr/bin/env python3
"""What an iteration takes on a large machine, from what `mpirun -n P dmoscope bench` measures on a small one.

scaling_model.py [--plot FILE.svg]. The constants stand below with what they were measured by; the network's are assumptions.
"""
import argparse
import math

LATENCY = 2e-6  # seconds per message
BANDWIDTH = 10e9  # bytes per second, a rank's share of its node
LANES = 4  # sums of a stretch
STRETCH, GROUP = 1024, 1024  # elements of a stretch, stretches of a group: see core/quality/tally.h
# Measured (AMD EPYC, AVX2, one thread per rank): see docs/dev/performance.md.
KINDS = {
    # seconds per visit and per judged element, elements per vertex, classes, neighbours, sent vertices = surface * (vertices of a
    # rank)^power, imbalance
    "triangles": dict(visit=0.22e-6, judge=22e-9, elements=2, classes=8, neighbours=6, surface=2.5, power=1 / 2, imbalance=1.06),
    "tetrahedra": dict(visit=26e-6, judge=230e-9, elements=6, classes=12, neighbours=14, surface=2.4, power=2 / 3, imbalance=1.06),
}


def iteration(vertices, ranks, kind):
    """Seconds of an iteration by what they go into."""
    k = KINDS[kind]
    own = vertices / ranks
    sent = k["surface"] * own ** k["power"] if ranks > 1 else 0.0
    elements = k["elements"] * own
    groups = k["elements"] * vertices / STRETCH / GROUP
    messages = math.log2(ranks) if ranks > 1 else 0.0
    return {
        "visits": own * k["visit"] * (k["imbalance"] if ranks > 1 else 1.0),
        "elements judged": elements * k["judge"],
        "halo": (k["classes"] * k["neighbours"] * LATENCY if ranks > 1 else 0.0) + 24 * sent / BANDWIDTH,
        "mean": (2 * 8 * elements / BANDWIDTH if ranks > 1 else 0.0) + 8 * LANES * groups / BANDWIDTH + LANES * 1e-9 * groups + 5 * messages * LATENCY,
    }


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--plot", help="write a plot of the efficiency")
    plot = parser.parse_args().plot
    print("| mesh | ranks | an iteration | visits | elements judged | halo | mean | efficiency |\n|---|---:|---:|---:|---:|---:|---:|---:|")
    for kind in KINDS:
        for ranks in (1, 100, 1000, 10000, 100000):
            parts = iteration(1e9, ranks, kind)
            total, alone = sum(parts.values()), sum(iteration(1e9, 1, kind).values())
            cells = " | ".join("%.3g ms" % (1e3 * parts[p]) for p in ("visits", "elements judged", "halo", "mean"))
            print("| 10^9 vertices of %s | %s | %.4g ms | %s | %.0f %% |" % (kind, format(ranks, ","), 1e3 * total, cells, 100 * alone / ranks / total))
    if not plot:
        return
    import matplotlib

    matplotlib.use("svg")
    import matplotlib.pyplot as plt

    matplotlib.rcParams["svg.hashsalt"] = "dmoscope"
    figure, axes = plt.subplots(figsize=(7, 4))
    ranks = [10 ** (i / 8) for i in range(0, 41)]
    for kind, style in (("triangles", "-"), ("tetrahedra", "--")):
        for vertices, colour in ((1e7, "#2a78b8"), (1e8, "#d9822b"), (1e9, "#4c9a52")):
            alone = sum(iteration(vertices, 1, kind).values())
            axes.plot(ranks, [100 * alone / p / sum(iteration(vertices, p, kind).values()) for p in ranks], style, color=colour,
                      label="10$^%d$ vertices of %s" % (round(math.log10(vertices)), kind))
    axes.set_xscale("log")
    axes.set_xlabel("ranks")
    axes.set_ylabel("efficiency, % of one rank's speed")
    axes.set_ylim(0, 105)
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
    figure.tight_layout()
    figure.savefig(plot, metadata={"Date": None})


if __name__ == "__main__":
    main()
