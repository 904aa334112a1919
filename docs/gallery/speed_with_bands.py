"""Speed and acceleration of a marker with their error bands, as CSV.

python speed_with_bands.py TAKE MARKER OUT.csv
"""

import sys

import numpy as np

import markermend as mm
from markermend.smoothers import derivatives

path, marker, out = sys.argv[1:4]
take = mm.read(path)
motion = derivatives(take, markers=[marker])


def length(vectors: np.ndarray) -> np.ndarray:
    return np.linalg.norm(vectors[:, 0], axis=1)


columns = {
    "frame": take.first_frame + np.arange(take.frames),
    "time_s": np.arange(take.frames) / take.rate,
    "speed_mm_s": length(motion.velocity),
    "speed_band_mm_s": length(motion.velocity_band),
    "acceleration_m_s2": length(motion.acceleration) / 1000,
    "acceleration_band_m_s2": length(motion.acceleration_band) / 1000,
}
table = np.column_stack(list(columns.values()))
np.savetxt(out, table, delimiter=",", header=",".join(columns), comments="", fmt="%.6g")
fastest = int(np.nanargmax(columns["speed_mm_s"]))
speed, band = columns["speed_mm_s"][fastest], columns["speed_band_mm_s"][fastest]
print(f"{marker} is fastest in frame {columns['frame'][fastest]}: {speed:.0f} ± {band:.0f} mm/s")
