"""Check the templates of a vehicle: python -m planner_ft.data.templates [NAME] [--show N]."""

import sys

from planner_ft.data.templates.checking import main

if __name__ == "__main__":
    sys.exit(main())
