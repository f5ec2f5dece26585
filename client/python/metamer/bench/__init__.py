"""Measures a server: scenes × methods × samples × backends, in rounds, and says what got slower than a record of before.

    metamer-bench booth.txtpb --method exact --method "point { fitted: 8 }" --samples 1,16 -o now.json
    metamer-bench booth.txtpb --method exact --samples 1,16 --baseline now.json
    metamer-bench booth.txtpb --program new/metamerd --against old/metamerd

Every round has every case once, in an order drawn anew, so that what happens to the machine meanwhile happens to all.
"""
from metamer.bench.command import main

__all__ = ["main"]
