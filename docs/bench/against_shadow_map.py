#!/usr/bin/env python3
"""Cost of a graph without its view pass, as a ratio to shadow_map.ron at several map sizes, on the wgpu backend.

    cargo build --release
    docs/bench/against_shadow_map.py --scene builtin:torus-knot --scene scene.glb=views.json:overview

Each round runs the graph and every map size once more, interleaved, so that a slow minute of the machine hits all alike. A run is
one process: one warm-up frame, then --repeat frames whose per-node medians are summed. The ratio is the median over rounds.
"""
import argparse
import json
import statistics
import subprocess


def run(program, graph, scene, options, extra):
    spec, _, rest = scene.partition("=")
    words = [program, "render", graph, "--scene", spec, "--size", options.size, "--backend", options.backend]
    if rest:
        views, _, view = rest.rpartition(":")
        words += ["--views", views, "--view", view]
    words += ["--repeat", str(options.repeat), "--json", "--quiet", *extra]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise SystemExit(f"{' '.join(words)}\n{done.stderr}")
    record = json.loads(done.stdout)
    millis = {node["node"]: node["millis_spread"]["median"] for node in record["nodes"]}
    picture = {"view_samples", "shade", "bent_light"}
    return sum(cost for node, cost in millis.items() if node not in picture), record


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="target/release/shadowgraph")
    parser.add_argument("--graph", action="append", help="graphs to compare (default: hard)")
    parser.add_argument("--scene", action="append", required=True, help="builtin:NAME or FILE=VIEWS:VIEW; may repeat")
    parser.add_argument("--sizes", default="1024,2048,4096,8192")
    parser.add_argument("--size", default="512x512")
    parser.add_argument("--backend", default="wgpu")
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--repeat", type=int, default=5)
    options = parser.parse_args()
    sizes = [int(size) for size in options.sizes.split(",")]
    for scene in options.scene:
        ours = {graph: [] for graph in options.graph or ["hard"]}
        maps = {size: [] for size in sizes}
        for _ in range(options.rounds):
            for graph, times in ours.items():
                cost, record = run(options.program, graph, scene, options, [])
                times.append(cost)
            for size, times in maps.items():
                extra = ["--set", f"light_depth.size={size}"]
                times.append(run(options.program, "shadow_map", scene, options, extra)[0])
        print(f"{scene}: {record['scene']['triangles_count']} triangles, {options.size}, {record['device']['adapter']}")
        for graph, times in ours.items():
            print(f"  {graph:<12} {statistics.median(times):8.2f} ms ({min(times):.2f} to {max(times):.2f})")
            for size, against in maps.items():
                ratios = [our / map_cost for our, map_cost in zip(times, against)]
                middle = statistics.median(ratios)
                print(f"    against {size:>5}^2 {statistics.median(against):8.2f} ms: {middle:.2f}x ({min(ratios):.2f} to {max(ratios):.2f})")


if __name__ == "__main__":
    main()
