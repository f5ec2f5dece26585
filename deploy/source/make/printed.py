"""What the source prints: the numbers of its tables, as facts."""

# Seconds; direct light alone.
TABLE_4_2_1 = {3: 47.0, 7: 53.0, 16: 54.0, 61: 61.0, 301: 75.0}
# Passes, frames per second.
TABLE_4_2_2 = {3: (1, 44.0), 7: (3, 14.5), 16: (6, 7.0), 61: (22, 1.85), 301: (100, 0.4)}
# Seconds, by samples of the data.
TABLE_4_3_1 = {31: 0.00008, 61: 0.0001, 301: 0.00035}
# Seconds, by rows and columns.
TABLE_4_4_1 = {(100, 100): 0.215, (100, 200): 0.585, (200, 200): 1.934, (200, 400): 6.485, (400, 400): 29.065}
# Seconds, by rows; 75 columns.
TABLE_4_4_2 = {7: 0.0291, 16: 0.0342, 31: 0.0414, 61: 0.0671, 301: 0.2519}
# Seconds, by basis functions: direct light, with reflections. 301: point sampling.
TABLE_4_4_3 = {1: (52, 86), 2: (52, 87), 3: (53, 88), 4: (54, 88), 5: (54, 88), 301: (75, 118)}
# Seconds, with reflections.
TABLE_4_5_1 = {"phong": 118, "strauss": 122, "blinn": 166}
# Frames per second: per vertex, per pixel. None: it did not fit; Blinn's per pixel has one light.
TABLE_4_5_2 = {"phong": (44.5, 27.0), "blinn": (26.0, 27.0), "strauss": (22.0, None)}
