#!/usr/bin/env python3
"""Compares a move of this program's membrane with OpenCV's seamlessClone (NORMAL_CLONE), in one run, on one core.

    tests/bench/opencv_seamless.py [--program build/release/bin/oversketch-cli] [--runs 5] [--json FILE] [SIZE ...]

SIZE is 65k, 262k, 1m or 4m (default: the first three).  Needs OpenCV's Python module (Debian: python3-opencv), which
nothing else here needs.  OpenCV solves on the whole box round the mask by a discrete sine transform; the box is given a
size that this transform is fast for.  Its equation is another one (the box's edge is the boundary), so only times are
compared.
"""

import argparse
import json
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

PIXELS = {"65k": 65_536, "262k": 262_144, "1m": 1_048_576, "4m": 4_194_304}


def make_mask(cv2, np, pixels):
    """The benchmark's smooth shape, stretched to a box that the transform likes."""
    turn = np.linspace(0, 2 * np.pi, 400, endpoint=False)
    radius = 1 + 0.18 * np.cos(2 * turn + 1) + 0.14 * np.sin(3 * turn) + 0.08 * np.cos(5 * turn)
    shape = np.stack([radius * np.cos(turn), radius * np.sin(turn)], axis=1)
    area = 0.5 * abs(np.sum(shape[:, 0] * np.roll(shape[:, 1], -1) - shape[:, 1] * np.roll(shape[:, 0], -1)))
    spans = np.ptp(shape, axis=0) * np.sqrt(pixels / area)
    # The transform of a box of n rows has 2 (n - 1) of them.
    spans = [cv2.getOptimalDFTSize(2 * (int(round(span)) - 1)) // 2 + 1 for span in spans]
    low, high = shape.min(axis=0), shape.max(axis=0)
    points = (shape - low) / (high - low) * (np.array(spans) - 1)
    mask = np.zeros((spans[1] + 2, spans[0] + 2), np.uint8)
    cv2.fillPoly(mask, [np.round(points + 1).astype(np.int32)], 255)
    return mask


def make_picture(np, shape, seed):
    random = np.random.default_rng(seed)
    y, x = np.mgrid[0 : shape[0], 0 : shape[1]]
    base = 128 + 40 * np.sin(0.03 * x + seed) * np.cos(0.02 * y)
    return np.clip(base[..., None] + random.uniform(-5, 5, (*shape, 3)), 0, 255).astype(np.uint8)


def time_opencv(cv2, np, pixels, runs):
    mask = make_mask(cv2, np, pixels)
    source = make_picture(np, mask.shape, 1)
    target = make_picture(np, (mask.shape[0] + 64, mask.shape[1] + 64), 2)
    center = (target.shape[1] // 2, target.shape[0] // 2)
    times = []
    for run in range(runs + 1):
        start = time.process_time()
        cv2.seamlessClone(source, target, mask, center, cv2.NORMAL_CLONE)
        if run > 0:
            times.append(1e3 * (time.process_time() - start))
    return statistics.median(times), int(np.count_nonzero(mask))


def time_ours(program, size, runs):
    row = f"clone.membrane.{size}.blob.move.k2"
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder) / "bench.json"
        subprocess.run([program, "bench", row, "--runs", str(runs), "--json", report], check=True, stdout=subprocess.DEVNULL)
        rows = json.loads(report.read_text())["benchmarks"]
    return next(entry["median"] for entry in rows if entry["name"] == row)


def main():
    project = Path(__file__).resolve().parents[2]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("sizes", nargs="*", choices=[*PIXELS, []], default=["65k", "262k", "1m"], metavar="SIZE")
    parser.add_argument("--program", default=project / "build/release/bin/oversketch-cli")
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("--json", type=Path, help="write the numbers as JSON")
    options = parser.parse_args()
    try:
        import cv2
        import numpy as np
    except ImportError:
        sys.exit("OpenCV's Python module is missing: sudo apt-get install python3-opencv")
    cv2.setNumThreads(1)
    print(f"OpenCV {cv2.__version__}; processor time of one move, ms, median of {options.runs}")
    results = []
    for size in options.sizes:
        ours = time_ours(options.program, size, options.runs)
        theirs, count = time_opencv(cv2, np, PIXELS[size], options.runs)
        results.append({"size": size, "opencv_ms": theirs, "membrane_ms": ours, "ratio": theirs / ours, "opencv_pixels": count})
        print(f"{size:>5}  OpenCV {theirs:9.2f}  membrane {ours:7.3f}  ratio {theirs / ours:6.0f}")
    if options.json:
        options.json.write_text(json.dumps({"opencv": cv2.__version__, "results": results}, indent=1) + "\n")


if __name__ == "__main__":
    main()
