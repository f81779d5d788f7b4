"""Sentence frames for prompts with several movements."""

from __future__ import annotations

from collections.abc import Callable

from planner_ft.data.numbers import in_words
from planner_ft.data.task.movements import Movement
from planner_ft.data.task.phrasebook import Call
from planner_ft.data.task.phrasing import Script, Speaker, can_with, join, sentence
from planner_ft.data.task.scopes import ALL_THE_TIME, ORDINALS, group_of
from planner_ft.data.task.template import Form
from planner_ft.data.task.terse import can_passive, noun

Sequence = Callable[[Speaker, list[Movement]], str]


def clause(say: Speaker, movement: Movement, form: Form = "base", *, closed: bool = True) -> str:
    """A movement with what runs in its step alone. `closed`: nothing follows in the sentence that
    could be taken for it.
    """
    filters, perceptions = movement.filters, movement.perceptions
    roll = say.rng.random()
    if perceptions and roll < 0.15 and form == "base":
        text = f"{say.calls(perceptions)} while {say.move(movement, 'ing')}"
        return text + _local_filters(say, filters, closed=closed)
    text = say.move(movement, form)
    if can_with(filters) and roll < 0.6:
        text, filters = f"{text} with {say.with_words(filters)}", []
    if perceptions and (roll < 0.6 or not closed):
        return f"{text} while {say.calls(perceptions + filters, 'ing')}"
    if perceptions and roll < 0.8 and form == "base" and not filters:
        return (
            f"{text} and"
            f" {say.pick('', 'there ', '') if movement.kind in ('goto', 'hold') else ''}{say.calls(perceptions)}"
        )
    calls = filters + perceptions
    return f"{text}, {say.calls(calls, 'ing')}" if calls else text


def _local_filters(say: Speaker, filters: list[Call], *, closed: bool) -> str:
    if not filters:
        return ""
    if can_with(filters):
        return f" with {say.with_words(filters)}"
    return f"{', ' if closed else ' and '}{say.calls(filters, 'ing')}"


def then_chain(say: Speaker, movements: list[Movement]) -> str:
    """Go to A, turn to 090, then hold for 60 s."""
    local = any(movement.filters or movement.perceptions for movement in movements)
    first, *rest = [
        clause(say, movement, closed=index == len(movements) - 1)
        for index, movement in enumerate(movements)
    ]
    text = first
    for index, part in enumerate(rest):
        last = index == len(rest) - 1
        text += (
            say.pick(", then ", " and then ", ", and then ", "; then ")
            if last or local or say.chance(0.5)
            else ", "
        ) + part
    return sentence(text)


def comma_list(say: Speaker, movements: list[Movement]) -> str:
    """Go to A, turn to 090 and hold for 60 s."""
    if any(movement.filters or movement.perceptions for movement in movements[:-1]):
        return then_chain(say, movements)
    last = movements[-1]
    tail = (
        f" while {say.calls(last.perceptions + last.filters, 'ing')}"
        if last.perceptions or last.filters
        else ""
    )
    joint = ", then " if tail else say.pick(" and ", ", and ")
    return sentence(join([say.move(movement) for movement in movements], joint) + tail)


def first_then(say: Speaker, movements: list[Movement]) -> str:
    """First go to A. Then turn to 090. Finally hold for 60 s."""
    parts = []
    for index, movement in enumerate(movements):
        if index == 0:
            opener = say.pick("first ", "first, ", "", "", "start: ", "to begin with, ")
        elif index == len(movements) - 1:
            opener = say.pick(
                "finally ",
                "finally, ",
                "then ",
                "at the end, ",
                "last, ",
                "after that, ",
                "lastly, ",
            )
        else:
            opener = say.pick("then ", "next, ", "after that, ", "then ", "next ", "afterwards ")
        parts.append(sentence(opener + clause(say, movement)))
    return " ".join(parts)


def numbered(say: Speaker, movements: list[Movement]) -> str:
    """1. Go to A. 2. Turn to 090."""
    style = say.pick("{}. ", "{}) ", "({}) ", "Step {}: ")
    parts = [
        style.format(index) + clause(say, movement) for index, movement in enumerate(movements, 1)
    ]
    return " ".join(f"{part}." for part in parts) if say.chance(0.6) else "; ".join(parts) + "."


def semicolons(say: Speaker, movements: list[Movement]) -> str:
    """Go to A; turn to 090; hold for 60 s."""
    return sentence(
        say.pick("; ", "; ", "; then ", " - ").join(clause(say, movement) for movement in movements)
    )


def after_first(say: Speaker, movements: list[Movement]) -> str:
    """After going to A, turn to 090, then hold for 60 s."""
    if movements[0].filters or movements[0].perceptions:
        return first_then(say, movements)
    opener = f"{say.pick('after', 'once done', 'after')} {say.move(movements[0], 'ing')}".replace(
        "once done", "once you are done"
    )
    return sentence(f"{opener}, {_rest(say, movements[1:])}")


def _rest(say: Speaker, movements: list[Movement]) -> str:
    return ", then ".join(
        clause(say, movement, closed=index == len(movements) - 1)
        for index, movement in enumerate(movements)
    )


