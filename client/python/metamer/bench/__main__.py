import sys

from metamer.bench.command import main

sys.exit(main())
