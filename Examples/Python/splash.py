"""A ball of fluid falls into a pool: 21,350 particles, a crown, sheets and drops, and their skin.

Run: python3 splash.py [--output FOLDER]. The particles are made first, which takes minutes.
"""

from coat_scene import coat_scene

coat_scene("splash", __doc__, pictured=(7, 11, 16), width=2400)
