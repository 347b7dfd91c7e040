#!/usr/bin/env python3
"""A collision library in Python as a subject of Nearmiss, by nearmiss.py (docs/reference/protocol.md).

    ./nearmiss run --command "python3 docs/example-program/balls.py" --subject balls-py
"""
import math
import pathlib
import sys

# Not needed where a copy of nearmiss.py is beside the program.
sys.path.append(str(pathlib.Path(__file__).resolve().parent / "../../impl/program"))
import nearmiss  # noqa: E402


def balls_meet(q):
    return math.dist(q.sphere1.center, q.sphere2.center) <= q.sphere1.radius + q.sphere2.radius


def ray_meets_ball(q):
    center, radius = q.sphere.center, q.sphere.radius
    from_center = [p - c for p, c in zip(q.point, center)]
    a = sum(v * v for v in q.velocity)
    b = sum(f * v for f, v in zip(from_center, q.velocity))
    c = sum(f * f for f in from_center) - radius * radius
    if c < 0 or a == 0:
        raise nearmiss.Cannot("it starts inside, or does not move")
    if b >= 0 or b * b < a * c:
        return False
    time = c / (math.sqrt(b * b - a * c) - b)
    location = [p + v * time for p, v in zip(q.point, q.velocity)]
    normal = [(l - c) / radius for l, c in zip(location, center)] if radius > 0 else None
    return {"time": time, "location": location, "normal": normal}


nearmiss.answer(name="balls-py", version="1.0", scalar="double",
                queries={"sphere_sphere_overlap": balls_meet, "moving_point_sphere": ray_meets_ball})
