"""Series of a run (fluid.csv, solid.csv, ...); needs numpy."""
import csv

import numpy as np


def read_series(path):
    """Columns of a CSV by their names without units."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    values = np.array(rows[1:], float)
    return {name.split(" [")[0]: values[:, k] for k, name in enumerate(rows[0])}
