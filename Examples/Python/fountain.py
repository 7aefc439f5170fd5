"""A fountain: particles appear at a nozzle and leave by drains; skin forms and vanishes with them.

Run: python3 fountain.py [--output FOLDER]
"""

from coat_scene import coat_scene

coat_scene("fountain", __doc__, pictured=(4, 12, 20, 32))
