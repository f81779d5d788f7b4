"""Agents whose answers are known: what planning does with an answer does not depend on a model."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from typing import Any

import pytest

from planner_ft.decoding.engine import Engine
from planner_ft.decoding.generate import Generation
from planner_ft.decoding.sequence import Query
from planner_ft.vocabulary.plans import Level

HOLD = {
    "navigation_skill": {"name": "StationKeep", "parameters": {"time": 30}},
    "filter_skills": [],
    "perception_skills": [{"name": "DetectObjects", "parameters": {"class_list": ["buoy"]}}],
    "stop_conditions": ["time over"],
    "failure_modes": [],
    "expected_outputs": [],
}
SKILLS = {"skill_sequence": [HOLD]}


def task(title: str, prompt: str, **parameters: Any) -> dict[str, Any]:
    return {"title": title, "parameters": parameters, "task_prompt": prompt}


def mission(*tasks: dict[str, Any]) -> dict[str, Any]:
    return {
        "tasks": list(tasks),
        "assumptions": ["Home is [0, 0]."],
        "constraints": ["Keep clear of the ferry."],
    }


FIND_AND_ORBIT = mission(
    task("SearchAndDetect", "Find the green buoy.", target_description="green buoy"),
    task("Transit", "Go to the green buoy once it is found.", target_position=[-99, -99]),
    task("PerformOrbit", "Circle the green buoy at 12 m.", center=[-99, -99], radius=12),
    task("Transit", "Return home.", target_position=[0, 0]),
)


class KnownAnswers:
    """Stands in for Engine. `texts` are the answers by level, the last one repeated; `asked` the
    records that came.
    """

    def __init__(self, texts: Mapping[Level, list[str]], generation: Mapping[str, Any]) -> None:
        self.texts, self.generation, self.lean = texts, generation, dict[str, Any]()
        self.asked: list[tuple[Level, dict[str, Any]]] = []

    def query(
        self, level: Level, record: dict[str, Any], *, with_vocabulary: bool = False
    ) -> Query:
        return Query(level, record, (1, 2, 3))

    def answer(self, query: Query, _configuration: object) -> Generation:
        self.asked.append((query.level, query.record))
        return Generation(
            **{
                "ids": (7,) * 10,
                "finish_reason": "stop",
                "seconds": 0.25,
                "forward_passes": 6,
                **self.generation,
            }
        )

    def answers(
        self, queries: list[Query], configuration: object, *, batch_size: int
    ) -> Iterator[tuple[int, Generation]]:
        assert batch_size == 1
        for at, query in enumerate(queries):
            yield at, self.answer(query, configuration)

    def choices(self, _answer: Generation) -> None:
        """No log-probabilities."""

    def text(self, _answer: Generation) -> str:
        level = self.asked[-1][0]
        given = [asked for asked, _record in self.asked if asked == level]
        return self.texts[level][min(len(given), len(self.texts[level])) - 1]

    def release(self) -> None:
        pass


def said(answer: Any) -> str:
    return answer if isinstance(answer, str) else json.dumps(answer)


Known = Callable[..., KnownAnswers]


@pytest.fixture
def known(monkeypatch: pytest.MonkeyPatch) -> Known:
    """Call it with the Mission Agent's answer, the Task Agent's and fields of Generation: every
    Engine that loads then gives them.
    """

    def give(plan: Any = FIND_AND_ORBIT, *skills: Any, **generation: Any) -> KnownAnswers:
        engine = KnownAnswers(
            {"mission": [said(plan)], "task": [said(answer) for answer in skills or (SKILLS,)]},
            generation,
        )
        monkeypatch.setattr(Engine, "load", lambda *_arguments, **_settings: engine)
        return engine

    return give