def before_last(say: Speaker, movements: list[Movement]) -> str:
    """Before holding for 60 s, go to A and turn to 090."""
    last = movements[-1]
    if last.filters or last.perceptions:
        return first_then(say, movements)
    if say.chance(0.5):
        return sentence(f"before {say.move(last, 'ing')}, {_rest(say, movements[:-1])}")
    if any(movement.filters or movement.perceptions for movement in movements):
        return then_chain(say, movements)
    return sentence(f"{_rest(say, movements[:-1])} before {say.move(last, 'ing')}")


def but_first(say: Speaker, movements: list[Movement]) -> str:
    """Hold for 60 s while recording the sonar, but first go to A."""
    if len(movements) != 2 or movements[0].perceptions or movements[0].filters:
        return then_chain(say, movements)
    return sentence(
        f"{clause(say, movements[1], closed=False)}, but first {say.move(movements[0])}"
    )


def short_sentences(say: Speaker, movements: list[Movement]) -> str:
    """Go to A. Turn to 090. Hold for 60 s."""
    return " ".join(sentence(clause(say, movement)) for movement in movements)


def followed_by(say: Speaker, movements: list[Movement]) -> str:
    """Go to A, followed by a hold; once there, hold for 60 s."""
    if movements[0].kind != "goto":
        return short_sentences(say, movements)
    opener = say.pick(
        "Once there, ",
        "On arrival, ",
        "When you are there, ",
        "At that point, ",
        "Once you have arrived, ",
    )
    return f"{sentence(clause(say, movements[0]))} {opener}{_rest(say, movements[1:])}."


def noted(say: Speaker, movements: list[Movement]) -> str:
    """Go to A (depth logging); turn to 090; hold for 60 s - GPS fix."""
    bracket = say.chance(0.5)
    parts = []
    for movement in movements:
        calls = movement.filters + movement.perceptions
        words = join([noun(say, call) for call in calls], say.pick(", ", " and ")) if calls else ""
        parts.append(
            f"{say.move(movement)}{f' ({words})' if bracket else f' - {words}'}"
            if words
            else say.move(movement)
        )
    if say.chance(0.4):
        return " ".join(f"{index}. {part}." for index, part in enumerate(parts, 1))
    joint = say.pick("; ", ". ", "; then ")
    return (
        " ".join(sentence(part) for part in parts) if joint == ". " else sentence(joint.join(parts))
    )


def what_runs(say: Speaker, movements: list[Movement]) -> str:
    """Go to A. On the way, log the depth. Then hold for 60 s. Take a GPS fix meanwhile."""
    parts = []
    for index, movement in enumerate(movements):
        opener = "" if index == 0 else say.pick("then ", "then ", "next, ", "after that, ", "")
        parts.append(sentence(opener + say.move(movement)))
        calls = movement.perceptions + movement.filters
        if not calls:
            continue
        driving = movement.kind == "goto" and say.chance(0.6)
        when = (
            say.pick("on the way", "on this leg", "under way")
            if driving
            else say.pick("meanwhile", "while doing so", "during this step", "as you do so")
        )
        if can_passive(calls) and say.chance(0.3):
            parts.append(
                sentence(f"{when}, {join([say.passive(call) for call in calls], ' and ')}")
            )
        else:
            parts.append(
                sentence(
                    f"{when}, {say.calls(calls)}"
                    if say.chance(0.5)
                    else f"{say.calls(calls)} {when}"
                )
            )
    return " ".join(parts)


def the_first(say: Speaker, movements: list[Movement]) -> str:
    """Two parts. In the first, go to A with the depth logged. In the second, hold for 60 s."""
    unit = (
        "leg"
        if all(movement.kind == "goto" for movement in movements)
        else say.pick("part", "step", "phase", "part")
    )
    count = in_words(len(movements))
    style = say.rng.random()
    parts = []
    for index, movement in enumerate(movements):
        number = (
            "last" if index == len(movements) - 1 and index and say.chance(0.3) else ORDINALS[index]
        )
        what = clause(say, movement, closed=True)
        if style < 0.5:
            parts.append(sentence(f"{'on' if unit == 'leg' else 'in'} the {number}, {what}"))
        elif style < 0.8:
            parts.append(sentence(f"{number} {unit}: {what}"))
        else:
            parts.append(
                sentence(
                    f"the {number} {'one' if index and say.chance(0.4) else unit} is to {what}"
                )
            )
    return " ".join(([sentence(f"{count} {unit}s")] if say.chance(0.7) else []) + parts)


def stages(say: Speaker, movements: list[Movement]) -> str:
    """Unseen: Stage one is to go to A. Stage two is to hold for 60 s."""
    names = ("one", "two", "three", "four", "five", "six", "seven", "eight")
    return " ".join(
        f"Stage {names[index]} is to {clause(say, movement)}."
        for index, movement in enumerate(movements)
    )


