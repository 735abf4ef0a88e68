"""Writes tests/data/drivers/solved.json: what pose drivers (docs/pose_drivers.md) make of rotations, in float64 and
without their code. Quaternions are (x, y, z, w), and floats. Needs numpy.

    python3 tests/support/driver_vectors.py tests/data/drivers/solved.json
"""
import json
import math
import sys

import numpy as np

AXIS = np.array([0.6, 0.8, 0.0])  # of swings and twists
SEED = 8


def turn(axis, degrees):
    axis, half = np.asarray(axis, float), math.radians(degrees) / 2.0
    return np.append(axis / np.linalg.norm(axis) * math.sin(half), math.cos(half))


def rounded(q):
    return np.float64(np.float32(q))


def unit(q):
    return q / np.linalg.norm(q)


def product(a, b):
    v = a[3] * b[:3] + b[3] * a[:3] + np.cross(a[:3], b[:3])
    return np.append(v, a[3] * b[3] - a[:3] @ b[:3])


def conjugate(q):
    return q * [-1.0, -1.0, -1.0, 1.0]


def twist_of(q, axis):
    return unit(np.append(axis * (q[:3] @ axis), q[3]))


def distance(a, b):
    """The square of the sine of half the angle between two rotations."""
    return max(0.0, 1.0 - (unit(a) @ unit(b)) ** 2)


def distances(a, b):
    return np.array([[distance(p, q) for q in b] for p in a])


def solved(poses, width):
    """1 / sigma^2, the condition, and a function from rotations to the weights of one target per pose."""
    samples = [np.array([0.0, 0.0, 0.0, 1.0])] + poses
    between = distances(samples, samples)
    nearest = np.where(np.eye(len(samples)) > 0.0, np.inf, between).min(axis=1)
    inverse = 1.0 / (width * nearest.mean())
    kernel = (1.0 + between * inverse) ** -2.0
    values = np.vstack([np.zeros(len(poses)), np.eye(len(poses))])
    coefficients = np.linalg.solve(kernel, values)

    def weights(queries):
        return (1.0 + distances(queries, samples) * inverse) ** -2.0 @ coefficients

    return inverse, np.linalg.cond(kernel), weights


def plain(values, digits=17):
    return [plain(v, digits) for v in values] if np.ndim(values) > 0 else float("%.*g" % (digits, values))


def main():
    random = np.random.default_rng(SEED)
    hinge = [rounded(turn([1, 0, 0], a)) for a in (45, 90, 135)]
    shoulder = [rounded(turn([math.cos(a), 0, math.sin(a)], 85)) for a in np.arange(8) * math.pi / 4.0]
    close = [rounded(turn([1, 0, 0], a)) for a in (60, 65)]
    anywhere = [rounded(turn(random.normal(size=3), random.uniform(20.0, 120.0))) for _ in range(19)]
    sets = []
    for name, poses in (("hinge", hinge), ("shoulder", shoulder), ("close", close), ("random", anywhere)):
        for width in (1.0, 2.0, 4.0):
            queries = [rounded(unit(random.normal(size=4))) for _ in range(12)]
            inverse, condition, weights = solved(poses, width)
            sets.append({"name": name, "width": width, "poses": plain(poses), "condition": plain(condition, 5),
                         "inverseSigma2": plain(inverse, 9), "queries": plain(queries),
                         "weights": plain(weights(queries), 9)})
    rotations = [rounded(unit(random.normal(size=4))) for _ in range(64)]
    twists = [twist_of(q, AXIS) for q in rotations]
    swings = [product(unit(q), conjugate(t)) for q, t in zip(rotations, twists)]
    degrees = list(range(0, 181, 15))
    of_hinge = solved(hinge, 2.0)[2]([turn([1, 0, 0], a) for a in degrees])
    data = {"sets": sets, "axis": plain(AXIS), "rotations": plain(rotations), "swings": plain(swings),
            "twists": plain(twists), "hinge": {"degrees": degrees, "weights": plain(of_hinge, 9)}}
    with open(sys.argv[1], "w") as file:
        json.dump(data, file, separators=(",", ":"))
        file.write("\n")


main()
