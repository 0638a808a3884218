#!/usr/bin/env python3
"""Cost of soft shadows against triangles, light radius and light samples: the tables of Sintorn 2008, Figures 11 to 13.

    cargo build --release
    docs/bench/soft_tables.py --graph soft_shafts --graph soft --backend cpu

All on builtin:torus-knot, a closed two-manifold above its receiver, of growing tessellation. Times are those of the nodes after the
view pass and before shading, medians of --rounds processes that run --repeat frames after a warm-up; graphs take turns within a round, so that a
slow minute of the machine hits all alike. The last column of each table is the ratio to the first row.
"""
import argparse
import json
import statistics
import subprocess

PICTURE = {"view_samples", "sample_filter", "shade", "bent_light"}


def cost(options, graph, scene, samples, radius):
    words = [options.program, "render", graph, "--scene", scene, "--size", options.size, "--backend", options.backend]
    words += ["--light-samples", str(samples), "--repeat", str(options.repeat), "--json", "--quiet"]
    words += ["--light-radius", str(radius)] if radius else []
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(words)}\n{done.stderr}")
    record = json.loads(done.stdout)
    millis = sum(node["millis_spread"]["median"] for node in record["nodes"] if node["node"] not in PICTURE)
    return millis, record["scene"]["triangles_count"]


def table(options, title, rows):
    """Rows are (label, scene, samples, radius)."""
    times = {(graph, label): [] for label, *_ in rows for graph in options.graph}
    triangles = {}
    for _ in range(options.rounds):
        for label, scene, samples, radius in rows:
            for graph in options.graph:
                millis, triangles[label] = cost(options, graph, scene, samples, radius)
                times[graph, label].append(millis)
    print(f"\n{title}")
    for graph in options.graph:
        print(f"  {graph}")
        first = statistics.median(times[graph, rows[0][0]])
        for label, *_ in rows:
            spread = times[graph, label]
            middle = statistics.median(spread)
            print(f"    {label:<16} {triangles[label]:>8} triangles {middle:9.1f} ms ({min(spread):.1f} to {max(spread):.1f}) {middle / first:6.2f}x")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="target/release/shadowgraph")
    parser.add_argument("--graph", action="append", help="graphs to measure (default: soft)")
    parser.add_argument("--backend", default="cpu")
    parser.add_argument("--size", default="512x512")
    parser.add_argument("--radius", type=float, default=0.5, help="light radius where it is not what varies, scene units")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--repeat", type=int, default=3)
    options = parser.parse_args()
    options.graph = options.graph or ["soft"]
    knot = lambda segments: f"builtin:torus-knot?segments={segments}&sides={segments // 16}"
    print(f"{options.backend}, {options.size}, {options.rounds} rounds of {options.repeat} frames")
    sizes = [64, 128, 256, 512, 1024, 2048]
    table(options, "Triangles (Figure 11), 128 samples", [(f"{size} segments", knot(size), 128, options.radius) for size in sizes])
    radii = [0.5, 1.0, 2.0, 3.0, 4.0]
    table(options, "Light radius (Figure 12), 128 samples", [(f"radius {options.radius * radius:g}", knot(256), 128, options.radius * radius) for radius in radii])
    counts = [128, 256, 512, 1024]
    table(options, "Light samples (Figure 13)", [(f"{count} samples", knot(256), count, options.radius) for count in counts])


if __name__ == "__main__":
    main()
