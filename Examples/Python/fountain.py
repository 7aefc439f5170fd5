"""A fountain: particles appear at a nozzle in each frame and leave by drains; so does their skin.

Run: python3 fountain.py [--output FOLDER]
"""

from coat_scene import coat_scene

coat_scene("fountain", __doc__, pictured=(4, 12, 20, 32))