def begin_by(say: Speaker, movements: list[Movement]) -> str:
    """Unseen: Begin by going to A, go on to turn to 090, and end by holding for 60 s."""
    parts = [f"Begin by {clause(say, movements[0], 'ing', closed=False)}"]
    parts += [f"go on to {clause(say, movement, closed=False)}" for movement in movements[1:-1]]
    return f"{', '.join(parts)}, and end by {clause(say, movements[-1], 'ing')}."


def moves_on(say: Speaker, movements: list[Movement]) -> str:
    """Unseen: What comes first is to go to A; what comes next is to hold for 60 s."""
    return (
        "What comes first is to "
        + "; what comes next is to ".join(clause(say, movement) for movement in movements)
        + "."
    )


SEQUENCES: tuple[tuple[Sequence, float], ...] = (
    (then_chain, 4),
    (comma_list, 3),
    (first_then, 3),
    (numbered, 1),
    (semicolons, 1),
    (after_first, 1),
    (before_last, 1),
    (but_first, 0.7),
    (short_sentences, 3),
    (followed_by, 2),
    (noted, 2),
    (what_runs, 2.5),
    (the_first, 2.5),
)
UNSEEN_SEQUENCES: tuple[tuple[Sequence, float], ...] = ((stages, 1), (begin_by, 1), (moves_on, 1))


ALL_THE_TIME_FIRST = (
    "throughout",
    "all the while",
    "during the whole task",
    "at all times",
    "the whole time",
    "in every step",
    "all along",
    "in all steps",
)


def say_script(say: Speaker, script: Script, frame: Sequence) -> str:
    """The movements in this frame, with what runs in every step before or behind them."""
    later = [
        taken
        for movement in script.movements
        if say.chance(0.3) and (taken := _take_out(say, script, movement))
    ]
    local = bool(later) or any(
        movement.filters or movement.perceptions for movement in script.movements
    )
    both = [calls for calls in (script.filters, script.perceptions) if calls]
    if len(both) == 2 and say.chance(0.4):
        both = [
            (
                script.filters + script.perceptions
                if say.chance(0.5)
                else script.perceptions + script.filters
            )
        ]
    front = [everywhere(say, calls, marked=True) for calls in both if say.chance(0.25)]
    body = frame(say, script.movements)
    behind = [_say_later(say, *taken) for taken in later]
    back = [
        everywhere(say, rest, marked=local)
        for calls in both
        if (rest := [call for call in calls if not call.order])
    ]
    return " ".join([*front, body, *behind, *back])


Taken = tuple[Movement, list[Call], list[Call], str]


def _take_out(say: Speaker, script: Script, movement: Movement) -> Taken | None:
    """Take what runs in this step alone out of its clause, with words for the step, to be said
    behind all movements.
    """
    kinds = [group_of(other) for other in script.movements]
    if (
        not (movement.perceptions or movement.filters)
        or len(movement.steps) > 1
        or movement.saying is None
    ):
        return None
    slots = movement.saying.slots
    phrases = [
        template
        for template in say.book.skills[movement.steps[0][0]].during
        if template.needed <= slots.given
    ]
    when = ""
    if phrases and kinds.count(group_of(movement)) == 1 and say.chance(0.7):
        when = phrases[int(say.rng.random() * len(phrases))].render(slots, say.rng)
    elif all(len(other.steps) == 1 for other in script.movements) and len(kinds) <= len(ORDINALS):
        ordinal = (
            "last"
            if movement is script.movements[-1] and say.chance(0.5)
            else ORDINALS[script.movements.index(movement)]
        )
        when = f"{say.pick('in', 'during')} the {ordinal} {say.pick('step', 'part', 'stage')}"
    if not when:
        return None
    taken = (movement, movement.filters, movement.perceptions, when)
    movement.filters, movement.perceptions = [], []
    return taken


def _say_later(
    say: Speaker, movement: Movement, filters: list[Call], perceptions: list[Call], when: str
) -> str:
    """ "Record the sonar during the hold."; puts what was taken out back into its step."""
    movement.filters, movement.perceptions = filters, perceptions
    only = say.pick("", "", "only ", "")
    calls = say.calls(perceptions + filters)
    return (
        sentence(f"{only}{when}, {calls}") if say.chance(0.4) else sentence(f"{calls} {only}{when}")
    )


def everywhere(say: Speaker, calls: list[Call], *, marked: bool) -> str:
    """Sentence for what runs in every step. `marked`: it says so, since other skills belong to
    single steps.
    """
    roll = say.rng.random()
    if not marked and roll < 0.5:
        return sentence(say.calls(calls))
    if can_passive(calls) and 0.5 < roll < 0.6:
        return sentence(
            f"{join([say.passive(call) for call in calls], ' and ')} {say.pick(*ALL_THE_TIME)}"
        )
    if can_with(calls) and 0.6 < roll < 0.68:
        return sentence(f"{say.with_words(calls)} {say.pick(*ALL_THE_TIME)}")
    if can_with(calls) and roll > 0.93:
        return sentence(f"do all of this with {say.with_words(calls)}")
    if roll < 0.75:
        return sentence(f"{say.calls(calls)} {say.pick(*ALL_THE_TIME)}")
    return sentence(f"{say.pick(*ALL_THE_TIME_FIRST)}, {say.calls(calls)}")
