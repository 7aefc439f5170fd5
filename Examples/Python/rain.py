"""Rain: drops that appear in the air get a skin of their own, which the pool's takes up.

Run: python3 rain.py [--output FOLDER]
"""

from coat_scene import coat_scene

coat_scene("rain", __doc__, pictured=(5, 9, 17, 29))
