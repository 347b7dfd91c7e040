#!/usr/bin/env python3
"""Tests import-vamp with a robot of one joint, whose sphere moves on a circle. Exit status 77 where yaml is missing."""
import io
import json
import math
import os
import runpy
import subprocess
import sys
import tarfile
import tempfile

SCRIPT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "import-vamp")
URDF = """<robot name="panda">
<link name="base"/>
<link name="arm"><collision><geometry><sphere radius="0.25"/></geometry><origin xyz="1 0 0" rpy="0 0 0"/></collision></link>
<joint name="turn" type="revolute"><origin xyz="0 0 0.5" rpy="0 0 0"/><parent link="base"/><child link="arm"/>
<axis xyz="0 0 1"/><limit lower="-1.5" upper="1.5"/></joint>
</robot>"""
SCENE = """world: {collision_objects: [
 {primitive_poses: [{position: [0.75, 0.75, 0.5], orientation: [0, 0, 0, 1]}], primitives: [{type: box, dimensions: [1, 1, 1]}]},
 {primitive_poses: [{position: [9, 9, 9], orientation: [0, 0, 0, 1]}], primitives: [{type: box, dimensions: [1, 1, 1]}]},
 {primitive_poses: [{position: [0, 0, 0], orientation: [0, 0, 0, 1]}], primitives: [{type: cylinder, dimensions: [1, 1]}]}]}"""
REQUEST = """start_state: {joint_state: {name: [turn], position: [0]}}
goal_constraints: [{joint_constraints: [{joint_name: turn, position: 1.5}]}]"""


def check(holds, what):
    if not holds:
        sys.exit(f"import_vamp_test: {what}")


def near(a, b):
    return all(abs(x - y) < 2 ** -40 for x, y in zip(a, b))  # some roundings of numbers of about 1


def test_kinematics(folder):
    vamp = runpy.run_path(SCRIPT, run_name="imported")
    robot = vamp["Robot"](os.path.join(folder, "panda_spherized.urdf"))
    check(robot.root == "base" and robot.extents == {"turn": 3.0}, "the joints of the robot")
    (center, radius), = robot.placed({"turn": math.pi / 2})
    check(near(center, (0, 1, 0.5)) and radius == 0.25, f"a quarter turn places the sphere at {center}")
    turned = ((1, 1, 1), (1, 2, 3), (0, 0, math.sqrt(0.5), math.sqrt(0.5)))  # x and y change places
    check(abs(vamp["distance"]((4, 1, 1), turned) - 1) < 2 ** -40, "the distance from a turned box")
    check(vamp["distance"]((1, 1, 1), turned) == 0, "the distance from inside a box")


def test_output(folder):
    output = os.path.join(folder, "cases.jsonl")
    ran = subprocess.run([sys.executable, SCRIPT, folder, "--robot", "panda", "--output", output], capture_output=True,
                         text=True)
    check(ran.returncode == 0, ran.stderr)
    check("1 shapes that are no boxes left out" in ran.stderr, ran.stderr)
    cases = [json.loads(line) for line in open(output)]
    check({c["query"] for c in cases} == {"sphere_box_overlap", "sphere_box_penetration", "moving_sphere_box"},
          "each query has cases")
    for c in cases:
        v = c["values"]
        check(near([math.hypot(v[0], v[1]), v[2], v[3]], [1, 0.5, 0.25]), f"the sphere is on its circle: {v}")
        check(near(v[-10:], [0.75, 0.75, 0.5, 0.5, 0.5, 0.5, 0, 0, 0, 1]), f"the far box is left out: {v}")
        if c["query"] == "moving_sphere_box":
            check(near([math.hypot(v[0] + v[4], v[1] + v[5])], [1]), f"so is the next configuration: {v}")
            check(0 < math.hypot(v[4], v[5]) <= 0.005 * 3, f"a step is at most the resolution: {v}")
    missing = subprocess.run([sys.executable, SCRIPT, folder, "--robot", "ur5"], capture_output=True, text=True)
    check(missing.returncode != 0 and "ur5_spherized.urdf: there is no such file" in missing.stderr, missing.stderr)


def main():
    try:
        import yaml  # noqa: F401
    except ImportError:
        sys.exit(77)
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "panda_spherized.urdf"), "w") as file:
            file.write(URDF)
        with tarfile.open(os.path.join(folder, "panda-problems.tar.bz2"), "w:bz2") as archive:
            for name, text in (("problems/one/scene0001.yaml", SCENE), ("problems/one/request0001.yaml", REQUEST)):
                entry = tarfile.TarInfo(name)
                entry.size = len(text)
                archive.addfile(entry, io.BytesIO(text.encode()))
        test_kinematics(folder)
        test_output(folder)


if __name__ == "__main__":
    main()
