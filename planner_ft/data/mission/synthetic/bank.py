"""The language of all 21 tasks: how operators ask for each of them."""

from __future__ import annotations

from planner_ft.data.mission.synthetic.bank_data import BANK_DATA
from planner_ft.data.mission.synthetic.bank_imaging import BANK_IMAGING
from planner_ft.data.mission.synthetic.bank_manoeuvre import BANK_MANOEUVRE, BANK_RETURN
from planner_ft.data.mission.synthetic.bank_structure import BANK_STRUCTURE
from planner_ft.data.mission.synthetic.bank_survey import BANK_SURVEY
from planner_ft.data.mission.synthetic.bank_thermal import BANK_THERMAL
from planner_ft.data.mission.synthetic.phrases import TaskPhrases

__all__ = ["BANK", "BANK_RETURN"]

BANK: dict[str, TaskPhrases] = {
    **BANK_MANOEUVRE,
    **BANK_STRUCTURE,
    **BANK_SURVEY,
    **BANK_IMAGING,
    **BANK_THERMAL,
    **BANK_DATA,
}
