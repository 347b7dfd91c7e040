#!/usr/bin/env python3
"""Tests a function against the exact answers to random cases: python3 docs/example-truth/balls.py ./nearmiss"""
import json, math, random, subprocess, sys

def depth(sphere1, sphere2):  # the function under test
    return sphere1["radius"] + sphere2["radius"] - math.dist(sphere1["center"], sphere2["center"])

def ball():
    return {"center": [random.uniform(-1, 1) for _ in range(3)], "radius": random.uniform(0, 1)}

cases = [{"query": "sphere_sphere_penetration", "inputs": {"sphere1": ball(), "sphere2": ball()}} for _ in range(1000)]
ran = subprocess.run([sys.argv[1], "truth"], input="\n".join(map(json.dumps, cases)), stdout=subprocess.PIPE,
                     text=True, check=True)
for case, truth in zip(cases, map(json.loads, ran.stdout.splitlines()), strict=True):
    (low, high), given = truth["alternatives"][0]["values"]["depth"], depth(**case["inputs"])
    if not low - 2e-15 <= given <= high + 2e-15:  # the roundings of three operations on numbers below 4
        sys.exit(f"the depth is given as {given}, but exactly, {truth['text']}: {json.dumps(case)}")
print(f"{len(cases)} depths are right")
