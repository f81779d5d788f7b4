"""The two agents in one process, with one base in memory at any time."""

from __future__ import annotations

import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from planner_ft.candidates.loading import resolve_device
from planner_ft.confidence import calibration
from planner_ft.confidence.parts import known
from planner_ft.planning.result import AgentUse, Answer
from planner_ft.planning.settings import Agent
from planner_ft.support.resources import peak_memory
from planner_ft.support.terminal import Report
from planner_ft.vocabulary import Vocabulary
from planner_ft.vocabulary.plans import Level, parse_output, plan_problems

if TYPE_CHECKING:
    from planner_ft.decoding.engine import Engine
    from planner_ft.decoding.generate import Generation
    from planner_ft.decoding.sequence import Query

TOGETHER = 8
"""Records that a small model answers at a time: tasks, or parts of a command."""
CUT_NOTE = "The answer met its limit of tokens"
"""How the note on an answer that was ended at the limit begins."""


class Agents:
    """Loads the agents' bases as they are needed and asks them.

    Agents share one base. Of two bases one is in memory: the reference hardware has 6 GB for both.
    """

    def __init__(
        self, agents: Mapping[Level, Agent], vocabulary: Vocabulary, device: str, progress: Report
    ) -> None:
        """Raises PlannerError for a device that there is not."""
        self.agents, self.vocabulary, self._progress = agents, vocabulary, progress
        self.device = resolve_device(device)
        self.load_seconds: dict[Level, float] = dict.fromkeys(agents, 0.0)
        self._engine: Engine | None = None
        self._serves: tuple[Level, ...] = ()
        self._calibrations: dict[Level, tuple[calibration.Calibration | None, str]] = {}

    def load(self, level: Level) -> Engine:
        """The engine that answers for an agent, loaded if it is not. Raises PlannerError."""
        if self._engine is None or level not in self._serves:
            self.release()
            wanted, started = self.agents[level], time.perf_counter()
            served = {of: agent for of, agent in self.agents.items() if agent.base == wanted.base}
            adapters = {of: agent.adapter for of, agent in served.items() if agent.adapter}
            self._engine, self._serves = self._loaded(wanted, adapters), tuple(served)
            self.load_seconds[level] = time.perf_counter() - started
        return self._engine

    def release(self) -> None:
        """Give the memory of what is loaded back."""
        if self._engine is not None:
            self._engine.release()
        self._engine, self._serves = None, ()

    def ask(self, level: Level, record: dict[str, Any]) -> Answer:
        """The agent's answer to a record ({"prompt", ...}), read and checked."""
        engine, agent = self.load(level), self.agents[level]
        query = engine.query(level, record, with_vocabulary=agent.with_vocabulary)
        return self._read(engine, query, engine.answer(query, agent.configuration))

    def ask_each(
        self, level: Level, records: Sequence[dict[str, Any]]
    ) -> Iterator[tuple[int, Answer]]:
        """The agent's answers to records, by index, as they are completed: the same as one by one.
        A small model answers several at a time, and sooner.
        """
        engine, agent = self.load(level), self.agents[level]
        told, size = agent.with_vocabulary, TOGETHER if engine.lean else 1
        queries = [engine.query(level, record, with_vocabulary=told) for record in records]
        for at, made in engine.answers(queries, agent.configuration, batch_size=size):
            yield at, self._read(engine, queries[at], made)

    def _read(self, engine: Engine, query: Query, made: Generation) -> Answer:
        """The plan of an answer; None with the problems unless it is strictly valid."""
        level, text, tokens = query.level, engine.text(made), len(made.ids)
        parsed, judged = parse_output(text), calibration.NOT_JUDGED
        problems = [parsed.problem or "no plan"]
        if parsed.plan is not None:
            problems = plan_problems(level, parsed.plan, self.vocabulary, strict=True)
        if made.finish_reason == "length":
            problems.insert(0, f"cut at the limit of {tokens} tokens")
        notes = list(made.notes)
        if made.cut:
            notes.append(f"{CUT_NOTE} and was ended after {tokens}; something may be missing.")
        if not problems:
            choices = known(engine.choices(made), text)
            judged = calibration.judge_answer(*self._calibration(level), text, choices)
        return Answer(
            text,
            None if problems else parsed.plan,
            (made.error,) if made.error else tuple(problems),
            tuple(notes),
            len(query.prompt),
            tokens,
            made.forward_passes,
            made.seconds,
            made.cut or made.finish_reason == "length",
            judged=judged,
        )

    def _calibration(self, level: Level) -> tuple[calibration.Calibration | None, str]:
        """The calibration of an agent, or why there is none."""
        if level not in self._calibrations:
            agent, known = self.agents[level], self.vocabulary
            self._calibrations[level] = calibration.read_calibration(
                agent.calibration, agent.held_for(known)
            )
        return self._calibrations[level]

    def use(self, level: Level, answers: Sequence[Answer]) -> AgentUse:
        """What the agent did to give these answers."""
        agent = self.agents[level]
        return AgentUse(
            agent.candidate.row_name,
            agent.configuration.name,
            str(agent.adapter) if agent.adapter else None,
            round(self.load_seconds[level], 3),
            len(answers),
            sum(answer.prompt_tokens for answer in answers),
            sum(answer.tokens for answer in answers),
            sum(answer.forward_passes for answer in answers),
            round(sum(answer.seconds for answer in answers), 3),
        )

    def peak_memory(self) -> int:
        """Most bytes in use so far: on the GPU, else in this process."""
        return peak_memory(self.device)

    def _loaded(self, agent: Agent, adapters: Mapping[Level, Path]) -> Engine:
        from planner_ft.decoding.engine import Engine, decoding_threads

        self._progress(f"{agent.candidate.name}: loading", 0, 0)
        return Engine.load(
            agent.candidate,
            self.vocabulary,
            adapters=adapters,
            device=str(self.device),
            quantization=agent.quantization,
            threads=decoding_threads(agent.candidate, self.device.type),
        )
