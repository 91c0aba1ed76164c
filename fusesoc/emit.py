#!/usr/bin/env python3
# SPDX-License-Identifier: MIT OR Apache-2.0
"""The generator of relief.core: emits one block into the folder in which FuseSoC starts it.

Parameters: `block`; `param`, the width set; `axi_stream`, whether the wrapper with AXI4-Stream names comes, too. The program
is what the variable RELIEF names, or `relief` on the PATH, or the project built by cargo.
"""

import os
import shutil
import subprocess
import sys

import yaml


def main() -> int:
    with open(sys.argv[1], encoding="utf-8") as file:
        request = yaml.safe_load(file)
    if request["gapi"] != "1.0":
        sys.exit(f"{sys.argv[1]}: gapi 1.0 is expected, and {request['gapi']} came")
    parameters = dict(request["parameters"])
    root = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    found = os.environ.get("RELIEF") or shutil.which("relief")
    cargo = ["cargo", "run", "--quiet", "--release", "--locked", "--manifest-path", os.path.join(root, "Cargo.toml"), "--"]
    command = [found] if found else cargo
    if "block" not in parameters:
        sys.exit(f"{request['vlnv']}: the parameter `block` is missing; `relief blocks` lists them")
    command += ["emit", parameters.pop("block"), "--param", parameters.pop("param", "default"), "--out", "."]
    if parameters.pop("axi_stream", False):
        command.append("--axi-stream")
    if parameters:
        sys.exit(f"{request['vlnv']}: unknown parameters {', '.join(parameters)}; block, param and axi_stream are known")
    return subprocess.run(command, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
