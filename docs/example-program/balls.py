#!/usr/bin/env python3
"""A collision library in Python as a subject of Nearmiss; docs/reference/protocol.md explains each line.

    ./nearmiss run --command "python3 docs/example-program/balls.py" --subject balls-py
"""
import json
import math
import os

cases, answers = os.fdopen(3), os.fdopen(4, "w")


def balls_meet(numbers):
    *center1, radius1, x, y, z, radius2 = numbers
    return {"yes": math.dist(center1, (x, y, z)) <= radius1 + radius2}


def ray_meets_ball(numbers):
    point, velocity, center, radius = numbers[0:3], numbers[3:6], numbers[6:9], numbers[9]
    from_center = [p - c for p, c in zip(point, center)]
    a = sum(v * v for v in velocity)
    b = sum(f * v for f, v in zip(from_center, velocity))
    c = sum(f * f for f in from_center) - radius * radius
    if c < 0 or a == 0:
        return {"cannot": "it starts inside, or does not move"}
    if b >= 0 or b * b < a * c:
        return {"yes": False}
    time = c / (math.sqrt(b * b - a * c) - b)
    location = [p + v * time for p, v in zip(point, velocity)]
    normal = [(l - c) / radius for l, c in zip(location, center)] if radius > 0 else ["none"] * 3
    return {"yes": True, "values": [time, *location, *normal]}


functions = {"sphere_sphere_overlap": balls_meet, "moving_point_sphere": ray_meets_ball}
print(json.dumps({"nearmiss": 3, "name": "balls-py", "version": "1.0", "scalar": "double", "batches": "json",
                  "offers": [{"query": query} for query in functions]}), file=answers, flush=True)
for line in cases:
    batch = json.loads(line)
    for number, numbers in enumerate(batch["cases"], batch["first"]):
        print(json.dumps({"case": number, **functions[batch["query"]](numbers)}), file=answers)
    answers.flush()
