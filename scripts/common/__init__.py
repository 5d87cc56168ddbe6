"""What the scripts share beside the module graupel, which lies in python/."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
