# SPDX-License-Identifier: MIT OR Apache-2.0
"""Other programs that make meshes of height maps, for `relief chart`.

Without a word on stdin's first line but {} it tells which are there, and their versions, as one line of JSON.
Otherwise: one line of JSON in (peer, width, height, goals), then 16-bit samples; for each goal one line of JSON out
(preparation, seconds, vertices, triangles, or error), then three doubles a vertex and three 32-bit numbers a triangle.
All of it is little-endian. x is the column, y the row, z the sample.
"""
import importlib.metadata
import json
import sys
from time import perf_counter


def delatin(np, samples, bound):
    from pydelatin import Delatin

    heights = samples.astype(np.float32)
    begun = perf_counter()
    mesh = Delatin(heights, max_error=bound)
    vertices, triangles = mesh.vertices, mesh.triangles
    seconds = perf_counter() - begun
    positions = np.array(vertices, dtype=np.float64).reshape(-1, 3)
    # Its rows count from the bottom.
    positions[:, 1] = samples.shape[0] - 1 - positions[:, 1]
    return 0.0, seconds, positions, triangles


def martini(np, samples, bound):
    from pymartini import Martini

    heights = samples.astype(np.float32)
    begun = perf_counter()
    tile = Martini(samples.shape[0]).create_tile(heights)
    prepared = perf_counter()
    vertices, triangles = tile.get_mesh(bound)
    ended = perf_counter()
    places = np.array(vertices).reshape(-1, 2).astype(np.int64)
    positions = np.column_stack([places, samples[places[:, 1], places[:, 0]]])
    return prepared - begun, ended - prepared, positions, triangles


def simplify(np, samples, goal):
    import meshoptimizer

    count = int(goal)
    height, width = samples.shape
    rows, columns = np.mgrid[0:height, 0:width]
    at = (rows[:-1, :-1] * width + columns[:-1, :-1]).ravel()
    cells = [at, at + 1, at + width + 1, at, at + width + 1, at + width]
    indices = np.stack(cells, 1).ravel().astype(np.uint32)
    # It weighs heights and places alike. A range of a sixteenth of the longer side served land best.
    scale = max(width, height) / 16 / max(int(samples.max()) - int(samples.min()), 1)
    places = np.stack([columns.ravel(), rows.ravel(), samples.ravel() * scale], 1).astype(np.float32)
    made = np.zeros_like(indices)
    begun = perf_counter()
    used = meshoptimizer.simplify(made, indices, places, target_index_count=3 * count, target_error=1e30)
    # In the order that it gives vertex caches.
    ordered = np.zeros(used, dtype=np.uint32)
    meshoptimizer.optimize_vertex_cache(ordered, np.ascontiguousarray(made[:used]), used, width * height)
    seconds = perf_counter() - begun
    # Vertices that are left, with their own heights.
    left, triangles = np.unique(ordered, return_inverse=True)
    positions = np.column_stack([columns.ravel()[left], rows.ravel()[left], samples.ravel()[left]])
    return 0.0, seconds, positions, triangles


PEERS = {"pydelatin": delatin, "pymartini": martini, "meshoptimizer": simplify}


def version(name):
    try:
        __import__(name)
        return importlib.metadata.version(name)
    except Exception:
        return None


def main():
    source, sink = sys.stdin.buffer, sys.stdout.buffer
    asked = json.loads(source.readline())
    if "peer" not in asked:
        sink.write(json.dumps({name: version(name) for name in PEERS}).encode() + b"\n")
        return
    import numpy as np

    size = asked["height"], asked["width"]
    samples = np.frombuffer(source.read(), dtype="<u2").reshape(size)
    for goal in asked["goals"]:
        try:
            preparation, seconds, positions, triangles = PEERS[asked["peer"]](np, samples, goal)
        except Exception as error:
            sink.write(json.dumps({"error": f"{type(error).__name__}: {error}"[:200]}).encode() + b"\n")
            continue
        positions = np.ascontiguousarray(positions, dtype="<f8").reshape(-1, 3)
        triangles = np.ascontiguousarray(triangles, dtype="<u4").reshape(-1, 3)
        head = dict(preparation=preparation, seconds=seconds, vertices=len(positions), triangles=len(triangles))
        sink.write(json.dumps(head).encode() + b"\n" + positions.tobytes() + triangles.tobytes())


main()
