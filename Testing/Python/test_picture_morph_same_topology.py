# ctest: PICTURE
"""The tube, halfway to a box, matches the baseline.

Run: python3 test_picture_morph_same_topology.py -V <baseline.png> -T <folder>
"""

import sys

from picture import same_as_baseline
from scenes import tube_to_box

surface = tube_to_box()
surface.UpdateTimeStep(0.3)
sys.exit(same_as_baseline(surface.GetOutput(), view=(0.45, 0.45, 1.0), component=1))
