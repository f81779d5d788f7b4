"""One command in the making: its text and what it asks for."""

from collections.abc import Iterator
from typing import Any

from planner_ft.data.filling import UNPLACED, Filling, is_name
from planner_ft.data.formulas import is_formula, operands, worked_out
from planner_ft.data.mission_binding import CLAUSE, IT, OBJECTS, Line
from planner_ft.data.mission_plan import Intent, Target
from planner_ft.data.numbers import PLACES, Value, digits, pick, position
from planner_ft.data.templates.grammar import Call, Nodes, Slot, TemplateError, base_of, choose
from planner_ft.data.templates.render import PIECE, article_for
from planner_ft.facts.geometry import tidy
from planner_ft.vocabulary import Task
from planner_ft.vocabulary.limits import written

BARE = 0.5
"""Share of the sizes before another size that are said without a unit."""
JOINTS = (" by ", " x ", "x", " times ")


class Drawing(Filling):
    """One command in the making: what it says, and what is planned for it."""

    # ------------------------------------------------------------ text

    def pieces(self) -> Iterator[PIECE]:
        """The text in pieces, each with whether it is a value."""
        wrong = {slot.key: self._wrong(slot) for slot in self.slots if slot.sign == "~"}
        seen: dict[tuple[str, frozenset[str]], str] = {}
        placed = set(self.bound.places)
        for number, part in enumerate(self.parts):
            if isinstance(part, str):
                yield part, False
            elif part.sign:
                yield from wrong[part.key] if part.sign == "~" else ()
            elif part.base == CLAUSE:
                yield from self.clauses[part.key].pieces() if part.key in self.clauses else ()
            elif part.base == "T":
                unplaced = part.options & (UNPLACED | {"bare"}) or self._owns(number)
                with_place = not unplaced and part.key not in placed
                if with_place or "a" in part.options:
                    placed.add(part.key)
                yield from self._mention(self.targets[part.key], part, with_place=with_place)
            elif part.base == IT:
                yield "it", False
            else:
                key = part.key, part.options
                if key not in seen:
                    seen[key] = self._word(part, number)
                yield seen[key], True

    def _word(self, slot: Slot, number: int) -> str:
        if slot.base == "P":
            return position(self._place_of(slot.key), self.rng, self.form).text
        if slot.base == "ID":
            return self.targets[slot.key].text
        value, (joint, after) = self.values[slot.key], (*self.parts[number + 1 :], "", "")[:2]
        if joint in JOINTS and isinstance(after, Slot) and self.rng.random() < BARE:
            # "20 by 80 ft" says that the 20 are feet.
            sizes = [one for one in (slot, after) if one.base in ("width", "length")]
            texts = [self.values[one.key].text for one in sizes if not one.options and not one.sign]
            if len(texts) == 2 and all(map(_metric, texts)):
                return digits(value.value)
        return self._worded(value, slot)

    def _worded(self, value: Value, slot: Slot) -> str:
        text = value.worded(slot.options)
        return str(value.value) if text == value.text and slot.base in self.words else text

    def _mention(self, target: Target, slot: Slot, *, with_place: bool = False) -> list[PIECE]:
        """The target as it is spoken of; ordinary words are no values: they can be mistyped."""
        text, options = target.description or target.text, slot.options
        if "nouns" in options:
            return [(plural(target.noun), False)]
        if "look" in options or "one" in options:
            return [(target.text if "look" in options else f"the {target.text} one", False)]
        kept = is_name(text) or self.rng.random() < 0.6
        if "a" in options:
            return [(f"{article_for(text)} ", False), (text, kept)]
        named = f"the {text}" if target.article and "bare" not in options else text
        if not with_place or target.position is None:
            return [(named, kept)]
        form = pick(PLACES["doubtful" if target.doubtful else "known"], self.rng)
        place = position(target.position, self.rng, self.form).text
        before, _brace, after = form.partition("{}")
        if before.endswith("(") and place[0] in "[(":
            before, after = " at ", ""
        return [(named, kept), (before, False), (place, True), (after, False)]

    def _wrong(self, slot: Slot) -> list[PIECE]:
        """What is taken back: of the same kind, and another one."""
        key, rng = slot.key, self.rng
        if slot.base == "P":
            right, point = self._place_of(key), self._point()
            near = (right[0], point[1]) if rng.random() < 0.5 else point
            wrong = near if near != right else point
            return [(position(wrong, self.rng, self.form).text, True)]
        if slot.base == "T":
            kind = self.bound.kinds.get(key, "pair")
            kind = self.sampler.default if kind == "pair" else kind
            return self._mention(self._described(key, kind, bool(slot.options), True), slot)
        if slot.base == "ID":
            return [(self.words.noun("identity", rng).text, True)]
        for _ in range(60):
            value = self._new(key)
            unsaid = "adj" in slot.options and not value.short
            if value.value != self.values[key].value and not unsaid:
                break
        return [(self._worded(value, slot), True)]

    # ------------------------------------------------------------ plan

    def remarks(self) -> list[list[str]]:
        """The template's own constraints, and its assumptions, as the plan holds them."""
        texts = ([self._filled(nodes) for nodes in group] for group in self.template.remarks)
        return [[f"{one[0].upper()}{one[1:].rstrip('.')}." for one in group] for group in texts]

    def intent(self, line: Line) -> Intent:
        """What is asked for by a line of the plan."""
        if line.task is None:
            return Intent(self.vocabulary.task[self.vocabulary.transit], home=True)
        said = (key for key in line.objects if base_of(key) != "P" or key in self.said)
        rank = {kind: place for place, kind in enumerate(OBJECTS)}
        key = min(said, key=lambda one: rank.get(base_of(one), 0), default=None)
        if key and key not in self.targets:
            raise TemplateError(f"{line.task.title} needs {{{key}}}, which one alternative lacks")
        part = self._filled(line.part) if line.part else ""
        target = self.targets[key] if key else None
        if line.spot:
            target = Target(f"spot {line.spot}", line.spot, text=line.spot, spot=True)
        return Intent(line.task, target, self._parameters(line, line.task), part=part)

    def _parameters(self, line: Line, task: Task) -> dict[str, Any]:
        """The parameters that are said, in the order of the definition."""
        found: dict[str, Any] = {}
        for parameter, slot, value in line.fills:
            if is_formula(slot):
                value = worked_out(slot, self._worth) if operands(slot) <= self.said else None
            elif slot in self.targets:
                value = self.targets[slot].identity or self.targets[slot].description
            elif slot in self.values and slot in self.said:
                value = self.values[slot].value
            if value is not None and parameter.type == "texts":
                found.setdefault(parameter.name, []).append(value)
            elif value is not None:
                found.setdefault(parameter.name, value)
        return {name: found[name] for name in task.by_name if name in found}

    def given(self, call: Call) -> dict[str, Any]:
        """The values of a limit or demand by name; a target gives object and position."""
        found: dict[str, Any] = {}
        for argument in call.arguments:
            key, slot = str(argument.value), argument.kind == "slot"
            if slot and (target := self.targets.get(key)):
                found["object"] = target.identity or (target.description and target.name)
                if target.position is not None:
                    found["position"] = [tidy(number) for number in target.position]
            elif slot and key in self.values:
                value, name = self.values[key], argument.name or base_of(key)
                found[name] = value.text if name == "time" else value.value
            else:
                literal = argument.value
                found[argument.name] = tidy(literal) if isinstance(literal, float) else literal
        return found

    def _filled(self, nodes: Nodes) -> str:
        """A text of the plan with what its slots stand for."""
        parts = choose(nodes, self.rng, [])
        return "".join(part if isinstance(part, str) else self._named(part) for part in parts)

    def _named(self, slot: Slot) -> str:
        if target := self.targets.get(slot.key):
            return written(self._place_of(slot.key)) if slot.base == "P" else target.name
        if value := self.values.get(slot.key):
            return str(value.value) if slot.base in self.words else value.text
        raise TemplateError(f"a remark needs {{{slot.key}}}, which one alternative lacks")


def _metric(text: str) -> bool:
    return text.endswith(("m", "metres", "meters")) and not text.endswith("km")


def plural(noun: str) -> str:
    """The noun, which does not end in y, for more than one."""
    return f"{noun}es" if noun.endswith(("s", "x", "ch", "sh")) else f"{noun}s"
