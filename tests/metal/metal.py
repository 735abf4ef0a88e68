#!/usr/bin/env python3
"""Translates every kernel to Metal's language, as MoltenVK does, and looks whether `precise` is still there.

SPIR-V marks what must be rounded as written with NoContraction. SPIRV-Cross makes calls of functions of these additions, subtractions
and multiplications, which Metal's compiler does not optimize. A product can only be joined with a sum, so there must be a call for each
marked addition and subtraction. Exit code: 0 all is well, 1 it is not, 77 a program is missing.
"""
import argparse
import concurrent.futures
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

VERSION = "20300"  # of Metal's language: macOS 11, iOS 14
SUMS = {"OpFAdd": "spvFAdd", "OpFSub": "spvFSub"}
# Atomics through addresses: the SPIRV-Cross of Debian 12 has none. Only hosts that ask for shared dispatches meet them.
BY_ADDRESS = "No backing variable for atomic operation"


def marked(dis, kernel):
    """How many additions and subtractions carry NoContraction, by instruction."""
    text = subprocess.run([dis, "--no-color", "--raw-id", kernel], capture_output=True, text=True, check=True).stdout
    precise = set(re.findall(r"OpDecorate (%\w+) NoContraction", text))
    return {op: sum(result in precise for result in re.findall(rf"^\s*(%\w+) = {op} ", text, re.M)) for op in SUMS}


def calls(text, function):
    """Without its definitions, which stand behind the type of what they return."""
    return len(re.findall(rf"(?<!T ){function}\(", text))


def check(programs, kernel):
    """What is wrong with the kernel, or nothing; how many sums are marked; whether it is left out."""
    done = subprocess.run([programs.cross, "--msl", "--msl-version", VERSION, kernel], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        left_out = BY_ADDRESS in done.stderr and "TASKS" in kernel.name
        return "" if left_out else done.stderr.strip(), 0, left_out
    wanted = marked(programs.dis, kernel)
    found = {op: calls(done.stdout, function) for op, function in SUMS.items()}
    if any(wanted.values()) and "clang::optnone" not in done.stdout:
        return "its precise sums may be optimized", 0, False
    return "" if wanted == found else f"of {wanted} precise sums there are {found}", sum(wanted.values()), False


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kernels", type=Path, help="the folder with *.opt.spv")
    parser.add_argument("--cross", default="spirv-cross", help="SPIRV-Cross")
    parser.add_argument("--dis", default="spirv-dis", help="SPIRV-Tools' disassembler")
    programs = parser.parse_args()
    for name, program in (("spirv-cross", programs.cross), ("spirv-dis", programs.dis)):
        if not shutil.which(program):
            print(f"left out: {name} is not installed (Debian packages spirv-cross and spirv-tools)")
            return 77
    kernels = sorted(programs.kernels.glob("*.opt.spv"))
    faults = sums = left_out = 0
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        for kernel, (fault, count, skipped) in zip(kernels, pool.map(lambda k: check(programs, k), kernels)):
            sums += count
            left_out += skipped
            if fault:
                faults += 1
                print(f"{kernel.name}: {fault}")
    print(f"{len(kernels)} kernels, {sums} precise sums; {left_out} of shared dispatches left out, {faults} with faults")
    return 1 if faults or not sums else 0


if __name__ == "__main__":
    sys.exit(main())
