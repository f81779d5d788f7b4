"""What is wrong with NAME.simulation.toml, before any plan is run."""

from collections.abc import Mapping
from typing import Any

from planner_ft.document.vehicle import load_vehicle
from planner_ft.simulation.asked import LEARNT
from planner_ft.simulation.fast import build_vessel, simulation_file
from planner_ft.simulation.sensing import MEASURES
from planner_ft.simulation.skill import Job, implementation_of
from planner_ft.support.errors import PlannerError
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.definition import SIMULATION, VEHICLE

ANY = {"cruise_speed": 1.0, "turn_rate": 10.0, "endurance": 3600.0}  # where no profile is there


def check_simulation(vocabulary: Vocabulary) -> None:
    """Raises PlannerError for what the file of a vehicle may not hold."""
    raw = simulation_file(vocabulary)
    profile = load_vehicle(None, vocabulary).as_json() if vocabulary.beside(VEHICLE) else ANY
    build_vessel(vocabulary, profile)
    for table in ("skill", "task"):
        for name, own in raw.get(table, {}).items():
            check_measure(name, own, vocabulary)
            for key in ("implementation", LEARNT):
                if key in own:
                    job = Job(name, {}, None, {"implementation": own[key]})
                    try:
                        implementation_of(job)
                    except PlannerError as error:
                        where = f"{vocabulary.name}{SIMULATION}: [{table}.{name}] {key}"
                        raise PlannerError(f"{where}: {error}") from None


def check_measure(skill: str, settings: Mapping[str, Any], vocabulary: Vocabulary) -> None:
    """Raises PlannerError for settings of a skill with an unknown measure."""
    if (measure := settings.get("measure")) not in (None, *MEASURES):
        problem = f"measure = {measure!r} must be one of {', '.join(MEASURES)}"
        raise PlannerError(f"{vocabulary.name}{SIMULATION}: [skill.{skill}]: {problem}")
