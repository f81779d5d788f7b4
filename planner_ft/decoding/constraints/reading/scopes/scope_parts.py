"""Some steps of a plan by their kind or number, and a skill that runs in several of such parts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from planner_ft.decoding.constraints.reading.scopes import scope_words as w


@dataclass(frozen=True)
class Part:
    """Some steps: those of `sure` navigation skills (and perhaps of those of `maybe`), any where
    both are empty; of these the `which`-th, or all.
    """

    sure: frozenset[str] = frozenset()
    maybe: frozenset[str] = frozenset()
    which: frozenset[int] | None = None
    excepted: bool = False
    counted: bool = True
    """Whether steps can be counted: False where one movement of the text may be several of them."""
    script: tuple[str, ...] = ()
    """The navigation skills of the text's movements, where `which` counts these: it holds while the
    plan goes by them.
    """
    others: bool = False
    """What holds for movements of other kinds: "in all but the last hold" is in these as well."""
    by_movement: bool = False
    """Whether `which` counts the movements of the text, that may be of several steps each."""

    def holds(
        self, earlier: Sequence[str] | None, index: int, skill: str, is_last: bool | None
    ) -> bool | None:
        if self.by_movement:
            if index and (earlier is None or (*earlier, skill) != self.script[: index + 1]):
                return None
            return self._counts(index, is_last, overall=True)
        if self.script:
            followed = earlier is not None and (*earlier, skill) == self.script[: index + 1]
            return index in (self.which or ()) if followed else None
        if not (self.sure or self.maybe):
            return self._counts(index, is_last, overall=True)
        if skill in self.maybe:
            return None
        if skill not in self.sure:
            return self.others
        if self.which is None:
            return True
        kinds = self.sure | self.maybe
        return (
            self._counts(sum(name in kinds for name in earlier), is_last, overall=False)
            if earlier is not None
            else None
        )

    def _counts(self, index: int, is_last: bool | None, *, overall: bool) -> bool | None:
        if self.which is None:
            return True
        named = self._named(index, is_last, overall)
        return None if named is None else named != self.excepted

    def _named(self, index: int, is_last: bool | None, overall: bool) -> bool | None:
        assert self.which is not None
        if not self.counted and index > 0:
            return True if w.LAST in self.which and is_last else None
        if index in self.which:
            return True
        # A plan of which a last step is spoken of has more than one.
        if w.LAST not in self.which or index == 0:
            return False
        return is_last if overall or is_last else None


@dataclass(frozen=True)
class Scope:
    """The steps in which a skill runs: those of any of `parts`, and perhaps others where the text
    is `open`.
    """

    parts: tuple[Part, ...]
    open: bool = False
    source: str = ""
    script: tuple[str, ...] = ()

    def allows(
        self,
        step_index: int,
        navigation_skill: str,
        is_last: bool | None = None,
        earlier: Sequence[str] | None = None,
    ) -> bool | None:
        """Whether the skill must run (True) or must not (False) in the step; None: not known.

        `is_last` is None where it is not known whether the step ends the plan, `earlier` the
        navigation skills of the steps before it.
        """
        if (
            is_last is None
            and earlier is not None
            and self.script
            and (*earlier, navigation_skill) == self.script[: step_index + 1]
        ):
            is_last = step_index + 1 == len(self.script)
        found = [part.holds(earlier, step_index, navigation_skill, is_last) for part in self.parts]
        if True in found:
            return True
        return None if self.open or None in found else False


EVERYWHERE = Part()
