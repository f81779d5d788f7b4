"""Write a stand-in of every published candidate: python scripts/make_standins.py DIR

Then `PLANNERFT_MODELS=DIR plannerft train --candidate Llama-3.2-1B ...` runs as with the real
model.
"""

import argparse
from pathlib import Path

from planner_ft.candidates.standins import make_all_standins

if __name__ == "__main__":
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folder", type=Path, metavar="DIR", help="where to write the seven folders")
    parser.add_argument("--seed", type=int, default=0, help="of the random weights (default 0)")
    arguments = parser.parse_args()
    for path in make_all_standins(arguments.folder, arguments.seed):
        print(path)
