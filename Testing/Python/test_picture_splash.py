# ctest: PICTURE
"""The skin of the splash at step 25, with flying drops, matches the baseline.

Run: python3 test_picture_splash.py -V <baseline.png> -T <folder>
"""

import sys

from picture import same_as_baseline
from scenes import splash

_, surface = splash()
surface.UpdateTimeStep(25)
sys.exit(same_as_baseline(surface.GetOutput(), view=(0.4, 0.5, 1.0), component=0))
