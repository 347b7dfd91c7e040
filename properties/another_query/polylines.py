"""A program that answers the query of this test whose cases have lists."""
import json
import math
import os
import sys

cases, answers = os.fdopen(3), os.fdopen(4, "w")
print(json.dumps({"nearmiss": int(sys.argv[1]), "name": "polylines-py", "scalar": "double", "batches": "json",
                  "offers": [{"query": "sphere_contains_polyline"}]}), file=answers, flush=True)
for line in cases:
    batch = json.loads(line)
    for number, (x, y, z, radius, count, *vertices) in enumerate(batch["cases"], batch["first"]):
        assert len(vertices) == 3 * count
        far = max(math.dist((x, y, z), vertices[i:i + 3]) for i in range(0, 3 * count, 3))
        print(json.dumps({"case": number, "yes": far <= radius}), file=answers)
    answers.flush()
