#!/usr/bin/env python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""Runs the cocotb tests of an emitted vertex adder in Icarus. Needs cocotb 2 (requirements-test.txt) and iverilog.

    cargo run --release -- emit vertex_adder --param small --out rtl
    .tools/test/bin/python examples/cocotb/run.py rtl/vertex_adder

The runner of cocotb is content with tests that fail, so its results are read here: the exit code is 1 where a test failed,
and where there was none.
"""

import sys
import tempfile
from pathlib import Path

from cocotb_tools.runner import get_results, get_runner

HERE = Path(__file__).resolve().parent


def main() -> int:
    if len(sys.argv) != 2 or not (Path(sys.argv[1]) / "filelist.f").is_file():
        print(f"usage: {sys.argv[0]} FOLDER, into which `relief emit vertex_adder` has written", file=sys.stderr)
        return 2
    folder = Path(sys.argv[1]).resolve()
    sources = [folder / line for line in (folder / "filelist.f").read_text(encoding="utf-8").split()]
    sys.path.insert(0, str(HERE))
    with tempfile.TemporaryDirectory() as build:
        runner = get_runner("icarus")
        top = "relief_vertex_adder"
        runner.build(sources=sources, hdl_toplevel=top, build_dir=build, build_args=["-g2012"], timescale=("1ns", "1ps"))
        results = runner.test(test_module="test_vertex_adder", hdl_toplevel=top, build_dir=build, test_dir=build)
        tests, failed = get_results(results)
    print(f"{tests - failed} of {tests} tests passed")
    return 0 if tests > 0 and failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
