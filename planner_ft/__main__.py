"""`python -m planner_ft` is `plannerft`."""

from planner_ft.cli import main

if __name__ == "__main__":
    main()
