"""Figures of commit b67f7a4, whose skins over particles needed substeps, to print beside today's.

The figures are from that commit's Testing/README.md, section Speed, unless a comment gives another
source. The machine was two shared cores of an AMD EPYC: compare ratios rather than seconds.
"""

# quality.py, voxels of one particle radius: seconds per frame, and splashsurf's in the same run.
SECONDS = {
    "pool": (0.024, 0.025),
    "jitter": (0.024, 0.032),
    "slosh": (0.026, 0.031),
    "ball": (0.007, 0.008),
    "sheet": (0.014, 0.024),
    "rain": (0.047, 0.023),
    "fountain": (0.047, 0.033),
    "splash": (0.119, 0.047),
    "dam": (0.104, 0.049),
}

# Other figures of quality.py. Testing/README.md of the commit has the pool's p95, the flicker and
# the splash's isolated particles. The other figures were measured later, with the commit's code.
QUALITY = {
    "pool": {
        "flatness, mean [deg]": 0.75,
        "flatness, p95 [deg]": 2.46,
        "volume over rest": 1.016,
        "drops kept, standing": 1.0,
        "drops kept, falling": 1.0,
    },
    "jitter": {"flicker, rms [r]": 0.0059},
    "splash": {
        "isolated particles inside": 0.994,
        "all particles inside": 0.985,
        "volume over rest": 1.067,
    },
    "dam": {
        "isolated particles inside": 1.0,
        "all particles inside": 0.999,
        "outside by more than r": 0.0,
    },
    "fountain": {
        "births: frames until inside, median": 0.0,
        "births: frames until inside, worst": 8.0,
        "births: never inside": 0.0005,
    },
    "rain": {
        "births: frames until inside, median": 0.0,
        "births: frames until inside, worst": 8.0,
        "births: never inside": 0.0,
        "drops: later volume over rest": 0.90,
    },
    "sheet": {"whole sheet kept": 1.0},
    "ball": {"lag at 2 r per frame [voxels]": 0.010},
}

# large.py, voxels of one particle radius: medians of three runs of (seconds per frame, bytes per
# particle), ours and splashsurf's.
LARGE = {
    250_000: ((1.1, 1900), (0.77, 950)),
    1_000_000: ((3.4, 1800), (2.15, 640)),
    4_000_000: ((13.5, 1700), (7.95, 480)),
}
