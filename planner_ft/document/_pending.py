"""Stand-ins for the analyses that are being written; removed when they are there."""

# ruff: noqa
# mypy: ignore-errors
try:
    from planner_ft.document.estimate import estimate
except ImportError:

    def estimate(document, vocabulary):
        return {"length": 0, "seconds": 0, "open": []}


try:
    from planner_ft.document.ontology import check
except ImportError:

    def check(command, vocabulary):
        return {"elements": [], "missing": [], "questions": []}


try:
    from planner_ft.document.sources import sources
except ImportError:

    def sources(document, vocabulary):
        return [{name: {"kind": "model"} for name in task["parameters"]} for task in document["tasks"]]


try:
    from planner_ft.document.warnings import warnings
except ImportError:

    def warnings(document, vocabulary):
        return [
            {
                "id": f"unresolved-location:{p['name']}",
                "kind": "unresolved-location",
                "task": None,
                "parameter": None,
                "text": f"{p['name']}: its place is not known",
            }
            for p in document["open_places"]
        ]


try:
    from planner_ft.document.vehicle import Vehicle, load_vehicle
except ImportError:

    class Vehicle:
        def as_json(self):
            return {"name": "usv", "cruise_speed": 1.5, "endurance": 7200, "turn_rate": 20, "area": None}

    def load_vehicle(path, vocabulary):
        return Vehicle()
