# ctest: PICTURE
"""The star, stretched to a thread between two balls, matches the baseline.

Run: python3 test_picture_morph_topology.py -V <baseline.png> -T <folder>
"""

import sys

from picture import same_as_baseline
from scenes import star_to_balls

surface = star_to_balls()
surface.UpdateTimeStep(1.5)
sys.exit(same_as_baseline(surface.GetOutput(), view=(0.45, 0.45, 1.0), component=1))
